#pragma once

#include "subedit/map/material_map.h"
#include "subedit/paint/brush.h"
#include "subedit/paint/surface.h"
#include "subedit/select/propagation.h"
#include "subedit/select/weight_mask.h"

#include <array>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

/// Ways to say which texels are meant. Lengths are along the surface, in mm.
namespace celadon::subedit {

struct SelectAll {
    bool operator==(const SelectAll&) const = default;
};
struct SelectNone {
    bool operator==(const SelectNone&) const = default;
};
struct InvertSelection {
    bool operator==(const InvertSelection&) const = default;
};
/// A brush whose paint is selection.
struct SelectStroke {
    Brush brush;
    Mirror mirror;
    std::vector<StrokePoint> path;
    bool operator==(const SelectStroke&) const = default;
};
/// Texels whose profile is like that at a point (profile_distance.h): all of it up to
/// (1 - softness) tolerance, nothing from `tolerance` on; times a smooth falloff to zero at
/// `withinMm` from the point, if given.
struct SelectSimilar {
    StrokePoint point;
    float tolerance = 0.1f; ///< D, in (0, 1]
    float softness = 0.5f;  ///< in [0, 1]
    std::optional<float> withinMm;
    bool operator==(const SelectSimilar&) const = default;
};
/// Each texel gets the largest weight within a distance.
struct GrowSelection {
    float distanceMm = 1.0f;
    bool operator==(const GrowSelection&) const = default;
};
/// Each texel gets the smallest weight within a distance.
struct ShrinkSelection {
    float distanceMm = 1.0f;
    bool operator==(const ShrinkSelection&) const = default;
};
/// A soft edge: from all to nothing over twice the distance, centered on the edge that was there.
struct FeatherSelection {
    float distanceMm = 1.0f;
    bool operator==(const FeatherSelection&) const = default;
};

using SelectionStep =
    std::variant<SelectAll, SelectNone, InvertSelection, SelectStroke, SelectSimilar, Propagation,
                 GrowSelection, ShrinkSelection, FeatherSelection>;

/// As in files, in the order of SelectionStep.
inline constexpr std::array<std::string_view, std::variant_size_v<SelectionStep>>
    kSelectionStepNames{"all",       "none", "invert", "stroke", "similar",
                        "propagate", "grow", "shrink", "feather"};

[[nodiscard]] inline std::string_view selectionStepName(const SelectionStep& step) {
    return kSelectionStepNames[step.index()];
}

/// How a stroke, similarity or propagation joins what is selected.
enum class SelectMode { Replace, Add, Subtract, Intersect };
inline constexpr std::array<std::string_view, 4> kSelectModeNames{"replace", "add", "subtract",
                                                                  "intersect"};

/// The selection after a step.
/// @param mode of those steps that find texels; the others act on the whole selection
/// @throws InputError: a point that lies on no texel
[[nodiscard]] WeightMask select(const MaterialMap& map, const Surface& surface,
                                const WeightMask& selection, const SelectionStep& step,
                                SelectMode mode);

} // namespace celadon::subedit
