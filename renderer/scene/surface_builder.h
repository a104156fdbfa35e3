#pragma once

#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Puts the builtin sculptures together from patches. Patches join where their border vertices have
/// equal positions: the maker computes those from equal numbers, so that they are equal to the bit.
namespace celadon {

struct SurfacePoint {
    glm::dvec3 position{0.0}; ///< mm
    glm::dvec2 chart{0.0};    ///< mm in the plane of all charts, y down
};

class SurfaceBuilder {
public:
    std::uint32_t add(const SurfacePoint& point);
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    /// Quads a, b, c, d in the order of a counter-clockwise front, cut along the shorter diagonal.
    void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

    /// (columns + 1) x (rows + 1) points; the front is where columns go right and rows go down.
    void addGrid(int columns, int rows,
                 const std::function<SurfacePoint(int column, int row)>& point);

    /// Two rows of points joined, the upper one with twice the segments of the lower one.
    void addHalving(const std::vector<std::uint32_t>& upper,
                    const std::vector<std::uint32_t>& lower);

    /// Normals angle-weighted over vertices at equal positions; triangles without area left out;
    /// the charts' plane scaled to the unit square.
    /// @param chartSideMm side of the square of the charts' plane that becomes the texture
    [[nodiscard]] Scene finish(const std::string& name, double chartSideMm) const;

private:
    std::vector<SurfacePoint> mPoints;
    std::vector<std::uint32_t> mIndices;
};

} // namespace celadon
