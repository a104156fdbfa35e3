#pragma once

#include "renderer/scene/lattice.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <string_view>

/// Bends of space after Barr 1984 ("Global and local deformations of solid primitives") and
/// free-form lattices, as `--deform` has them (DESIGN section 5): smooth maps of millimeters,
/// applied one after the other to positions, and by their Jacobians to normals. The same in
/// shaders/include/deformer.glsl. How they change over time: animated_deformer.h.
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
        Lattice, ///< `lattice` over the rest box
        Handles, ///< does nothing here: handles move the rest shape (handle_binding.h)
    };
    Kind kind = Kind::Twist;
    int axis = 1; ///< 0 x, 1 y, 2 z; of no meaning to Inflate, Lattice and Handles
    double amount = 0.0;
    double wavelengthMm = 1.0; ///< Wave; above 0
    /// Of Twist, Bend, Taper, Wave: t runs from 0 to 1 between these parts of the box, low < high,
    /// and what lies beyond only goes along. Unset: all of the box, and on beyond.
    std::optional<glm::dvec2> range;
    Lattice lattice;
};

/// "twist:AXIS:DEG", "bend:AXIS:DEG", "taper:AXIS:SCALE", "wave:AXIS:AMPLITUDE_MM:WAVELENGTH_MM",
/// each with ":FROM,TO" after it or not, or "inflate:MM"; AXIS one of x, y, z.
/// @throws UsageError
[[nodiscard]] Deformer parseDeformer(std::string_view text);

/// @throws UsageError where a deformer needs an extent that the box does not have; InputError for a
///         lattice that flattens everything
void checkDeformers(std::span<const Deformer> deformers, const RestBox& box);

/// A vertex on its way through the deformers.
struct DeformedVertex {
    glm::dvec3 position; ///< mm
    glm::dvec3 normal;   ///< unit length, or zero where none is defined
    glm::dvec3 miter;    ///< where Inflate goes, per mm (see miterDirections); used by it alone
};

void deform(std::span<const Deformer> deformers, const RestBox& box, DeformedVertex& vertex);

} // namespace celadon
