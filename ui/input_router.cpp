#include "ui/input_router.h"

#include <imgui.h>

#include <optional>
#include <string>
#include <utility>

namespace celadon::ui {

/// The key that the preferences wait for: Escape leaves it as it was, Backspace takes it away.
void InputRouter::takeKey(KeyChord pressed) {
    const bool isGivenUp = pressed == *parseChord("Esc");
    const bool isNone = pressed == *parseChord("Back");
    if (!isGivenUp && !isNone && chordText(pressed).empty()) {
        return; // shift and the like: more is to come
    }
    if (!isGivenUp) {
        mTargets.session.perform({"preferences.key",
                                  {{"action", actionName(*mTargets.layout.keyWantedFor)},
                                   {"key", isNone ? std::string() : chordText(pressed)}}});
    }
    mTargets.layout.keyWantedFor.reset();
}

void InputRouter::handleKey(const InputEvent& event) {
    const KeyChord pressed{event.button, event.modifiers};
    if (mTargets.layout.keyWantedFor) {
        takeKey(pressed);
        return;
    }
    const std::optional<Action> action = mTargets.preferences.keys.find(pressed);
    if (action && !mTargets.recovery.isRunning() && (!event.isRepeated || repeats(*action)) &&
        !ImGui::GetIO().WantTextInput && !mTargets.files.isAsking()) {
        mTargets.act(*action);
    }
}

/// Nothing overtakes what waits for the end of the frame, or for the shape that is shown.
bool InputRouter::mustWait(const InputEvent& event, bool overUi) {
    return mTargets.longEdit.isShown() || mTargets.session.hasWaiting() || !mLater.empty() ||
           mTargets.tools.mustWait(event, mTargets.viewport.rect(), overUi);
}

void InputRouter::take(const std::vector<InputEvent>& arrived) {
    const ImGuiIO& io = ImGui::GetIO();
    ViewportTools& tools = mTargets.tools;
    tools.setLightsFirst(mTargets.layout.panelsShown && mTargets.layout.tab == Tab::Light);
    std::vector<InputEvent> events = std::exchange(mLater, {});
    // A long edit that shows takes no input, but a stroke goes on after it.
    if (!mTargets.longEdit.isShown() || tools.isDragging() || !events.empty()) {
        events.insert(events.end(), arrived.begin(), arrived.end());
    }
    for (const InputEvent& event : events) {
        // A press beside a field that is being typed in only leaves it.
        const bool leavesField = event.kind == InputEvent::Kind::Press && io.WantTextInput;
        const bool overUi = (io.WantCaptureMouse || leavesField) && !tools.isDragging();
        if (mustWait(event, overUi)) {
            mLater.push_back(event);
        } else if (event.kind == InputEvent::Kind::Key) {
            handleKey(event);
        } else if (!mTargets.recovery.isRunning()) {
            tools.handle(event, mTargets.viewport.rect(), overUi);
        }
    }
    tools.hover({static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)},
                io.WantCaptureMouse);
}

} // namespace celadon::ui
