#pragma once

#include "ui/light_rig.h"
#include "ui/motion_state.h"
#include "ui/paint_state.h"

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

/// Changes of what is set, not painted, to be taken back: what moves the model, its lights, the
/// profiles in hand, each as it was before. They stand in one row with what was painted: each step
/// knows how many edits of the documents were in effect when it was done.
namespace celadon::ui {

/// Deformers and the chosen animation; time is no step.
struct MotionPart {
    DeformerStack deformers;
    std::optional<std::size_t> animation;
};

struct ProfilePart {
    bool isSecondary = false;
    NamedProfile profile;
};

using SettingPart = std::variant<MotionPart, LightRig, ProfilePart>;

class SettingHistory {
public:
    void clear();
    /// What was taken back can no longer be done again.
    void dropUndone() { mUndone.clear(); }
    /// Nothing is undone when it is called. Of very many steps the oldest go.
    /// @param before    what the step has changed
    /// @param edits     of all documents, in effect now
    /// @param continues the step before goes on, as a slider in the hand: both are taken back at
    /// once
    void add(SettingPart before, const std::string& title, std::size_t edits, bool continues);

    /// Title of the step that is next in the row; null: there is none, or painting came after it.
    [[nodiscard]] const std::string* undoTitle(std::size_t edits) const;
    [[nodiscard]] const std::string* redoTitle(std::size_t edits) const;
    /// What is to be set when the step is taken back or done again. Only where there is a title.
    [[nodiscard]] const SettingPart& undone() const;
    [[nodiscard]] const SettingPart& redone() const;
    /// It was set. @param before the same part as it was
    void confirmUndo(SettingPart before);
    void confirmRedo(SettingPart before);

    /// What is no step itself goes on in what was before: profiles that changed hands, lights that
    /// turned with the camera.
    void swapProfiles();
    void turnLights(const Camera& camera, double degrees);

private:
    struct Step {
        SettingPart part; ///< before it; once it is taken back, after it
        std::string title;
        std::size_t edits = 0;
    };
    std::vector<Step> mDone, mUndone;

    static void pass(std::vector<Step>& from, std::vector<Step>& to, SettingPart before);
    /// Calls `change` with what all steps have of one kind.
    template<class Part, class Change>
    void forEach(const Change& change);
};

} // namespace celadon::ui
