#pragma once

#include "renderer/gather/gather_materials.h"
#include "renderer/gather/sample_tree.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>

/// Splatting turned around: each tile of pixels gathers the samples that reach it, from the tree,
/// at each level of the splatting buffer. The same sums as the raster path (DESIGN 3.3). No GL
/// here.
namespace celadon {

/// One level of the splatting buffer: RGBA, rows from the bottom.
struct ViewTexels {
    glm::ivec2 size{0};
    const float* positions = nullptr; ///< xyz mm, view depth; 0 depth: background
    const float* surfaces = nullptr;  ///< u, v, material (< 0: not scattering), R_P
    float* exitance = nullptr;        ///< 1e-6 W/mm^2, that is W/m^2; alpha counts pairs. Added to
};

struct GatherSettings {
    bool hierarchical = true;
    bool multiresolution = true;
    float fade = 0.6f;        ///< b
    float pixelAngle = 0.2f;  ///< theta_p
    glm::mat4 view{1.0f};     ///< world mm to view, -z forward
    float pixelScale = 0.0f;  ///< width of a pixel of level 0 at view depth z:
    float pixelOffset = 0.0f; ///< z * pixelScale + pixelOffset, mm
    /// Paper: Rbar(T) of a material (eq. 14).
    std::function<float(float pixelsPerRadius, int material)> minimalRadius;
};

/// Adds what the tree's samples bring to one level of the splatting buffer. @return pairs
/// @param level  which of `levelCount`
std::uint64_t gatherLevel(const SampleTree& tree, const GatherMaterials& materials,
                          const ViewTexels& view, int level, int levelCount,
                          const GatherSettings& settings);

} // namespace celadon
