#include "ui/panels/view_panel.h"

#include "renderer/explain/explain_pictures.h"
#include "ui/theme.h"
#include "ui/view_names.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/timing_graph.h"

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

void drawCamera(Session& session, const KeyMap& keys) {
    heading("Camera");
    constexpr std::array<const char*, 3> kTop{"Front", "Right", "Top"};
    constexpr std::array<const char*, 3> kTopWords{"front", "right", "top"};
    const std::array<std::string, 3> sideKeys{keys.text(Action::Front), keys.text(Action::Right),
                                              keys.text(Action::Top)};
    const std::array<const char*, 3> topHelps{sideKeys[0].c_str(), sideKeys[1].c_str(),
                                              sideKeys[2].c_str()};
    const int side = choiceRow("sides", kTop.data(), topHelps.data(), 3, -1);
    if (side >= 0) {
        session.perform({"camera.view", {{"name", kTopWords[static_cast<std::size_t>(side)]}}});
    }
    constexpr std::array<const char*, 2> kFit{"Frame", "Initial"};
    const std::string frameHelp = keys.withKeys("Fits the object into the view", {Action::Frame});
    const std::string initialHelp =
        keys.withKeys("The view that the scene opened with", {Action::Initial});
    const std::array<const char*, 2> fitHelps{frameHelp.c_str(), initialHelp.c_str()};
    const int fit = choiceRow("fit", kFit.data(), fitHelps.data(), 2, -1);
    if (fit == 0) {
        session.perform({"camera.frame", {{"aspect", session.aspect}}});
    } else if (fit == 1) {
        session.perform({"camera.view", {{"name", "initial"}}});
    }
    bool orthographic = session.camera.orthographicHeight.has_value();
    if (ImGui::Checkbox("Orthographic", &orthographic)) {
        session.perform({"camera.projection", {{"orthographic", orthographic}}});
    }
    tooltip(keys.withKeys("Without perspective", {Action::Projection}).c_str());
    float fov = static_cast<float>(session.camera.fovYDegrees);
    if (!orthographic &&
        sliderField("Field of view", fov, 5.0f, 90.0f, "%.0f\xc2\xb0", "Vertical, in degrees")) {
        session.perform({"camera.lens", {{"degrees", fov}}});
    }
}

void drawTurntable(const LayoutContext& context) {
    heading("Turntable");
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2.0f;
    if (ImGui::Button(context.state.isTurning ? "Stop" : "Play", {width, 0.0f})) {
        context.actions.toggleTurntable();
    }
    tooltip(context.preferences.keys
                .withKeys("Turns the object, light and eye at rest: once around in ten seconds",
                          {Action::Turntable})
                .c_str());
    ImGui::SameLine(0.0f, gap);
    if (ImGui::Button("Save sequence\xe2\x80\xa6", {width, 0.0f})) {
        context.actions.saveTurntable(context.state.turntableFrames);
    }
    tooltip("Pictures of a whole turn, numbered, 1280 x 720 pixels, rendered in the background");
    sliderField("Frames", context.state.turntableFrames, 12, 360, "%d",
                "Pictures of a whole turn that is saved");
}

void drawModeList(Session& session) {
    heading("Views for understanding");
    for (const ViewName& name : viewNames()) {
        const bool isCurrent = session.view.mode.mode == name.mode;
        if (ImGui::RadioButton(name.label, isCurrent)) {
            session.perform({"view.mode", {{"name", std::string(name.word)}}});
        }
        tooltip(name.explanation);
    }
}

void changeMode(Session& session, const char* argument, const nlohmann::json& value) {
    session.perform(
        {"view.mode",
         {{"name", std::string(viewName(session.view.mode.mode).word)}, {argument, value}}});
}

void drawLightChoice(Session& session) {
    const int count = static_cast<int>(session.rig.resolved().size());
    if (count > 1) {
        int light = std::min(session.view.mode.light, count - 1) + 1;
        if (sliderField("Light", light, 1, count, "%d", "Of those that are on, as listed")) {
            changeMode(session, "light", light - 1);
        }
    }
}

void drawSampleCounts(const Viewport& viewport) {
    const std::vector<std::size_t>& counts = viewport.shown().shownPerLevel;
    for (std::size_t level = 0; level < counts.size(); ++level) {
        const glm::vec3 c = levelColor(static_cast<int>(level));
        ImGui::ColorButton(fmt::format("##level{}", level).c_str(), {c.r, c.g, c.b, 1.0f},
                           ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                           {ImGui::GetFontSize(), ImGui::GetFontSize()});
        ImGui::SameLine();
        ImGui::Text("Level %zu: %zu samples", level, counts[level]);
    }
}

