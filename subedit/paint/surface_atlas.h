#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

/// Where the texels of a material's map lie on the surface that wears it: what painting in space
/// needs to know of a model, and all it knows. Made by whoever has the model (for the renderer:
/// renderer/scene/surface_atlas_of_world.h), or flat.
namespace celadon::subedit {

struct SurfaceAtlas {
    int width = 0;
    int height = 0;
    /// Of the texel's center, mm: [height][width]; anything where nothing is covered.
    std::vector<glm::vec3> positionMm;
    std::vector<glm::vec3> normal; ///< unit length, shape as above
    /// Which connected piece of the surface's parameterization covers the texel's center, from 0;
    /// -1: none. Neighbors on the map are neighbors on the surface only within a chart.
    std::vector<std::int32_t> chart;
    /// Texels that more than one piece of surface covers; the first piece has them.
    std::size_t overlaps = 0;
};

/// A flat square or rectangle: u along x, v along -y, facing z, its top left corner at (0, 0, 0).
/// What edits of a material without a model take place on.
[[nodiscard]] SurfaceAtlas makeFlatSurface(int width, int height, float widthMm);

} // namespace celadon::subedit
