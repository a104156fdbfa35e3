#include "ui/panels/view_panel.h"

#include "ui/theme.h"
#include "ui/view_names.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

void drawDisplay(Session& session) {
    heading("Picture");
    float exposure = session.view.exposureEv;
    if (sliderField("Exposure", exposure, -6.0f, 6.0f, "%+.1f EV",
                    "Brightness in stops: radiance is multiplied by 2^EV")) {
        session.perform({"view.exposure", {{"ev", exposure}}});
    }
    constexpr std::array<const char*, 3> kCurves{"Neutral", "ACES", "None"};
    constexpr std::array<const char*, 3> kWords{"neutral", "aces", "none"};
    constexpr std::array<const char*, 3> kHelps{
        "Khronos PBR Neutral: keeps colors, compresses highlights only",
        "A filmic curve: more contrast, colors shift in highlights", "Clamps at white"};
    const int curve = choiceRow("curve", kCurves.data(), kHelps.data(), 3,
                                static_cast<int>(session.view.toneMap));
    if (curve >= 0) {
        session.perform({"view.tonemap", {{"name", kWords[static_cast<std::size_t>(curve)]}}});
    }
    bool specular = session.view.specular;
    if (ImGui::Checkbox("Highlights", &specular)) {
        session.perform({"view.specular", {{"on", specular}}});
    }
    tooltip("The specular lobe of the surface, which paints itself over the scattered light");
}

void drawCamera(Session& session) {
    heading("Camera");
    constexpr std::array<const char*, 3> kTop{"Front", "Right", "Top"};
    constexpr std::array<const char*, 3> kTopWords{"front", "right", "top"};
    constexpr std::array<const char*, 3> kTopHelps{"Numpad 1", "Numpad 3", "Numpad 7"};
    const int side = choiceRow("sides", kTop.data(), kTopHelps.data(), 3, -1);
    if (side >= 0) {
        session.perform({"camera.view", {{"name", kTopWords[static_cast<std::size_t>(side)]}}});
    }
    constexpr std::array<const char*, 2> kFit{"Frame", "Initial"};
    constexpr std::array<const char*, 2> kFitHelps{
        "Fits the object into the view (Home)", "The view that the scene opened with (Numpad 0)"};
    const int fit = choiceRow("fit", kFit.data(), kFitHelps.data(), 2, -1);
    if (fit == 0) {
        session.perform({"camera.frame", {{"aspect", session.aspect}}});
    } else if (fit == 1) {
        session.perform({"camera.view", {{"name", "initial"}}});
    }
    bool orthographic = session.camera.orthographicHeight.has_value();
    if (ImGui::Checkbox("Orthographic", &orthographic)) {
        session.perform({"camera.projection", {{"orthographic", orthographic}}});
    }
    tooltip("Without perspective (Numpad 5)");
    float fov = static_cast<float>(session.camera.fovYDegrees);
    if (!orthographic &&
        sliderField("Field of view", fov, 5.0f, 90.0f, "%.0f\xc2\xb0", "Vertical, in degrees")) {
        session.perform({"camera.lens", {{"degrees", fov}}});
    }
}

void drawModes(Session& session, const Viewport& viewport) {
    heading("Views for understanding");
    for (const ViewName& name : viewNames()) {
        const bool isCurrent = session.view.mode.mode == name.mode;
        if (ImGui::RadioButton(name.label, isCurrent)) {
            session.perform({"view.mode", {{"name", std::string(name.word)}}});
        }
        tooltip(name.explanation);
    }
    if (session.view.mode.mode == ViewMode::ExitanceLevel) {
        int level = session.view.mode.level;
        if (sliderField("Level", level, 0, 4, "%d", "0 is the finest")) {
            session.perform({"view.mode", {{"name", "level"}, {"level", level}}});
        }
    }
    static_cast<void>(viewport);
}

void drawTimings(const Viewport& viewport) {
    heading("Times");
    if (viewport.shownRung() < 0) {
        hint("No picture yet.");
        return;
    }
    const Picture& picture = viewport.shown();
    double splatting = 0.0;
    for (const double level : picture.stages.splatting) {
        splatting += level;
    }
    struct Stage {
        const char* name;
        double timeMs;
    };
    const std::array<Stage, 6> stages{{{"Irradiance buffer", picture.stages.irradianceBuffer},
                                       {"Splatting buffer", picture.stages.splattingBuffer},
                                       {"Selection", picture.stages.selection},
                                       {"Splatting", splatting},
                                       {"Accumulation", picture.stages.accumulation},
                                       {"Shading", picture.stages.shading}}};
    double most = 1e-3;
    for (const Stage& stage : stages) {
        most = std::max(most, stage.timeMs);
    }
    for (const Stage& stage : stages) {
        ImGui::PushFont(font(Font::Small));
        ImGui::TextUnformatted(stage.name);
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.42f);
        ImGui::ProgressBar(static_cast<float>(stage.timeMs / most),
                           {-1.0f, ImGui::GetFontSize() + 2.0f},
                           fmt::format("{:.1f} ms", stage.timeMs).c_str());
        ImGui::PopFont();
    }
    readout("Picture", fmt::format("{}\xc3\x97{} px", picture.sizePx.x, picture.sizePx.y),
            "Size of the picture on screen, in pixels");
    readout("Total", fmt::format("{:.0f} ms", picture.timeMs), "Time of the picture on screen");
}

} // namespace

void drawViewPanel(Session& session, const Viewport& viewport) {
    drawDisplay(session);
    drawCamera(session);
    drawModes(session, viewport);
    drawTimings(viewport);
}

} // namespace celadon::ui