void drawDifference(const LayoutContext& context) {
    const FrameDifference* const found = context.truth.difference(context.session);
    if (found == nullptr) {
        hint(context.truth.isGivenUp() ? "Given up; any change of the view begins it again."
                                       : "Working it out\xe2\x80\xa6");
        return;
    }
    readout("Relative error", fmt::format("{:.2f} %", 100.0 * found->relativeRmse),
            "Relative RMSE of the exitance B over the visible surface, quality default");
    readout("Mean ratio", fmt::format("{:.4f}", found->meanRatio),
            "Mean of B over the mean of the truth; 1 is right");
    readout("Truth took",
            fmt::format("{:.1f} s, splatting {:.2f} s", 1e-3 * found->truthMs,
                        1e-3 * found->splattingMs),
            "At the size of the comparison, first frame");
    hint(fmt::format("Black: equal. Yellow: {:.0f} % of the mean exitance or more.{}",
                     100.0 * found->scale,
                     context.truth.isComplete(context.session) ? ""
                     : context.truth.isGivenUp()               ? " Given up before it was fine."
                                                               : " Refining\xe2\x80\xa6")
             .c_str());
}

void drawModes(const LayoutContext& context) {
    Session& session = context.session;
    drawModeList(session);
    const ViewModeSettings& mode = session.view.mode;
    if (mode.mode == ViewMode::ExitanceLevel || mode.mode == ViewMode::Irradiance) {
        int level = mode.level;
        const int most = mode.mode == ViewMode::Irradiance ? 7 : 4;
        if (sliderField("Level", level, 0, most, "%d", "Mip level; 0 is the finest")) {
            changeMode(session, "level", level);
        }
    }
    if (mode.mode == ViewMode::Irradiance || mode.mode == ViewMode::Samples) {
        drawLightChoice(session);
    }
    if (mode.mode == ViewMode::Samples) {
        float distance = mode.distanceMm;
        const auto most = static_cast<float>(2.0 * session.world().scatteringSphere.radius);
        if (sliderField("Seen from", distance, 0.0f, most, "%.1f mm",
                        "Distance from a sample to the point that it lights, mm: far points take "
                        "coarse samples")) {
            changeMode(session, "distance", distance);
        }
        drawSampleCounts(context.viewport);
    }
    if (mode.mode == ViewMode::Difference) {
        drawDifference(context);
    }
}

/// Which part of the samples each level has, in the colors of the view of samples.
void drawLevelBar(const std::vector<std::uint64_t>& selected, std::size_t all,
                  const std::string& help) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = 0.6f * ImGui::GetFontSize();
    ImGui::InvisibleButton("##levels", {width, height});
    tooltip(help.c_str());
    float x = low.x;
    for (std::size_t level = 0; level < selected.size() && all > 0; ++level) {
        const float part = width * static_cast<float>(selected[level]) / static_cast<float>(all);
        const glm::vec3 c = levelColor(static_cast<int>(level));
        ImGui::GetWindowDrawList()->AddRectFilled(
            {x, low.y}, {x + part, low.y + height},
            ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1.0f}));
        x += part;
    }
}

void drawTimings(const Viewport& viewport) {
    heading("What a picture costs");
    if (viewport.shownRung() < 0) {
        hint("No picture yet.");
        return;
    }
    drawTimingGraph(viewport, 62.0f * ImGui::GetFontSize() / 15.0f);
    const Picture& picture = viewport.shown();
    ImGui::PushFont(font(Font::Small));
    const float square = 0.7f * ImGui::GetFontSize();
    for (const StageRow& stage : stageRows(picture.stages)) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x, at.y + 0.2f * square}, {at.x + square, at.y + 1.2f * square}, stage.color, 2.0f);
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 2.0f * square);
        ImGui::TextUnformatted(stage.name);
        const std::string time = fmt::format("{:.1f} ms", stage.timeMs);
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(time.c_str()).x);
        ImGui::TextUnformatted(time.c_str());
    }
    ImGui::PopFont();
    readout("Picture", fmt::format("{}\xc3\x97{} px", picture.sizePx.x, picture.sizePx.y),
            "Size of the picture on screen, in pixels");
    readout("Total", fmt::format("{:.0f} ms", picture.timeMs), "Time of the picture on screen");
    if (picture.counts) {
        std::size_t samples = 0;
        std::string perLevel;
        for (std::size_t level = 0; level < picture.counts->selected.size(); ++level) {
            samples += picture.counts->selected[level];
            perLevel += fmt::format("{}level {}: {}", level > 0 ? "\n" : "", level,
                                    picture.counts->selected[level]);
        }
        readout("Samples", fmt::format("{}", samples), perLevel.c_str());
        drawLevelBar(picture.counts->selected, samples, perLevel);
        readout("Pairs", fmt::format("{:.2f} M", 1e-6 * static_cast<double>(picture.counts->pairs)),
                "Pairs of a sample and a pixel that were evaluated, in millions");
    }
}

} // namespace

void drawViewPanel(const LayoutContext& context) {
    drawDisplay(context.session);
    drawModes(context);
    drawTimings(context.viewport);
    drawCamera(context.session, context.preferences.keys);
    drawTurntable(context);
}

} // namespace celadon::ui
