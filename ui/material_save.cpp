#include "ui/material_save.h"

#include "subedit/errors.h"
#include "subedit/map/material_file.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace celadon::ui {

namespace {

/// Checks, and tells those who keep what stands there.
subedit::Document& prepare(Session& session, const MaterialSave& save) {
    subedit::Document* const document = session.document(save.material);
    if (document == nullptr) {
        throw UsageError("save", "there is no material", "open a model first");
    }
    if (!save.file.filename().string().ends_with(".subedit.exr")) {
        throw UsageError(fmt::format("'{}'", save.file.string()), "is no name of a material",
                         "let it end in .subedit.exr");
    }
    if (!save.name.empty()) {
        document->rename(save.name);
    }
    if (session.beforeWriting) {
        session.beforeWriting(save.file);
    }
    return *document;
}

void takeNote(Session& session, const MaterialSave& save, std::uint64_t content) {
    session.setMaterialFile(save.material, save.file);
    session.markSaved(save.material, content);
    session.notify(Notice::Kind::Info, fmt::format("Saved '{}'", save.file.string()));
}

} // namespace

void saveMaterial(Session& session, const MaterialSave& save) {
    const subedit::Document& document = prepare(session, save);
    subedit::writeMaterial(document.material(), save.file);
    takeNote(session, save, document.contentId());
}

void BackgroundSave::start(const MaterialSave& save, std::function<void()> then) {
    if (isRunning()) {
        mFuture.wait();
        finish();
    }
    try {
        const subedit::Document& document = prepare(mSession, save);
        auto copy = std::make_shared<const subedit::MaterialMap>(document.material());
        mSave = save;
        mContent = document.contentId();
        mWorld = mSession.worldRevision();
        mThen = std::move(then);
        mStart = std::chrono::steady_clock::now();
        mFuture = std::async(std::launch::async,
                             [copy = std::move(copy), file = save.file, wake = mWake] {
                                 const std::shared_ptr<void> atEnd(nullptr, [&](void*) { wake(); });
                                 subedit::writeMaterial(*copy, file);
                             });
    } catch (const Error& error) {
        mSession.notify(Notice::Kind::Error, error.what());
        return;
    }
    // Of the material as it is now: strokes that follow come after it in the record as well.
    Command command{"file.save", {{"file", save.file.string()}, {"material", save.material}}};
    if (!save.name.empty()) {
        command.arguments["name"] = save.name;
    }
    mSession.dispatcher().announce(command);
}

double BackgroundSave::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - mStart).count();
}

bool BackgroundSave::poll() {
    if (!isRunning() || mFuture.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return false;
    }
    finish();
    return true;
}

void BackgroundSave::finish() {
    const std::function<void()> then = std::exchange(mThen, nullptr);
    try {
        mFuture.get();
    } catch (const std::exception& error) {
        mSession.notify(Notice::Kind::Error, error.what());
        return;
    }
    if (mWorld == mSession.worldRevision()) {
        takeNote(mSession, mSave, mContent);
    }
    if (then) {
        then();
    }
}

} // namespace celadon::ui
