#include "ui/material_save.h"

#include "subedit/errors.h"
#include "subedit/map/material_file.h"

#include <fmt/format.h>

#include <exception>
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
    if (session.isStrokeOpen()) {
        throw UsageError("save", "a stroke is under way");
    }
    if (!save.file.filename().string().ends_with(".subedit.exr")) {
        throw UsageError(fmt::format("'{}'", save.file.string()), "is no name of a material",
                         "let it end in .subedit.exr");
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

Command saveCommand(const MaterialSave& save) {
    Command command{"file.save", {{"file", save.file.string()}, {"material", save.material}}};
    if (!save.name.empty()) {
        command.arguments["name"] = save.name;
    }
    return command;
}

void saveMaterial(Session& session, const MaterialSave& save) {
    subedit::Document& document = prepare(session, save);
    const std::string before = document.material().name;
    if (!save.name.empty()) {
        document.rename(save.name);
    }
    try {
        subedit::writeMaterial(document.material(), save.file);
    } catch (const Error&) {
        document.rename(before);
        throw;
    }
    takeNote(session, save, document.contentId());
}

void BackgroundSave::wait() {
    while (isRunning()) { // what comes after one may begin another
        mFuture.wait();
        finish();
    }
}

void BackgroundSave::start(const MaterialSave& save, std::function<void()> then) {
    wait();
    try {
        const subedit::Document& document = prepare(mSession, save);
        auto copy = std::make_shared<subedit::MaterialMap>(document.material());
        if (!save.name.empty()) {
            copy->name = save.name;
        }
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
    } catch (const std::exception& error) { // no memory, no thread
        mSession.notify(Notice::Kind::Error, error.what());
        return;
    }
    // Of the material as it is now: strokes that follow come after it in the record as well.
    mSession.dispatcher().announce(saveCommand(save));
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
        if (!mSave.name.empty()) {
            mSession.document(mSave.material)->rename(mSave.name);
        }
        takeNote(mSession, mSave, mContent);
    }
    if (then) {
        then();
    }
}

} // namespace celadon::ui
