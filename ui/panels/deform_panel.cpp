#include "ui/panels/deform_panel.h"

#include "ui/material_library.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/held_change.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

using Kind = Deformer::Kind;
constexpr std::array<const char*, 3> kAxes{"X", "Y", "Z"};
constexpr float kPlayWidth = 4.6f; ///< in font sizes

void perform(Session& session, Command command) {
    command.arguments["seconds"] = session.motion.now.seconds;
    performHeld(session, std::move(command));
}

/// The keys that the panel shows for the chosen deformer; null where it has none to show.
const KeyedNumbers* shownKeys(const AnimatedDeformer& deformer, int control) {
    if (deformer.kind == Kind::Handles) {
        return control >= 0 && control < static_cast<int>(deformer.handles.size())
                   ? &deformer.handles[static_cast<std::size_t>(control)].move
                   : nullptr;
    }
    if (deformer.kind == Kind::Lattice) {
        return deformer.moves.empty() ? nullptr : &deformer.moves.front().by;
    }
    return &deformer.amount;
}

void drawAnimations(Session& session) {
    const auto animations = session.mover().animations();
    if (animations.empty()) {
        return;
    }
    const auto label = [&](int i) {
        const std::string& name = i < 0 ? "" : animations[static_cast<std::size_t>(i)].name;
        return i < 0          ? std::string("Rest pose")
               : name.empty() ? fmt::format("Animation {}", i)
                              : name;
    };
    const int current =
        session.motion.now.animation ? static_cast<int>(*session.motion.now.animation) : -1;
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##animation", label(current).c_str())) {
        for (int i = -1; i < static_cast<int>(animations.size()); ++i) {
            if (ImGui::Selectable(fmt::format("{}##{}", label(i), i).c_str(), i == current)) {
                session.perform({"motion.animation", {{"number", i}}});
            }
        }
        ImGui::EndCombo();
    }
    tooltip("Which of the model's animations plays");
}

void drawTime(const LayoutContext& context) {
    Session& session = context.session;
    heading("Time");
    drawAnimations(session);
    const double duration = session.mover().durationSeconds();
    const MotionState& motion = session.motion;
    const float button = kPlayWidth * ImGui::GetFontSize();
    ImGui::BeginDisabled(duration <= 0.0);
    if (ImGui::Button(motion.isPlaying ? "Stop" : "Play", {button, 0.0f})) {
        context.actions.togglePlay();
    }
    ImGui::EndDisabled();
    tooltip(duration > 0.0 ? "Plays animation and keys (Space)"
                           : "Nothing changes over time: the model has no animation, and no "
                             "deformer has keys");
    ImGui::SameLine();
    // Beyond the last key too, so that a first and a last one can be set at all.
    constexpr double kEmptySeconds = 4.0;
    const double end = std::max(duration > 0.0 ? duration : kEmptySeconds, motion.now.seconds);
    float seconds = static_cast<float>(motion.now.seconds);
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderFloat("##time", &seconds, 0.0f, static_cast<float>(end),
                           fmt::format("%.2f of {:.2f} s", duration).c_str())) {
        const double rounded = std::round(static_cast<double>(seconds) * 100.0) / 100.0;
        session.perform({"motion.play", {{"on", false}, {"seconds", std::max(rounded, 0.0)}}});
    }
    tooltip("The moment that is shown (, and . step by a frame); Ctrl and a click type one, beyond "
            "the end too");
    float speed = static_cast<float>(motion.speed);
    if (sliderField("Speed", speed, 0.1f, 4.0f, "%.2f \xc3\x97",
                    "Of the playback; 1: as it is meant", true)) {
        session.perform({"motion.playback", {{"speed", speed}}});
    }
    bool loops = motion.loops;
    if (ImGui::Checkbox("Loop", &loops)) {
        session.perform({"motion.playback", {{"loop", loops}}});
    }
    tooltip("Starts over at the end, else it stops there");
}

