#include "ui/widgets/held_change.h"

#include <imgui.h>

#include <utility>

namespace celadon::ui {

void performHeld(Session& session, Command command) {
    command.arguments["continues"] = session.isHeld;
    session.perform(command);
    session.isHeld = ImGui::IsAnyItemActive();
}

void letGoOfHeld(Session& session) {
    session.isHeld &= ImGui::IsAnyItemActive();
}

} // namespace celadon::ui
