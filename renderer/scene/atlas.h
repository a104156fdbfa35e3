#pragma once

#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

/// Automatic texture atlas for models without texture coordinates (DESIGN section 2): charts,
/// flattened, packed with gutters. Deterministic: the same triangles give the same bytes.
namespace celadon {

struct AtlasSettings {
    int resolution = 1024; ///< texels on a side that the gutters are meant for
    int gutterTexels = 4;  ///< least distance between charts, and to the border, at `resolution`
};

/// New vertices for one mesh: vertices are split where charts meet.
struct AtlasMesh {
    std::vector<std::uint32_t> sourceVertex; ///< new vertex -> vertex of the input mesh
    std::vector<glm::vec2> uvs;              ///< per new vertex, in [0, 1], v down
    std::vector<std::uint32_t> indices;      ///< same triangles in the same order as the input
    std::vector<std::uint32_t> chartOfTriangle;
};

struct AtlasReport {
    int charts = 0;
    int gutterTexels = 0;  ///< held; less than asked for only if so many charts leave no choice
    double coverage = 0.0; ///< part of the unit square that triangles cover
    double areaDistortionMean =
        0.0; ///< area-weighted mean of max(s, 1/s), s = relative texel density (area ratio), >= 1
    double areaDistortionMax = 0.0; ///< 99.9th percentile (area-weighted) of the same
};

struct Atlas {
    std::vector<AtlasMesh> meshes; ///< one per input mesh
    AtlasReport report;
};

/// All meshes share one unit square. Vertices at equal positions are taken as joined.
/// @throws InputError when a mesh has no triangle of positive area at all
[[nodiscard]] Atlas generateAtlas(std::span<const Mesh* const> meshes,
                                  const AtlasSettings& settings = {});

/// Applies: vertices are split, `uvs` replaced, normals, uvs1 and colors carried along.
void applyAtlas(const AtlasMesh& atlas, Mesh& mesh);

} // namespace celadon
