#pragma once

#include "ui/journal.h"
#include "ui/session.h"

#include <cstddef>
#include <optional>
#include <string>

/// Brings back what a session that did not end well has left: once its scene is open its steps are
/// replayed, a few at a time, so that the window goes on. Until all are done they stay in the
/// journal that they come from, and nothing else may change the work.
namespace celadon::ui {

class RecoveryRun {
public:
    RecoveryRun(Session& session, Journal& journal) : mSession(session), mJournal(journal) {}

    /// Waits for its scene, which is to be opened.
    void await(Recovery recovery);
    /// A scene has been opened: begins, if it is the one.
    void sceneOpened();
    /// No scene came: it could not be opened, or was given up. The journal stays.
    void sceneMissed() { mAwaited.reset(); }

    [[nodiscard]] bool isRunning() const { return mRunning.has_value(); }
    [[nodiscard]] bool isPending() const { return mAwaited || mRunning; }
    /// For the status bar.
    [[nodiscard]] std::string activity() const;

    /// Some steps. @param keepsJournal what is recovered goes to the journal of this session
    /// @return whether these were the last
    bool advance(bool keepsJournal);

private:
    void finish(bool keepsJournal);

    Session& mSession;
    Journal& mJournal;
    std::optional<Recovery> mAwaited, mRunning;
    std::size_t mDone = 0;                  ///< commands so far
    std::size_t mSteps = 0, mGoodSteps = 0; ///< the same in steps
};

} // namespace celadon::ui
