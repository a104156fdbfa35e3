// The materials of a session: their documents, what is undone and in which order, and their files.
#include "ui/session.h"

#include <algorithm>
#include <utility>

namespace celadon::ui {

const subedit::Document* Session::document(int material) const {
    return material >= 0 && material < materialCount()
               ? mDocuments[static_cast<std::size_t>(material)].get()
               : nullptr;
}

subedit::Document* Session::document(int material) {
    return const_cast<subedit::Document*>(std::as_const(*this).document(material));
}

void Session::setHistoryBytes(std::size_t bytes) {
    mHistoryBytes = bytes;
    for (const auto& document : mDocuments) {
        if (document != nullptr) {
            document->setHistoryBytes(bytes);
        }
    }
}

std::size_t Session::editCount() const {
    std::size_t count = 0;
    for (const auto& document : mDocuments) {
        count += document != nullptr ? document->commandCount() : 0;
    }
    return count;
}

int Session::latestEdited() const {
    std::uint64_t first = 0; // what is older than a forgotten step cannot be undone before it
    int latest = -1;
    for (int i = 0; i < materialCount(); ++i) {
        if (document(i) == nullptr) {
            continue;
        }
        first = std::max(first, document(i)->forgottenOrder());
        if (document(i)->canUndo() &&
            (latest < 0 || document(i)->undoOrder() > document(latest)->undoOrder())) {
            latest = i;
        }
    }
    return latest >= 0 && document(latest)->undoOrder() > first ? latest : -1;
}

int Session::nextRedone() const {
    int next = -1;
    for (int i = 0; i < materialCount(); ++i) {
        if (document(i) != nullptr && document(i)->canRedo() &&
            (next < 0 || document(i)->redoOrder() < document(next)->redoOrder())) {
            next = i;
        }
    }
    return next;
}

bool Session::undoEdit() {
    const int material = latestEdited();
    if (material < 0) {
        return false;
    }
    document(material)->undo(progressOf("Undo " + editTitle(*document(material)->undoCommand())));
    activeMaterial = material;
    touchMaterial();
    return true;
}

bool Session::redoEdit() {
    const int material = nextRedone();
    if (material < 0) {
        return false;
    }
    document(material)->redo(progressOf("Redo " + editTitle(*document(material)->redoCommand())));
    activeMaterial = material;
    touchMaterial();
    return true;
}

void Session::adoptFiles(const OpenRequest& request) {
    const std::size_t count = mDocuments.size();
    mFiles.assign(count, {});
    mSaved.assign(count, 0);
    if (!request.material.empty()) {
        if (request.material.ends_with(".subedit.exr") && count > 0) {
            mFiles.front() = request.material;
        }
        return;
    }
    for (const WorldMesh& part : mWorld->meshes) {
        const auto look = static_cast<std::size_t>(part.mesh.material);
        if (part.scattering >= 0 && mWorld->looks[look].subedit) {
            mFiles[static_cast<std::size_t>(part.scattering)] = *mWorld->looks[look].subedit;
        }
    }
}

bool Session::isModified(int material) const {
    const subedit::Document* const painted = document(material);
    return painted != nullptr &&
           (painted->contentId() != mSaved[static_cast<std::size_t>(material)] ||
            (material == mStrokeMaterial && mStroke.isLive));
}

bool Session::isModified() const {
    for (int i = 0; i < materialCount(); ++i) {
        if (isModified(i)) {
            return true;
        }
    }
    return false;
}

void Session::markSaved(int material, std::uint64_t content) {
    mSaved[static_cast<std::size_t>(material)] = content;
}

void Session::forgetMaterialFiles() {
    mFiles.assign(mFiles.size(), {});
}

} // namespace celadon::ui
