#pragma once

#include "subedit/edit/profile_editor.h"

#include <optional>
#include <vector>

/// A larger maximum scattering radius r_s for a whole map, for edits whose profiles reach beyond
/// it. Knots are added at the same spacing, so that every texel keeps its knots bit for bit.
namespace celadon::subedit {

/// How far edits may grow r_s: to this many times what the document opened with, and to
/// kMaxSegments segments.
inline constexpr float kLargestGrowth = 4.0f;

/// The largest r_s that maps of this layout may grow to.
[[nodiscard]] float largestRadiusMm(const ProfileLayout& opened);

/// The layout to grow to: knots at the same spacing, a quarter more of them at a time, so that a
/// stroke that reaches farther and farther does not grow the map with every dab.
/// @param neededMm   <= largestMm
/// @return           nothing if r_s is large enough already
[[nodiscard]] std::optional<ProfileLayout> grownLayout(const ProfileLayout& layout, float neededMm,
                                                       float largestMm);

/// One texel in the larger layout: P stays what it was up to the old r_s and falls to the floor
/// within a segment. Where that tail brings more than 1e-4 of a channel's albedo, or one above 1,
/// the channel is scaled back to the albedo it had.
/// @return whether any but the new knots changed
bool growProfile(const float* before, const ProfileLayout& from, ProfileEditor& editorOfLarger,
                 const ProfileLayout& to, float* after);

/// What undoing needs.
struct Growth {
    ProfileLayout from;
    ProfileLayout to;
    std::vector<std::uint32_t> changedTexels; ///< those whose old knots changed, ascending
    std::vector<float> before;                ///< their profiles in the old layout
};

/// Grows the map. @param to segments > those of the map, at the same spacing
[[nodiscard]] Growth growRadius(MaterialMap& map, const ProfileLayout& to);

/// Undoes growRadius() exactly, if the texels are as it left them.
void undoGrowth(MaterialMap& map, const Growth& growth);

} // namespace celadon::subedit