void drawList(Session& session) {
    heading("Deformers");
    const DeformerStack& stack = session.motion.now.deformers;
    const float side = ImGui::GetFrameHeight();
    for (int i = 0; i < static_cast<int>(stack.size()); ++i) {
        const AnimatedDeformer& deformer = stack[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        bool isOn = deformer.isOn;
        Command command;
        if (ImGui::Checkbox("##on", &isOn)) {
            command = {"deform.change", {{"deformer", i}, {"on", isOn}}};
        }
        tooltip("On or off");
        sameRow();
        const std::string label = fmt::format("{}{}", materialLabel(deformerName(deformer.kind)),
                                              deformer.lastSeconds() > 0.0 ? "  (keys)" : "");
        if (rowName(label.c_str(), session.motion.selected == i, 2)) {
            command = {"deform.select", {{"deformer", i}}};
        }
        sameRow();
        if (ImGui::ArrowButton("##up", ImGuiDir_Up) && i > 0) {
            command = {"deform.order", {{"deformer", i}, {"to", i - 1}}};
        }
        tooltip("Earlier in the list");
        sameRow();
        if (ImGui::Button("\xc3\x97", {side, 0.0f})) {
            command = {"deform.remove", {{"deformer", i}}};
        }
        tooltip("Removes it");
        ImGui::PopID();
        if (!command.name.empty()) {
            session.perform(command);
            break;
        }
    }
    if (stack.empty()) {
        hint("They bend the model while you paint on it.");
    }
}

void drawAdd(Session& session) {
    constexpr std::array<const char*, 3> kFirst{"+ Twist", "+ Bend", "+ Taper"};
    constexpr std::array<const char*, 3> kSecond{"+ Wave", "+ Inflate", "+ Lattice"};
    constexpr std::array<const char*, 3> kFirstHelps{
        "Turns the model about an axis, more and more along it", "Bends its axis to an arc",
        "Makes it thinner or thicker along an axis"};
    constexpr std::array<const char*, 3> kSecondHelps{
        "Moves it sideways by a sine", "Moves its surface along the normals",
        "A grid of points around the model that can be dragged"};
    constexpr std::array<const char*, 6> kWords{"twist", "bend",    "taper",
                                                "wave",  "inflate", "lattice"};
    const int first = choiceRow("add", kFirst.data(), kFirstHelps.data(), 3, -1);
    const int second = choiceRow("add more", kSecond.data(), kSecondHelps.data(), 3, -1);
    const int added = first >= 0 ? first : second >= 0 ? 3 + second : -1;
    if (added >= 0) {
        session.perform({"deform.add", {{"type", kWords[static_cast<std::size_t>(added)]}}});
    }
    bool isAdding = session.motion.isAddingHandles;
    if (ImGui::Checkbox("Click adds handles", &isAdding)) {
        session.motion.isAddingHandles = isAdding;
    }
    tooltip(
        "A click on the model adds a handle there: drag one, and the rest follows as rigidly as it "
        "can. At least two are needed to bend anything");
}

void drawAmount(Session& session, int index, const AnimatedDeformer& deformer) {
    const double now = session.motion.now.seconds;
    const float size = static_cast<float>(2.0 * session.world().scatteringSphere.radius);
    const auto change = [&](const char* name, const nlohmann::json& value) {
        Command command{"deform.change", {{"deformer", index}}};
        command.arguments[name] = value;
        perform(session, std::move(command));
    };
    float amount = static_cast<float>(deformer.amount.number(now));
    switch (deformer.kind) {
    case Kind::Twist:
    case Kind::Bend:
        if (sliderField("Angle", amount, -360.0f, 360.0f, "%.0f\xc2\xb0",
                        "Degrees from one end to the other")) {
            change("amount", amount);
        }
        break;
    case Kind::Taper:
        if (sliderField("Scale", amount, 0.0f, 3.0f, "%.2f", "Of the far end; 1 changes nothing")) {
            change("amount", amount);
        }
        break;
    case Kind::Wave: {
        if (sliderField("Amplitude", amount, -0.25f * size, 0.25f * size, "%.2f mm",
                        "How far it moves sideways")) {
            change("amount", amount);
        }
        float wavelength = static_cast<float>(deformer.wavelengthMm.number(now));
        if (sliderField("Wavelength", wavelength, 0.02f * size, 4.0f * size, "%.1f mm",
                        "From crest to crest", true)) {
            change("wavelengthMm", wavelength);
        }
        break;
    }
    case Kind::Inflate:
        if (sliderField("Distance", amount, -0.1f * size, 0.1f * size, "%.2f mm",
                        "Along the normals; less than 0: inwards")) {
            change("amount", amount);
        }
        break;
    case Kind::Lattice:
    case Kind::Handles:
        return;
    }
    if (deformer.kind == Kind::Inflate) {
        return;
    }
    constexpr std::array<const char*, 3> kHelps{"Along x", "Along y", "Along z"};
    const int axis = choiceRow("axis", kAxes.data(), kHelps.data(), 3, deformer.axis);
    if (axis >= 0) {
        change("axis", axis);
    }
    const glm::dvec2 range = deformer.range.value_or(glm::dvec2(0.0, 1.0));
    float ends[2] = {static_cast<float>(range.x), static_cast<float>(range.y)};
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::DragFloat2("##range", ends, 0.005f, -1.0f, 2.0f, "%.2f") && ends[0] < ends[1]) {
        change("range", {ends[0], ends[1]});
    }
    tooltip(
        "From where to where along the axis it grows: 0 is the low end, 1 the high one. What lies "
        "beyond only goes along");
}

