#pragma once

#include "renderer/scene/world.h"

#include <glm/vec2.hpp>

#include <array>
#include <string>
#include <vector>

/// The scenes of Chen et al. 2012, Table 1: triangle counts, map sizes and scattering ranges of the
/// paper; models from the folder that CELADON_MODELS names, else builtins.
namespace celadon::app {

/// Surface albedo and index of refraction of the scenes' materials.
inline constexpr glm::dvec3 kBenchAlbedo{0.85, 0.75, 0.6};
inline constexpr double kBenchEta = 1.3;

struct BenchScene {
    std::string name;  ///< the paper's object
    std::string model; ///< below CELADON_MODELS
    std::string standIn;
    std::size_t triangles; ///< the model is brought to as many (triangle_count.h); 0: its own
    glm::ivec2 mapSize;
    glm::dvec2 range;               ///< R_P, least and greatest, in bounding sphere radii
    bool hasCells;                  ///< a chessboard; else smooth noise
    std::array<double, 4> paperFps; ///< none, multires, adaptive, full; 0: not in the paper
    std::string deformation{};      ///< as for --deform; empty: at rest
};

/// @param suite "table1" or "quick" @throws UsageError
[[nodiscard]] std::vector<BenchScene> benchScenes(const std::string& suite);

/// Whether its model is not where CELADON_MODELS says, so that a builtin stands in.
[[nodiscard]] bool isModelMissing(const BenchScene& scene);
/// Where models are looked for, as words of a sentence: "in '/models', where CELADON_MODELS
/// points", or what to set.
[[nodiscard]] std::string modelFolderMessage();

struct BenchWorld {
    World world;
    std::string model; ///< what was taken
    bool isStandIn = false;
    std::size_t triangles = 0;
};

/// @throws InputError for a model that is there but cannot be read
[[nodiscard]] BenchWorld loadBenchWorld(const BenchScene& scene);

/// A map whose texels' R_P spans the range: normalized diffusion, three channels of ranges
/// 1, 0.8 and 0.65 of the texel's.
[[nodiscard]] MaterialPointer benchMaterial(const BenchScene& scene, double boundingRadiusMm);

} // namespace celadon::app
