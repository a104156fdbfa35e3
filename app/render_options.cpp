#include "app/render_options.h"

#include "app/command.h"
#include "app/frame_pattern.h"
#include "app/option_takers.h"
#include "renderer/output/image_io.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <span>
#include <string_view>

namespace celadon::app {
namespace {

constexpr int kMaxSide = 16384;
constexpr long long kMaxPixels = 1LL << 26; // 67 million: 1 GiB a float RGBA buffer
constexpr int kMaxLevels = 12;
constexpr int kMaxIrradianceSize = 8192;
constexpr int kMaxEnvironmentLights = 4096;
constexpr int kUsualPaths = 4'000'000;
constexpr int kMostPaths = 2'000'000'000;
constexpr int kMaxSamples = 64;

constexpr std::array<std::string_view, 4> kSolvers{"splatting", "image-reference",
                                                   "surface-reference", "path-traced"};
constexpr std::array<std::string_view, 2> kSchemes{"paper", "hierarchical"};
constexpr std::array<std::string_view, 3> kQualities{"draft", "default", "final"};
constexpr std::array<std::string_view, 4> kBackends{"auto", "raster", "tiled", "cpu"};
constexpr std::array<std::string_view, 2> kExitFresnels{"exact", "paper"};
constexpr std::array<std::string_view, 4> kContexts{"auto", "glfw", "egl", "osmesa"};
constexpr std::array<std::string_view, 3> kToneMaps{"neutral", "aces", "none"};

void addFiles(CLI::App& app, RenderOptions& o) {
    const char* group = "Input and output";
    addPositional(app, "MODEL",
                  "A model: .gltf .glb .obj .ply .off .stl, or builtin:NAME (sphere, slab, ...)",
                  o.model);
    addOption(app, "-o,--output",
              {group, "OUT",
               "The picture, by its extension: .exr (linear, with layers), .png, .jpg, .tif (tone "
               "mapped, sRGB); with --frames it holds %04d"},
              takeText(o.output));
    addOption(app, "--material",
              {group, "FILE|NAME",
               "A .subedit.exr file or a shipped material, for every mesh; default: what the glTF "
               "names, else a shipped one"},
              takeText(o.material));
    addOption(app, "--material-to",
              {group, "FILE|NAME", "Another material, into which --material fades over the frames"},
              takeText(o.materialTo));
    addOption(app, "--fade-frames",
              {group, "A:B",
               "It is --material up to frame A and --material-to from B on; default: "
               "the first and the last of --frames"},
              [&o](const Argument& a) { o.fadeFrames = parseFrames(a); });
    addFlag(app, "--aov", group,
            "Adds layers to the EXR: exitance (W/m^2), position (mm), normal, uv, radius (mm), "
            "level",
            o.aov);
    addOption(app, "--stats", {group, "FILE", "Writes times, sample counts and flux as JSON"},
              takeText(o.stats));
}

void addPicture(CLI::App& app, RenderOptions& o) {
    const char* group = "Picture";
    addOption(app, "--size",
              {group, "WxH", fmt::format("Pixels, 1 to {} a side; default 800x600", kMaxSide)},
              [&o](const Argument& a) { o.size = parseSize(a, kMaxSide, kMaxPixels); });
    addOption(
        app, "--samples",
        {group, "N",
         fmt::format("Antialiasing samples a pixel, 1 to {}; default {}", kMaxSamples, o.samples)},
        takeInteger(o.samples, 1, kMaxSamples));
    addOption(app, "--exposure",
              {group, "EV", "Multiplies radiance by 2^EV, not in EXR; default 0"},
              takeNumber(o.exposureEv, {-100.0, 100.0, false}));
    addOption(app, "--tonemap",
              {group, "neutral|aces|none", "Tone curve, not in EXR; default neutral"},
              takeChoice(o.toneMap, kToneMaps));
    addOption(app, "--background",
              {group, "R,G,B|transparent|environment",
               "Behind the object: a linear color, nothing, or the map of --environment; default "
               "transparent"},
              [&o](const Argument& a) {
                  o.background.reset();
                  o.environmentBehind = a.text == "environment";
                  if (a.text != "transparent" && !o.environmentBehind) {
                      o.background = glm::vec3(parseVector(a, {0.0, 1e6, false}));
                  }
              });
    addFlag(app, "--no-specular", group, "No highlights", o.specular, false);
}

void addView(CLI::App& app, RenderOptions& o) {
    const char* group = "View and size";
    addOption(app, "--view-from",
              {group, "X,Y,Z",
               "Where the camera is, model units; default: the model's first camera, else a "
               "three-quarter view that fits"},
              takeVector(o.viewFrom));
    addOption(app, "--view-at",
              {group, "X,Y,Z", "What it looks at, model units; default: the object's center"},
              takeVector(o.viewAt));
    addOption(app, "--view-up", {group, "X,Y,Z", "Upwards in the picture; default 0,1,0"},
              takeVector(o.viewUp));
    addOption(app, "--fov",
              {group, "DEG", "Vertical field of view, degrees; default: the camera's, else 35"},
              takeNumber(o.fovYDegrees, {0.1, 170.0, false}));
    addOption(
        app, "--scale",
        {group, "MM", "Millimeters per model unit; default: glTF 1000, else as --diameter 100"},
        takeNumber(o.millimetersPerUnit, kPositive));
    addOption(app, "--diameter",
              {group, "MM", "Millimeters of the bounding sphere's diameter, instead of --scale"},
              takeNumber(o.diameterMm, kPositive));
}

void addLights(CLI::App& app, RenderOptions& o) {
    const char* group = "Light";
    addRepeatable(app, "--light",
                  {group, "LIGHT",
                   "directional:DX,DY,DZ[:R,G,B] travels along D, W/m^2 on a plane that faces it\n"
                   "point:X,Y,Z[:R,G,B] W/sr, position in model units\n"
                   "spot:X,Y,Z:DX,DY,DZ:INNER,OUTER[:R,G,B] W/sr, half angles in degrees\n"
                   "Repeatable; default: the model's lights, else one"},
                  [&o](const Argument& a) { o.lights.push_back(parseText(a)); });
    addOption(app, "--environment",
              {group, "FILE", "Light from all around: a latitude-longitude .hdr or .exr"},
              takeText(o.environment));
    addOption(app, "--environment-lights",
              {group, "N",
               fmt::format("Directional lights that stand for the environment; default {}",
                           o.environmentLights)},
              takeInteger(o.environmentLights, 1, kMaxEnvironmentLights));
}

void addMotion(CLI::App& app, RenderOptions& o) {
    const char* group = "Motion";
    addOption(app, "--animation",
              {group, "NAME|N",
               "Which of the glTF's animations, by name or number from 0; default with --time or "
               "--frames: the first"},
              takeText(o.animation));
    addOption(app, "--time", {group, "S", "The moment of the animation, seconds; default 0"},
              takeNumber(o.timeSeconds, kNotNegative));
    addOption(app, "--frames",
              {group, "A:B", "One picture for each frame A to B, at time frame / fps"},
              [&o](const Argument& a) { o.frames = parseFrames(a); });
    addOption(app, "--fps", {group, "N", "Frames per second; default 24"},
              takeNumber(o.framesPerSecond, {0.001, 1e6, false}));
    addOption(app, "--sequence",
              {group, "PATTERN", "One model file a frame, such as frame_%04d.ply"},
              takeText(o.sequence));
    addRepeatable(
        app, "--deform",
        {group, "DEFORM",
         "twist:AXIS:DEG, bend:AXIS:DEG, taper:AXIS:SCALE, inflate:MM or\n"
         "wave:AXIS:AMPLITUDE_MM:WAVELENGTH_MM, all but inflate with :FROM,TO after it for "
         "a part of the extent\n"
         "FILE.json: lattices, handles, keys; repeatable, in order; default: those that "
         "the model stores; none: without them"},
        [&o](const Argument& a) { o.deformations.push_back(parseText(a)); });
}

void addMethod(CLI::App& app, RenderOptions& o) {
    const char* group = "Method";
    addOption(app, "--solver",
              {group, "NAME",
               "splatting, image-reference, surface-reference or path-traced; default splatting"},
              takeChoice(o.solver, kSolvers));
    addOption(app, "--scheme",
              {group, "paper|hierarchical", "Scheme of splatting; default hierarchical"},
              takeChoice(o.scheme, kSchemes));
    addOption(app, "--quality", {group, "draft|default|final", "Sets what is not set below"},
              takeChoice(o.quality, kQualities));
    addOption(app, "--backend",
              {group, "auto|raster|tiled|cpu",
               "What splats; default auto: cpu on software drivers, else the faster of raster "
               "and tiled, measured in the first frame"},
              takeChoice(o.backend, kBackends));
    addOption(app, "--context", {group, "auto|glfw|egl|osmesa", "OpenGL through; default auto"},
              takeChoice(o.context, kContexts));
    addOption(app, "--levels",
              {group, "N|I,S",
               "Levels of both pyramids, or of irradiance and splatting buffer; default 6,5"},
              [&o](const Argument& a) { o.levels = parseLevels(a, kMaxLevels); });
    addOption(app, "--irradiance-size",
              {group, "N",
               "Side of the irradiance buffer in texels; default 512, 2 or 4 times that where "
               "ranges are short for it"},
              takeInteger(o.irradianceSize, 16, kMaxIrradianceSize));
    addOption(app, "--alpha",
              {group, "A", "Scheme paper: samples per effective radius; default 15"},
              takeNumber(o.alpha, {0.0, 1e6, true}));
    addOption(app, "--epsilon",
              {group, "E",
               "Scheme paper, and layer level: error that a coarser ring may make; default 0.01 "
               "(paper: 0.001)"},
              takeNumber(o.epsilon, {0.0, 1.0, true}));
    addOption(app, "--table",
              {group, "FILE",
               "Scheme paper, and layer level: minimal rendering radii from a file of 'celadon "
               "profile table' (.csv or .exr); "
               "default: computed from each material"},
              takeText(o.table));
    addOption(app, "--discontinuity",
              {group, "Z",
               "Scheme paper: depth step within a sample, bounding sphere radii; default 0.03"},
              takeNumber(o.discontinuity, {0.0, 1e6, true}));
    addFlag(app, "--no-orientation", group,
            "Scheme paper: selection without the slope to the light (eq. 11 without |n.l|)",
            o.orientation, false);
    addOption(
        app, "--energy",
        {group, "F",
         "Scheme paper: part of a profile's energy that a splat reaches to; default 0.995 (paper: "
         "0.95)"},
        takeNumber(o.energy, {0.0, 1.0, true}));
    addFlag(app, "--no-adaptive", group, "Every lit finest texel is a sample", o.adaptive, false);
    addFlag(app, "--no-multires", group, "Every splat reaches to its end at full resolution",
            o.multiresolution, false);
    addOption(app, "--exit-fresnel",
              {group, "exact|paper", "exact keeps the flux, paper is its eq. 7; default exact"},
              takeChoice(o.exitFresnel, kExitFresnels));
    addFlag(app, "--point-samples", group, "Samples are points, as in the paper, not patches",
            o.pointSamples);
}

void addPathTraced(CLI::App& app, RenderOptions& o) {
    addMediumOptions(app, o.medium);
    const char* group = "Path tracing";
    addOption(app, "--paths",
              {group, "N",
               fmt::format("path-traced: light paths at most, rounded up to whole rounds; default "
                           "{}, with --noise as many as it takes",
                           kUsualPaths)},
              takeInteger(o.paths, 1, kMostPaths));
    addOption(app, "--noise",
              {group, "F", "path-traced: stops when the relative error is this; default 0, never"},
              takeNumber(o.noise, {0.0, 1.0, false}));
}

void require(bool condition, const std::string& subject, const std::string& reason,
             const std::string& remedy) {
    if (!condition) {
        throw UsageError(subject, reason, remedy);
    }
}

void validateMotion(const RenderOptions& o) {
    if (o.sequence) {
        require(o.model.empty(), "--sequence", "its files are the model",
                "leave out MODEL or --sequence");
        require(o.frames.has_value(), "--sequence", "it needs to know which frames",
                "add --frames A:B");
        static_cast<void>(FramePattern("--sequence", *o.sequence));
    }
    if (o.materialTo) {
        require(o.material && !hasFrameField(*o.material) && o.frames, "--material-to",
                "fades from one material over frames", "add --material FILE|NAME and --frames A:B");
    }
    require(!o.fadeFrames || o.materialTo, "--fade-frames", "there is nothing to fade into",
            "add --material-to FILE|NAME");
    require(!(o.timeSeconds && o.frames), "--time", "does not go with --frames",
            "leave one of them out");
    if (o.frames) {
        if (o.frames->count() > 1 || hasFrameField(o.output.string())) {
            static_cast<void>(FramePattern("--output", o.output.string()));
        }
        if (o.material && hasFrameField(*o.material)) {
            static_cast<void>(FramePattern("--material", *o.material));
        }
    } else {
        require(!hasFrameField(o.output.string()), "--output",
                "the name has a place for a frame number, but no frames are asked for",
                "add --frames A:B");
        require(!o.material || !hasFrameField(*o.material), "--material",
                "the name has a place for a frame number, but no frames are asked for",
                "add --frames A:B");
    }
}

void validateView(const RenderOptions& o) {
    require(!(o.millimetersPerUnit && o.diameterMm), "--scale", "does not go with --diameter",
            "leave one of them out");
    require(!(o.viewFrom && o.viewAt) || *o.viewFrom != *o.viewAt, "--view-at",
            "is the same point as --view-from", "move one of them");
    require(!o.viewUp || glm::length(*o.viewUp) > 0.0, "--view-up", "is zero", "give a direction");
    if (o.viewFrom && o.viewAt && o.viewUp) {
        const glm::dvec3 direction = glm::normalize(*o.viewAt - *o.viewFrom);
        require(glm::length(glm::cross(direction, glm::normalize(*o.viewUp))) > 1e-6, "--view-up",
                "runs along the view", "give another direction");
    }
}

} // namespace

const char* solverName(Solver solver) {
    return kSolvers.at(static_cast<std::size_t>(solver)).data();
}
const char* schemeName(Scheme scheme) {
    return kSchemes.at(static_cast<std::size_t>(scheme)).data();
}
const char* qualityName(Quality quality) {
    return kQualities.at(static_cast<std::size_t>(quality)).data();
}
const char* backendName(SplatBackendKind backend) {
    return kBackends.at(static_cast<std::size_t>(backend)).data();
}

std::optional<subedit::Medium> mediumOf(const RenderOptions& options) {
    if (options.medium == MediumOptions{}) {
        return std::nullopt;
    }
    return makeMedium(options.medium, mediumSource(options.medium, "render"));
}

SplatBackendKind parseBackend(const Argument& argument) {
    return static_cast<SplatBackendKind>(parseChoice(argument, kBackends));
}

void addRenderOptions(CLI::App& app, RenderOptions& options) {
    addFiles(app, options);
    addPicture(app, options);
    addView(app, options);
    addLights(app, options);
    addMotion(app, options);
    addMethod(app, options);
    addPathTraced(app, options);
}

void validateRenderOptions(const RenderOptions& o) {
    require(!o.model.empty() || o.sequence, "render", "no model is given",
            "name a file or builtin:NAME; see 'celadon render --help'");
    require(!o.output.empty(), "render", "no output is given", "add -o OUT.exr or OUT.png");
    const ImageFormat format = imageFormat(o.output);
    require(!o.aov || format == ImageFormat::Exr, "--aov", "only EXR holds layers",
            "choose an output that ends in .exr");
    require(!o.environmentBehind || o.environment, "--background environment",
            "there is no environment", "name a map with --environment");
    require(!(o.table && o.epsilon), "--epsilon", "does not go with --table",
            "the table was made for its own");
    const bool hasMedium = mediumOf(o).has_value();
    require(!(hasMedium && o.material), "--material", "does not go with a medium",
            "leave out --material or --preset, --absorption, --albedo");
    require(hasMedium || o.solver != Solver::PathTraced, "--solver path-traced",
            "it follows light in a medium, whose coefficients no SubEdit material holds",
            "give --preset NAME (see 'celadon profile list'), --absorption with "
            "--reduced-scattering, or --albedo with --mean-free-path, instead of --material");
    validateMotion(o);
    validateView(o);
}

int pathCount(const RenderOptions& options) {
    return options.paths.value_or(options.noise > 0.0 ? kMostPaths : kUsualPaths);
}

std::vector<std::string> idleOptions(const RenderOptions& o) {
    std::vector<std::string> idle;
    if (o.solver != Solver::Splatting || o.scheme != Scheme::Hierarchical) {
        return idle;
    }
    const auto add = [&idle](bool isGiven, const char* name) {
        if (isGiven) {
            idle.emplace_back(name);
        }
    };
    add(o.alpha.has_value(), "--alpha");
    // Minimal radii also say which level a pixel has in the layers.
    add(o.epsilon && !o.aov, "--epsilon");
    add(o.table && !o.aov, "--table");
    add(o.discontinuity.has_value(), "--discontinuity");
    add(o.energy && *o.energy < 1.0, "--energy");
    add(!o.orientation, "--no-orientation");
    return idle;
}

std::filesystem::path outputOfFrame(const RenderOptions& options, int frame) {
    const std::string name = options.output.string();
    return hasFrameField(name) ? std::filesystem::path(FramePattern("--output", name).name(frame))
                               : options.output;
}

} // namespace celadon::app
