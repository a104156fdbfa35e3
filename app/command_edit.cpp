#include "app/command_edit.h"

#include "app/edit_trace.h"
#include "app/material/exchange_json.h"
#include "app/option_takers.h"
#include "app/render_motion.h"
#include "app/render_options.h"
#include "app/render_scene.h"
#include "renderer/scene/light.h"
#include "subedit/errors.h"
#include "ui/editor.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <memory>
#include <string_view>

namespace celadon::app {
namespace {

constexpr int kMaxSide = 16384;
constexpr const char* kFirstModel = "builtin:vase";
constexpr const char* kFirstMaterial = "yellow_wax";

/// What both the editor and the reading of its models need.
struct EditOptions {
    RenderOptions scene; ///< model, material, scale, view, lights
    ui::EditorOptions editor;
    std::optional<double> exposureEv;
    std::optional<std::filesystem::path> trace;
};

void addScene(CLI::App& app, RenderOptions& o) {
    addPositional(app, "MODEL",
                  "A model: .gltf .glb .obj .ply .off .stl, or builtin:NAME; default: a builtin",
                  o.model);
    const char* group = "Scene";
    addOption(app, "--material",
              {group, "FILE|NAME", "A .subedit.exr file or a shipped material, for every mesh"},
              takeText(o.material));
    addOption(app, "--view-from", {group, "X,Y,Z", "Where the camera is, model units"},
              takeVector(o.viewFrom));
    addOption(app, "--view-at", {group, "X,Y,Z", "What it looks at, model units"},
              takeVector(o.viewAt));
    addOption(app, "--view-up", {group, "X,Y,Z", "Upwards in the picture; default 0,1,0"},
              takeVector(o.viewUp));
    addOption(app, "--fov", {group, "DEG", "Vertical field of view, degrees; default 35"},
              takeNumber(o.fovYDegrees, {0.1, 170.0, false}));
    addOption(app, "--scale", {group, "MM", "Millimeters per model unit"},
              takeNumber(o.millimetersPerUnit, kPositive));
    addOption(app, "--diameter",
              {group, "MM", "Millimeters of the bounding sphere's diameter, instead of --scale"},
              takeNumber(o.diameterMm, kPositive));
    addRepeatable(app, "--light", {group, "LIGHT", "As 'celadon render' has it; repeatable"},
                  [&o](const Argument& a) { o.lights.push_back(parseText(a)); });
    addOption(app, "--environment", {group, "FILE", "A latitude-longitude .hdr or .exr"},
              takeText(o.environment));
    addOption(app, "--animation",
              {group, "NAME|N",
               "Which of the glTF's animations, by name or number from 0; default: the first"},
              takeText(o.animation));
    addOption(app, "--time", {group, "S", "The moment that is shown first, seconds; default 0"},
              takeNumber(o.timeSeconds, kNotNegative));
    addRepeatable(app, "--deform",
                  {group, "DEFORM", "As 'celadon render' has it; repeatable, in order"},
                  [&o](const Argument& a) { o.deformations.push_back(parseText(a)); });
}

void addWindow(CLI::App& app, EditOptions& o) {
    const char* group = "Window";
    ui::EditorOptions& e = o.editor;
    addOption(app, "--size", {group, "WxH", "Size of the window in pixels; default 1280x720"},
              [&e](const Argument& a) { e.windowSize = parseSize(a, kMaxSide, 1LL << 26); });
    addOption(app, "--ui-scale",
              {group, "F",
               "Scale of the interface, 0.5 to 4; default: the preferences, else the "
               "display's"},
              takeNumber(e.scale, {0.5, 4.0, true}));
    static constexpr std::array<std::string_view, 3> kQualities{"draft", "default", "final"};
    addOption(app, "--quality", {group, "draft|default|final", "How fine pictures get at rest"},
              [&e](const Argument& a) {
                  e.finest = static_cast<celadon::Quality>(parseChoice(a, kQualities));
              });
    addOption(app, "--exposure",
              {group, "EV", "Brightness in stops; default 0, or what fits the lights of the model"},
              takeNumber(o.exposureEv, {-20.0, 20.0, false}));
    addFlag(app, "--view-only", group, "Nothing can be painted", e.viewOnly);
    addFlag(app, "--watch", group, "Opens the model and the material again when their files change",
            e.watch);
}

void addReplay(CLI::App& app, EditOptions& o) {
    const char* group = "Record and replay";
    ui::EditorOptions& e = o.editor;
    addOption(app, "--record", {group, "FILE", "Writes every command, one JSON object a line"},
              takeText(e.record));
    addOption(app, "--replay", {group, "FILE", "Executes such a file once the model is open"},
              takeText(e.replay));
    addOption(app, "--screenshot",
              {group, "FILE", "Writes the window as a picture at the end of the replay"},
              takeText(e.screenshot));
    addRepeatable(
        app, "--screenshot-at",
        {group, "N:FILE", "The same after the N-th command of the replay; repeatable"},
        [&e](const Argument& a) {
            const std::string text = parseText(a);
            const std::size_t colon = text.find(':');
            if (colon == std::string::npos || colon + 1 == text.size()) {
                throw UsageError("--screenshot-at", "'" + text + "' is not N:FILE");
            }
            const int number = parseInteger({a.option, text.substr(0, colon)}, 0, 1 << 30);
            e.screenshotsAt.emplace_back(number, text.substr(colon + 1));
        });
    addOption(app, "--repeat-for",
              {group, "S", "Begins the replay again until so many seconds have passed"},
              takeNumber(e.repeatSeconds, {0.0, 1e6, false}));
    addOption(
        app, "--trace",
        {group, "FILE",
         "Times and memory of the replay as a figure (.svg, .png), with the numbers in a .csv "
         "beside it"},
        [&o](const Argument& a) { o.trace = parsePath(a); });
    addFlag(app, "--exit-after-replay", group, "Closes the window at the end of the replay",
            e.exitAfterReplay);
    addOption(app, "--state",
              {group, "FILE", "Keeps a JSON file up to date with what the editor is doing"},
              takeText(e.state));
}

void edit(EditOptions o) {
    ui::EditorOptions& e = o.editor;
    e.greeting = {kFirstModel, kFirstMaterial};
    e.open = o.scene.model.empty() ? e.greeting : ui::OpenRequest{o.scene.model, {}};
    e.open.material = o.scene.material.value_or(e.open.material);
    const RenderOptions scene = o.scene;
    e.services.readWorld = [scene](const ui::OpenRequest& request) {
        RenderOptions options = scene;
        options.model = request.model;
        options.material =
            request.material.empty() ? std::nullopt : std::optional(request.material);
        if (request.diameterMm) {
            options.diameterMm = request.diameterMm;
            options.millimetersPerUnit.reset();
        }
        return readWorld(options, 0, request.readInstead);
    };
    e.services.describeMaterial = [](const subedit::MaterialMap& map,
                                     const std::string& reference) {
        return gltfMaterial(subedit::nearestParameters(map), map.name, reference);
    };
    e.services.isPaintable = !e.viewOnly;
    e.place = [scene, exposure = o.exposureEv](ui::Session& session) {
        RenderOptions options = scene;
        options.size = {static_cast<int>(1000.0 * session.aspect), 1000};
        session.camera = cameraOf(options, session.world());
        session.fileCamera = session.camera;
        if (!scene.lights.empty()) {
            session.rig.lights.clear();
            for (const Light& light : lightsOf(options, session.world(), session.camera)) {
                session.rig.lights.push_back({lightKindName(light.kind), true, light});
            }
        } else if (session.world().lights.empty()) {
            session.rig.lights =
                ui::lightPreset("back", session.camera, session.world().scatteringSphere);
        }
        session.markLightsSaved(); // as the command line has them: nobody has changed any
        if (scene.environment) {
            session.perform({"environment.open", {{"file", scene.environment->string()}}});
        }
        ui::MotionSetting motion = session.motion.now;
        if (auto deformers = readDeformations(scene.deformations)) {
            motion.deformers = std::move(*deformers);
        }
        if (scene.animation) {
            motion.animation = findAnimation(session.world().rig.get(), *scene.animation);
        }
        motion.seconds = scene.timeSeconds.value_or(0.0);
        session.setMotion(std::move(motion));
        session.markDeformersSaved();
        session.forgetSettings();
        if (exposure || !scene.lights.empty()) {
            session.view.exposureEv = static_cast<float>(exposure.value_or(0.0));
        }
        session.touchPicture();
    };
    std::optional<EditTrace> trace;
    if (o.trace) {
        trace.emplace(*o.trace);
        e.trace = [&trace](const ui::TracePoint& point) { trace->add(point); };
    }
    ui::runEditor(e);
    if (trace) {
        trace->write();
    }
}

} // namespace

Command addEditCommand(CLI::App& root) {
    const auto options = std::make_shared<EditOptions>();
    CLI::App* command = root.add_subcommand("edit", "The editor: paint scattering, see light");
    addScene(*command, options->scene);
    addWindow(*command, *options);
    addReplay(*command, *options);
    return {command, [options] { edit(*options); }};
}

} // namespace celadon::app
