#include "ui/panels/light_panel.h"

#include "renderer/scene/light.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/held_change.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

void drawPresets(Session& session) {
    constexpr std::array<const char*, 4> kLabels{"Back", "Rim", "Studio", "Front"};
    constexpr std::array<const char*, 4> kWords{"back", "rim", "studio", "front"};
    constexpr std::array<const char*, 4> kHelps{
        "Light from behind, as the camera sees it now: thin parts glow",
        "Two lights from behind, warm and cool", "Key, fill and back light",
        "One light beside the camera: shows color, hides translucency"};
    const int clicked = choiceRow("presets", kLabels.data(), kHelps.data(), 4, -1);
    if (clicked >= 0) {
        session.perform({"light.preset", {{"name", kWords[static_cast<std::size_t>(clicked)]}}});
    }
}

const char* kindHelp(Light::Kind kind) {
    return kind == Light::Kind::Directional ? "Directional: from far away, all one way"
           : kind == Light::Kind::Point     ? "Point: from a place, to all sides"
                                            : "Spot: from a place, within a cone";
}

void drawList(Session& session) {
    for (int i = 0; i < static_cast<int>(session.rig.lights.size()); ++i) {
        const RigLight& item = session.rig.lights[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        bool isOn = item.isOn;
        if (ImGui::Checkbox("##on", &isOn)) {
            session.perform({"light.change", {{"light", i}, {"on", isOn}}});
        }
        tooltip("On or off");
        sameRow();
        const std::string label = fmt::format("{}##{}", item.name.empty() ? "Light" : item.name, i);
        if (rowName(label.c_str(), session.selectedLight == i, 1)) {
            session.perform({"light.select", {{"light", i}}});
        }
        tooltip(kindHelp(item.light.kind));
        sameRow();
        const bool isRemoved = ImGui::Button("\xc3\x97", {ImGui::GetFrameHeight(), 0.0f});
        tooltip("Removes this light");
        ImGui::PopID();
        if (isRemoved) {
            session.perform({"light.remove", {{"light", i}}});
            break;
        }
    }
}

void drawSelected(Session& session) {
    const int index = session.selectedLight;
    if (index < 0 || index >= static_cast<int>(session.rig.lights.size())) {
        return;
    }
    const Light& light = session.rig.lights[static_cast<std::size_t>(index)].light;
    heading(session.rig.lights[static_cast<std::size_t>(index)].name.c_str());
    const auto change = [&](const char* name, nlohmann::json value) {
        Command command{"light.change", {{"light", index}}};
        command.arguments[name] = std::move(value);
        performHeld(session, std::move(command));
    };
    // Strength and tint: a color of several W/m^2 is hard to pick as one.
    const bool isDirectional = light.kind == Light::Kind::Directional;
    const double strongest = std::max({light.color.x, light.color.y, light.color.z});
    const glm::dvec3 tint = strongest > 0.0 ? light.color / strongest : glm::dvec3(1.0);
    float strength = static_cast<float>(strongest);
    if (sliderField("Strength", strength, isDirectional ? 0.01f : 1e-4f,
                    isDirectional ? 50.0f : 10.0f, isDirectional ? "%.2f W/m\xc2\xb2" : "%.4f W/sr",
                    isDirectional ? "Irradiance on a plane that faces the light, W/m\xc2\xb2"
                                  : "Radiant intensity, W/sr",
                    true)) {
        change("color", toJson(static_cast<double>(strength) * tint));
    }
    float rgb[3] = {float(tint.x), float(tint.y), float(tint.z)};
    if (colorField("Color", rgb, "Linear color of the light; its strength is set above", true)) {
        const glm::dvec3 picked(rgb[0], rgb[1], rgb[2]);
        change("color", toJson(strongest / std::max({picked.x, picked.y, picked.z}) * picked));
    }
    if (light.kind != Light::Kind::Point) {
        float azimuth =
            static_cast<float>(glm::degrees(std::atan2(-light.direction.x, -light.direction.z)));
        float elevation =
            static_cast<float>(glm::degrees(std::asin(std::clamp(-light.direction.y, -1.0, 1.0))));
        const bool turned = sliderField("Azimuth", azimuth, -180.0f, 180.0f, "%.0f\xc2\xb0",
                                        "Where the light comes from: degrees from +z towards +x");
        const bool raised = sliderField("Elevation", elevation, -89.9f, 89.9f, "%.0f\xc2\xb0",
                                        "Degrees above the horizon that the light comes from");
        if (turned || raised) {
            const double a = glm::radians(static_cast<double>(azimuth));
            const double e = glm::radians(static_cast<double>(elevation));
            change("direction",
                   toJson({-std::sin(a) * std::cos(e), -std::sin(e), -std::cos(a) * std::cos(e)}));
        }
    }
    if (!isDirectional) {
        float position[3] = {float(light.position.x), float(light.position.y),
                             float(light.position.z)};
        ImGui::SetNextItemWidth(-1.0f);
        if (ImGui::DragFloat3("##position", position, 0.5f, 0.0f, 0.0f, "%.1f mm")) {
            change("position", toJson({position[0], position[1], position[2]}));
        }
        tooltip("Position in mm, world axes; or drag the light in the viewport");
    }
    if (light.kind == Light::Kind::Spot) {
        float outer = static_cast<float>(glm::degrees(light.outerConeRadians));
        float inner = static_cast<float>(glm::degrees(light.innerConeRadians));
        if (sliderField("Cone", outer, 1.0f, 89.0f, "%.0f\xc2\xb0",
                        "Half angle in degrees where the light ends")) {
            change("outer", outer);
        }
        if (sliderField("Full within", inner, 0.0f, 88.0f, "%.0f\xc2\xb0",
                        "Half angle in degrees up to which the light is full")) {
            change("inner", inner);
        }
    }
}

void drawEnvironment(Session& session, const LayoutActions& actions) {
    heading("Environment");
    if (ImGui::Button(session.rig.environment ? "Another\xe2\x80\xa6" : "Open\xe2\x80\xa6",
                      {-1.0f, 0.0f})) {
        actions.openEnvironment();
    }
    tooltip(
        "A picture of light from all around, latitude-longitude: .hdr or .exr. It can be dropped "
        "on the window as well");
    if (!session.rig.environment) {
        return;
    }
    const RigEnvironment& environment = *session.rig.environment;
    ImGui::TextUnformatted(environment.file.filename().c_str());
    tooltip(environment.file.c_str());
    float strength = static_cast<float>(environment.strength);
    if (sliderField("Strength", strength, 0.0f, 10.0f, "%.2f", "Factor on the map's radiance")) {
        performHeld(session, {"environment.change", {{"strength", strength}}});
    }
    float turn = static_cast<float>(environment.turnDegrees);
    if (sliderField("Turn", turn, -180.0f, 180.0f, "%.0f\xc2\xb0", "About the vertical, degrees")) {
        performHeld(session, {"environment.change", {{"turn", turn}}});
    }
    int lights = environment.lights;
    if (sliderField("Lights", lights, 1, 128, "%d",
                    "Directional lights that stand for the map: more is smoother and slower")) {
        performHeld(session, {"environment.change", {{"lights", lights}}});
    }
    if (ImGui::Button("Remove the environment", {-1.0f, 0.0f})) {
        session.perform({"environment.close"});
    }
}

} // namespace

void drawLightPanel(Session& session, const LayoutActions& actions) {
    heading("Presets");
    drawPresets(session);
    heading("Lights");
    drawList(session);
    constexpr std::array<const char*, 3> kAdd{"+ Directional", "+ Point", "+ Spot"};
    constexpr std::array<const char*, 3> kHelps{"Adds a light from far away, like the sun",
                                                "Adds a light that shines all around",
                                                "Adds a light with a cone"};
    const int added = choiceRow("add", kAdd.data(), kHelps.data(), 3, -1);
    if (added >= 0) {
        session.perform({"light.add", {{"kind", lightKindName(static_cast<Light::Kind>(added))}}});
    }
    // Fields of both have the same names.
    ImGui::PushID("selected");
    drawSelected(session);
    ImGui::PopID();
    ImGui::PushID("environment");
    drawEnvironment(session, actions);
    ImGui::PopID();
}

} // namespace celadon::ui
