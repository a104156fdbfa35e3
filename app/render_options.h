#pragma once

#include "app/argument.h"
#include "app/profile/medium_options.h"
#include "renderer/frame_quality.h"
#include "renderer/gl/context.h"
#include "renderer/output/tone_map.h"
#include "renderer/shading/fresnel.h"
#include "renderer/splatting/splatting_settings.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The options of `celadon render` (DESIGN section 5), parsed and checked, each on its own and
/// against the others. What is unset takes a default that depends on the scene, on the quality or
/// on the scheme; the command decides.
namespace celadon::app {

enum class Solver { Splatting, ImageReference, SurfaceReference, PathTraced };

[[nodiscard]] const char* solverName(Solver solver);
[[nodiscard]] const char* schemeName(Scheme scheme);
[[nodiscard]] const char* qualityName(Quality quality);
[[nodiscard]] const char* backendName(SplatBackendKind backend);
/// @throws UsageError
[[nodiscard]] SplatBackendKind parseBackend(const Argument& argument);

struct RenderOptions {
    // Input and output
    std::string model; ///< a file or builtin:NAME; empty where `sequence` is set
    std::filesystem::path output;
    std::optional<std::string> material;   ///< a file, a shipped name, or a pattern of frames
    std::optional<std::string> materialTo; ///< what `material` fades into
    std::optional<FrameRange> fadeFrames;  ///< while; default: all frames
    std::optional<std::filesystem::path> stats;
    bool aov = false;

    // Picture
    glm::ivec2 size{800, 600};
    int samples = 4; ///< coverage samples a pixel
    double exposureEv = 0.0;
    ToneMap toneMap = ToneMap::Neutral;
    std::optional<glm::vec3> background; ///< linear; unset: transparent, or the environment
    bool environmentBehind = false;      ///< --background environment
    bool specular = true;

    // View and size
    std::optional<glm::dvec3> viewFrom, viewAt, viewUp; ///< model units
    std::optional<double> fovYDegrees;
    std::optional<double> millimetersPerUnit, diameterMm; ///< at most one of them

    // Lights
    std::vector<std::string> lights; ///< "directional:...", as given
    std::optional<std::filesystem::path> environment;
    int environmentLights = 64;

    // Motion
    std::optional<std::string> animation; ///< name or number
    std::optional<double> timeSeconds;
    std::optional<FrameRange> frames;
    double framesPerSecond = 24.0;
    std::optional<std::string> sequence;   ///< a checked pattern of frames
    std::vector<std::string> deformations; ///< "twist:y:90" or a file, as given, in order

    // Method
    Solver solver = Solver::Splatting;
    Scheme scheme = Scheme::Hierarchical;
    Quality quality = Quality::Default;
    SplatBackendKind backend = SplatBackendKind::Auto;
    gl::ContextKind context = gl::ContextKind::Auto;
    std::optional<LevelCounts> levels;
    std::optional<int> irradianceSize;
    std::optional<double> alpha;
    std::optional<double> epsilon;
    std::optional<std::filesystem::path> table; ///< of minimal radii, instead of the materials' own
    std::optional<double> discontinuity;        ///< z_0 in bounding sphere radii
    std::optional<double> energy;
    bool orientation = true;
    bool adaptive = true;
    bool multiresolution = true;
    ExitFresnel exitFresnel = ExitFresnel::Exact;
    bool pointSamples = false;

    // A homogeneous medium instead of a material, and how long paths are traced in it
    MediumOptions medium;
    std::optional<int> paths; ///< default: see pathCount()
    double noise = 0.0; ///< 0: all paths
};

/// The medium that is asked for; unset where none is. @throws UsageError
[[nodiscard]] std::optional<subedit::Medium> mediumOf(const RenderOptions& options);
/// As many as --noise takes, if that alone is given.
[[nodiscard]] int pathCount(const RenderOptions& options);

/// Registers every option of the struct. Values are checked while the command line is parsed.
void addRenderOptions(CLI::App& app, RenderOptions& options);

/// What options must have together or must not have: call after parsing.
/// @throws UsageError
void validateRenderOptions(const RenderOptions& options);

/// Options that were given and change nothing, since they act in the other scheme of splatting.
[[nodiscard]] std::vector<std::string> idleOptions(const RenderOptions& options);

/// The picture of a frame: `output` itself where it has no field for the number.
[[nodiscard]] std::filesystem::path outputOfFrame(const RenderOptions& options, int frame);

} // namespace celadon::app