void drawLattice(Session& session, int index, const AnimatedDeformer& deformer) {
    int size[3] = {deformer.latticeSize.x, deformer.latticeSize.y, deformer.latticeSize.z};
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderInt3("##size", size, 2, kMaxLatticePoints)) {
        perform(session,
                {"deform.change", {{"deformer", index}, {"size", {size[0], size[1], size[2]}}}});
    }
    tooltip("Control points along x, y and z; another number puts all of them back to rest");
    hint("Drag its points in the view.");
}

void drawHandles(Session& session, const AnimatedDeformer& deformer) {
    for (int h = 0; h < static_cast<int>(deformer.handles.size()); ++h) {
        ImGui::PushID(h);
        if (rowName(fmt::format("Handle {}", h + 1).c_str(), session.motion.control == h, 1)) {
            session.perform(
                {"deform.select", {{"deformer", session.motion.selected}, {"control", h}}});
        }
        sameRow();
        const bool isRemoved = ImGui::Button("\xc3\x97", {ImGui::GetFrameHeight(), 0.0f});
        tooltip("Lets go of it");
        ImGui::PopID();
        if (isRemoved) {
            session.perform({"deform.handle.remove", {{"handle", h}}});
            return;
        }
    }
    const int control = session.motion.control;
    if (control < 0 || control >= static_cast<int>(deformer.handles.size())) {
        hint("Drag handles in the view.");
        return;
    }
    const Handle& handle = deformer.handles[static_cast<std::size_t>(control)];
    const double unit = session.world().millimetersPerUnit;
    const float radiusMm = static_cast<float>(session.world().scatteringSphere.radius);
    float held = static_cast<float>(handle.radius * unit);
    if (sliderField("Radius", held, 0.0f, radiusMm, "%.1f mm",
                    "What it holds, around its center")) {
        perform(session, {"deform.handle.change",
                          {{"handle", control}, {"radius", static_cast<double>(held) / unit}}});
    }
    const glm::dvec3 turn = handle.turnDegrees.vector(session.motion.now.seconds);
    float degrees[3] = {static_cast<float>(turn.x), static_cast<float>(turn.y),
                        static_cast<float>(turn.z)};
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::DragFloat3("##turn", degrees, 1.0f, -360.0f, 360.0f, "%.0f\xc2\xb0")) {
        perform(session,
                {"deform.handle.change",
                 {{"handle", control}, {"turnDegrees", {degrees[0], degrees[1], degrees[2]}}}});
    }
    tooltip("How it is turned about x, then y, then z");
}

