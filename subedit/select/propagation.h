#pragma once

#include "subedit/map/material_map.h"
#include "subedit/paint/brush.h"
#include "subedit/paint/surface.h"
#include "subedit/select/weight_mask.h"

#include <optional>
#include <vector>

/// From a few rough strokes to the whole map (An and Pellacini 2008, "AppProp: all-pairs
/// appearance-space edit propagation"): texels of like profile and near position get like weights.
namespace celadon::subedit {

/// A rough stroke: "this much here".
struct Scribble {
    Brush brush;
    Mirror mirror;
    std::vector<StrokePoint> path;
    float strength = 1.0f; ///< weight wanted where it lies, in [0, 1]; 0: leave this alone
    bool operator==(const Scribble&) const = default;
};

struct Propagation {
    std::vector<Scribble> scribbles;
    float similarity = 0.1f;         ///< D (profile_distance.h) at which affinity has fallen to 1/e
    std::optional<float> distanceMm; ///< the same for distance in space; none: it does not matter
    bool operator==(const Propagation&) const = default;
};

/// Minimizes, over weights e in [0, 1],
///     sum_ij z_ij w_j (e_i - g_j)^2 + lambda sum_ij z_ij (e_i - e_j)^2 + mu sum_i e_i^2,
/// w_j and g_j what the scribbles say of texel j, z_ij = exp(-D_ij^2 / similarity^2
/// - |x_i - x_j|^2 / distance^2), eq. 2 of the paper; the last term, which is ours, leaves texels
/// that resemble no scribble alone. z is taken in a basis of some 60 texels (Nystroem), so that the
/// solve costs what evaluating the basis costs.
/// @return one weight per texel; background has that of its source. All zero if no scribble meets
///         the surface.
[[nodiscard]] WeightMask propagate(const MaterialMap& map, const Surface& surface,
                                   const Propagation& propagation);

} // namespace celadon::subedit
