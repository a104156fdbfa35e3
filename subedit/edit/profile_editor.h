#pragma once

#include "subedit/edit/edit_operator.h"
#include "subedit/map/material_map.h"
#include "subedit/texel_energy.h"

#include <array>
#include <vector>

/// One texel's profile taken apart and changed: albedo, range, shape. The steps that operators are
/// made of, in single precision and in a fixed order: the same input gives the same bits.
namespace celadon::subedit {

/// How the profiles of a map are stored.
struct ProfileLayout {
    int segments = 0;
    float maxRadiusMm = 0.0f; ///< r_s
    [[nodiscard]] int knots() const { return segments + 1; }
    [[nodiscard]] std::size_t values() const { return static_cast<std::size_t>(knots()) * 3; }
    [[nodiscard]] float spacingMm() const { return maxRadiusMm / static_cast<float>(segments); }
    bool operator==(const ProfileLayout&) const = default;
};

[[nodiscard]] inline ProfileLayout layoutOf(const MaterialMap& map) {
    return {map.segments, map.maxRadiusMm};
}

/// Edited profiles keep at most this much energy: 1, less what rounding of ln P may add.
inline constexpr float kLargestAlbedo = 1.0f - 4e-6f;
/// A profile fits within r_s if this part of its energy does; the rest, as everywhere in the
/// program (BakeSettings::heldEnergy), is given back to what is stored.
inline constexpr float kHeldEnergy = 0.999f;

/// ln P at knots that lie `outSpacingMm` apart, of a profile whose channels are scaled in range by
/// s: P(r / s) / s^2, linear in ln P between the knots given and on beyond the last of them.
/// @param in, out knots x 3, out with room for TexelEnergy::wholeVectors; not the same memory
void resampleChannels(const float* in, int inSegments, float inSpacingMm, const glm::vec3& scale,
                      float* out, int outSegments, float outSpacingMm);

/// The profile at the layout's knots; each channel keeps its albedo. The same layout: a copy.
[[nodiscard]] std::vector<float> resampleProfile(const StoredProfile& profile,
                                                 const ProfileLayout& layout);

/// Radius that holds kHeldEnergy of the profile's longest channel, mm.
[[nodiscard]] float heldRadiusMm(const StoredProfile& profile);

class ProfileEditor {
public:
    explicit ProfileEditor(const ProfileLayout& layout);

    /// Starts on a texel. @param logProfile knots x 3; copied
    void load(const float* logProfile);
    [[nodiscard]] const float* result() { return mEnergy.logProfile(); }
    [[nodiscard]] float* values() { return mEnergy.logProfile(); }

    /// Of the profile as load() found it, or as the last step left it.
    [[nodiscard]] const glm::vec3& albedo() const { return mAlbedo; }
    [[nodiscard]] bool isBlack(int channel) const { return mAlbedo[channel] < kBlackAlbedo; }
    /// Radius that holds this part of a channel's energy, mm; 0 if it is black.
    [[nodiscard]] float radiusMm(int channel, float fraction) const;
    /// A radius that holds as much or more, at most a segment beyond: quicker.
    [[nodiscard]] float radiusBoundMm(int channel, float fraction) const;

    /// Scales P so that a channel has this albedo. A black channel first takes its shape from the
    /// brightest other one, or an exponential if there is none.
    void setAlbedo(int channel, float albedo);
    /// The same of all channels; those that have theirs stay as they are.
    void setAlbedo(const glm::vec3& albedo);
    /// P(r / s) / s^2 in each channel, at the same albedo. Without effect on a black channel.
    void scaleRange(const glm::vec3& scale);
    /// The first knots become what gives the channels these albedos, all others staying: what a
    /// profile that falls steeply at first needs after its knots have moved. Black channels, and
    /// those that have their albedo, are left alone. Where no such knot exists, and in any case for
    /// the last digits, P is scaled afterwards.
    void fitFirstKnots(const glm::vec3& albedo);
    /// `values()` were written to: measures anew.
    void measure();

private:
    void takeAlbedo();
    void fillBlack(int channel);

    ProfileLayout mLayout;
    TexelEnergy mEnergy;
    glm::vec3 mAlbedo{0.0f};
    std::vector<float> mOther; ///< working memory
};

} // namespace celadon::subedit