void drawKeys(Session& session, int index, const AnimatedDeformer& deformer) {
    const KeyedNumbers* const keys = shownKeys(deformer, session.motion.control);
    if (keys == nullptr) {
        return;
    }
    heading("Keys");
    const double now = session.motion.now.seconds;
    const bool isKey = std::find(keys->times.begin(), keys->times.end(), now) != keys->times.end();
    const Command target{
        "deform.key", {{"deformer", index}, {"control", session.motion.control}, {"on", !isKey}}};
    if (ImGui::Button(isKey ? "Remove the key" : "Set a key", {-1.0f, 0.0f})) {
        perform(session, target);
        return; // `deformer` is of before
    }
    tooltip("At this moment, with the value it has now (K)");
    for (std::size_t k = 0; k < keys->times.size(); ++k) {
        const double seconds = keys->times[k];
        if (k % 4 != 0) {
            ImGui::SameLine();
        }
        ImGui::PushID(static_cast<int>(k));
        if (ImGui::SmallButton(fmt::format("{:.2f} s", seconds).c_str())) {
            session.perform({"motion.time", {{"seconds", seconds}}});
        }
        ImGui::PopID();
        tooltip("Goes to this key");
    }
    if (keys->isKeyed()) {
        constexpr std::array<const char*, 3> kLabels{"Step", "Linear", "Cubic"};
        constexpr std::array<const char*, 3> kWords{"step", "linear", "cubic"};
        constexpr std::array<const char*, 3> kHelps{
            "Stays until the next key", "Straight from key to key", "Smooth through the keys"};
        const int chosen = choiceRow("interpolation", kLabels.data(), kHelps.data(), 3,
                                     static_cast<int>(keys->interpolation));
        if (chosen >= 0) {
            perform(session, {"deform.interpolation",
                              {{"deformer", index},
                               {"control", session.motion.control},
                               {"name", kWords[static_cast<std::size_t>(chosen)]}}});
        }
    }
}

void drawSelected(Session& session) {
    const int index = session.motion.selected;
    const auto chosen = [&]() -> const AnimatedDeformer* {
        const DeformerStack& stack = session.motion.now.deformers;
        return index >= 0 && index < static_cast<int>(stack.size())
                   ? &stack[static_cast<std::size_t>(index)]
                   : nullptr;
    };
    if (chosen() == nullptr) {
        return;
    }
    // Each part is drawn from the stack as it is then: a command before it may have changed it.
    heading(materialLabel(deformerName(chosen()->kind)).c_str());
    if (chosen()->kind == Kind::Lattice) {
        drawLattice(session, index, AnimatedDeformer(*chosen()));
    } else if (chosen()->kind == Kind::Handles) {
        drawHandles(session, AnimatedDeformer(*chosen()));
    } else {
        drawAmount(session, index, AnimatedDeformer(*chosen()));
    }
    if (chosen() != nullptr) {
        drawKeys(session, index, AnimatedDeformer(*chosen()));
    }
}

} // namespace

void drawDeformPanel(const LayoutContext& context) {
    Session& session = context.session;
    drawTime(context);
    drawList(session);
    drawAdd(session);
    drawSelected(session);
    heading("File");
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Open\xe2\x80\xa6", {half, 0.0f})) {
        context.actions.openDeformers();
    }
    tooltip("Deformers from a .json file, instead of these");
    ImGui::SameLine();
    if (ImGui::Button("Save\xe2\x80\xa6", {half, 0.0f})) {
        context.actions.saveDeformers();
    }
    tooltip("As .json, or with a copy of the glTF that is open; 'celadon render' takes both");
}

} // namespace celadon::ui
