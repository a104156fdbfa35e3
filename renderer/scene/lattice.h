#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

/// Free-form deformation (Sederberg, Parry 1986, "Free-form deformation of solid geometric
/// models"): a grid of control points over the rest box moves what is within by trivariate
/// Bernstein polynomials. Beyond the box each polynomial goes on along its tangent, so that nothing
/// tears or shoots away at its border. The same in shaders/include/lattice.glsl.
namespace celadon {

/// Axis-aligned, of what scatters at rest, in mm.
struct RestBox {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};

/// A map of space and its linear part at a point.
struct Mapped {
    glm::dvec3 position;
    glm::dmat3 jacobian{1.0}; ///< column j: derivative by coordinate j
};

inline constexpr int kMaxLatticePoints = 8; ///< along an axis; at least 2

struct Lattice {
    glm::ivec3 size{0};              ///< control points along x, y, z; zero: no lattice
    std::vector<glm::dvec3> offsets; ///< [z][y][x], mm from where the grid has them at rest

    [[nodiscard]] std::size_t index(const glm::ivec3& point) const {
        return static_cast<std::size_t>((point.z * size.y + point.y) * size.x + point.x);
    }
    /// Where a control point is at rest.
    [[nodiscard]] glm::dvec3 place(const glm::ivec3& point, const RestBox& box) const {
        return box.low + (box.high - box.low) * glm::dvec3(point) / glm::dvec3(size - 1);
    }
};

/// @param box with an extent along every axis
[[nodiscard]] Mapped mapThrough(const Lattice& lattice, const RestBox& box, const glm::dvec3& p);

/// Whether it leaves nothing of the box's volume, anywhere: points in one plane, line or place.
[[nodiscard]] bool flattensAll(const Lattice& lattice, const RestBox& box);

} // namespace celadon
