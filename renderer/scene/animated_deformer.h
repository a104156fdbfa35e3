#pragma once

#include "renderer/scene/deformer.h"
#include "renderer/scene/keyed_numbers.h"

#include <span>
#include <vector>

/// Deformers as a file or an artist has them: with amounts that may change over time. Lengths that
/// belong to the model are in its units; those that say "Mm" are not.
namespace celadon {

/// A control point that is not at rest.
struct LatticeMove {
    glm::ivec3 point{0};
    KeyedNumbers by = KeyedNumbers::of(glm::dvec3(0.0)); ///< model units
    bool operator==(const LatticeMove&) const = default;
};

/// A part of the rest shape that is held, or moved as one: what lies within `radius` of `at`, at
/// least the vertex next to it (handle_solver.h).
struct Handle {
    glm::dvec3 at{0.0};                                    ///< rest shape, model units
    double radius = 0.0;                                   ///< model units, >= 0
    KeyedNumbers move = KeyedNumbers::of(glm::dvec3(0.0)); ///< model units
    /// Degrees about x, then y, then z, through `at`.
    KeyedNumbers turnDegrees = KeyedNumbers::of(glm::dvec3(0.0));
    bool operator==(const Handle&) const = default;
};

/// A handle at a moment, in mm.
struct PlacedHandle {
    glm::dvec3 at{0.0};
    double radiusMm = 0.0;
    glm::dvec3 to{0.0};   ///< where `at` goes
    glm::dmat3 turn{1.0}; ///< about it
    bool operator==(const PlacedHandle&) const = default;
};

struct AnimatedDeformer {
    AnimatedDeformer() = default;
    /// One that does not change; a lattice's offsets as model units of 1 mm.
    AnimatedDeformer(
        const Deformer& constant); // NOLINT(google-explicit-constructor): the same thing

    Deformer::Kind kind = Deformer::Kind::Twist;
    int axis = 1;
    bool isOn = true;    ///< off: stays in the list and does nothing
    KeyedNumbers amount; ///< degrees, scale or mm, as Deformer::amount
    KeyedNumbers wavelengthMm = KeyedNumbers::of(1.0); ///< Wave; every key above 0
    std::optional<glm::dvec2> range;
    glm::ivec3 latticeSize{3};      ///< Lattice: 2 ... kMaxLatticePoints along each axis
    std::vector<LatticeMove> moves; ///< Lattice: each point at most once
    std::vector<Handle> handles;    ///< Handles: at least one

    /// @param millimetersPerUnit of the model; times from the stack's own start, which no loop
    ///        brings back
    [[nodiscard]] Deformer at(double seconds, double millimetersPerUnit) const;
    [[nodiscard]] std::vector<PlacedHandle> handlesAt(double seconds,
                                                      double millimetersPerUnit) const;
    /// The last key of all; 0: nothing is keyed.
    [[nodiscard]] double lastSeconds() const;

    bool operator==(const AnimatedDeformer&) const = default;
};

using DeformerStack = std::vector<AnimatedDeformer>;

/// "twist", "lattice", ...: as the command line and files say it.
[[nodiscard]] const char* deformerName(Deformer::Kind kind);
/// What its amount is called in files: "angleDegrees"; null where it has none.
[[nodiscard]] const char* amountName(Deformer::Kind kind);

} // namespace celadon
