#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// What `--stats` reports (DESIGN section 5): plain numbers that solvers fill in and that
/// toJson() prints. A number that a solver does not measure stays NaN and is printed as null.
namespace celadon {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Wall clock around finished work on software drivers, timer queries on GPUs.
struct StageMilliseconds {
    double deformation = kNotMeasured;
    double irradianceBuffer = kNotMeasured;
    double splattingBuffer = kNotMeasured;
    double selection = kNotMeasured;
    std::vector<double> splatting; ///< per splatting level, finest first
    double accumulation = kNotMeasured;
    double shading = kNotMeasured;
    double total = kNotMeasured;
};

struct SampleCounts {
    std::uint64_t candidates = 0;        ///< lit texels of all levels, all lights
    std::vector<std::uint64_t> selected; ///< per irradiance level, finest first
    std::uint64_t pairs = 0;             ///< sample-pixel pairs evaluated
};

struct FluxTotals {
    std::array<double, 3> lit{};      ///< W, of lit level-0 texels
    std::array<double, 3> selected{}; ///< W, of selected samples
};

/// Of the visible scattering surface.
struct EffectiveRadiusRange {
    double minMm = kNotMeasured;
    double meanMm = kNotMeasured;
    double maxMm = kNotMeasured;
    double meanPixels = kNotMeasured; ///< the mean radius as seen in the picture
};

/// What a reference says of its own error.
struct ReferenceError {
    double relativeError = kNotMeasured; ///< standard error over the exitance, root mean squares
    std::uint64_t paths = 0;             ///< path-traced: light paths
    double lostFlux = kNotMeasured;      ///< path-traced: part that went out through holes
};

struct FrameStats {
    int frame = 0;
    StageMilliseconds milliseconds;
    SampleCounts samples;
    FluxTotals flux;
    EffectiveRadiusRange effectiveRadius;
    ReferenceError reference; ///< JSON has it where it was measured
};

struct RenderStats {
    std::string contextKind;     ///< "egl", "osmesa", "glfw"; "none" where no GL was used
    std::string contextRenderer; ///< GL_RENDERER
    std::string contextVersion;  ///< GL_VERSION
    std::string solver;          ///< as on the command line, and so on
    std::string scheme;
    std::string backend;
    int width = 0;
    int height = 0;
    int irradianceSize = 0;
    int irradianceLevels = 0;
    int splattingLevels = 0; ///< JSON "levels" is one number where both agree, else the two
    double millimetersPerUnit = 1.0;
    std::vector<FrameStats> frames;
};

/// Indented JSON with a final newline, keys in the order and spelling of DESIGN section 5
/// ("millimetresPerUnit"). Infinite and NaN numbers become null.
[[nodiscard]] std::string toJson(const RenderStats& stats);

} // namespace celadon
