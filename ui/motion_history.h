#pragma once

#include "ui/motion_state.h"

#include <cstddef>
#include <string>
#include <vector>

/// Changes of what moves the model, to be taken back: deformers and the chosen animation as they
/// were before each. Time is none of them. They stand in one row with what was painted: each step
/// knows how many edits of the documents were in effect when it was done.
namespace celadon::ui {

class MotionHistory {
public:
    void clear();
    /// @param before    the setting that the step has changed
    /// @param edits     of all documents, in effect now
    /// @param continues the step before goes on, as a slider in the hand: both are taken back at
    /// once
    void add(const MotionSetting& before, const std::string& title, std::size_t edits,
             bool continues);

    /// Title of the step that is next in the row; null: there is none, or painting came after it.
    [[nodiscard]] const std::string* undoTitle(std::size_t edits) const;
    [[nodiscard]] const std::string* redoTitle(std::size_t edits) const;
    /// The setting with the step taken back or done again. Only where there is a title.
    [[nodiscard]] MotionSetting undone(const MotionSetting& now) const;
    [[nodiscard]] MotionSetting redone(const MotionSetting& now) const;
    /// It has become so.
    void confirmUndo(const MotionSetting& before);
    void confirmRedo(const MotionSetting& before);

private:
    struct Step {
        DeformerStack deformers; ///< before it; once it is taken back, after it
        std::optional<std::size_t> animation;
        std::string title;
        std::size_t edits = 0;
    };
    std::vector<Step> mDone, mUndone;

    static MotionSetting exchanged(const Step& step, const MotionSetting& now);
    static void pass(std::vector<Step>& from, std::vector<Step>& to, const MotionSetting& before);
};

} // namespace celadon::ui
