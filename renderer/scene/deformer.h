#pragma once

#include <glm/glm.hpp>

#include <span>
#include <string_view>
#include <vector>

/// Bends of space after Barr 1984 ("Global and local deformations of solid primitives"), as
/// `--deform` has them (DESIGN section 5): smooth maps of millimeters, applied one after the other
/// to positions, and by their Jacobians to normals. The same in shaders/include/deformer.glsl.
namespace celadon {

/// One deformer. With t from 0 at the low end of the rest box along `axis` to 1 at its high end
/// (and on beyond either), lines through the box's center, b the axis after `axis` (x, y, z, x):
struct Deformer {
    enum class Kind {
        Twist,   ///< turns by `amount` degrees times t about the line along `axis`, from b towards
                 ///< the axis after it
        Bend,    ///< the line along `axis` becomes an arc of its length that turns by `amount`
                 ///< degrees towards b
        Taper,   ///< distances from the line are multiplied by 1 at t = 0 to `amount` at t = 1
        Wave,    ///< moves along b by `amount` mm times sin(2 pi s / wavelengthMm), s in mm
        Inflate, ///< moves along the normal by `amount` mm; edges are mitered
    };
    Kind kind = Kind::Twist;
    int axis = 1; ///< 0 x, 1 y, 2 z; of no meaning to Inflate
    double amount = 0.0;
    double wavelengthMm = 1.0; ///< Wave; above 0
};

/// "twist:AXIS:DEG", "bend:AXIS:DEG", "taper:AXIS:SCALE", "wave:AXIS:AMPLITUDE_MM:WAVELENGTH_MM" or
/// "inflate:MM", AXIS one of x, y, z.
/// @throws UsageError
[[nodiscard]] Deformer parseDeformer(std::string_view text);

/// Axis-aligned, of what scatters at rest, in mm.
struct RestBox {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};

/// @throws UsageError where a deformer's axis is one along which the box has no extent
void checkDeformers(std::span<const Deformer> deformers, const RestBox& box);

/// A vertex on its way through the deformers.
struct DeformedVertex {
    glm::dvec3 position; ///< mm
    glm::dvec3 normal;   ///< unit length, or zero where none is defined
    glm::dvec3 miter;    ///< where Inflate goes, per mm (see miterDirections); used by it alone
};

void deform(std::span<const Deformer> deformers, const RestBox& box, DeformedVertex& vertex);

} // namespace celadon
