#include "subedit/edit/profile_editor.h"

#include "subedit/assert.h"

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

/// Shape of a texel that never scattered, r_s / (its 1/e length).
constexpr float kDefaultLengths = 8.0f;

} // namespace

void resampleChannel(const float* in, int inSegments, float inSpacingMm, float scale, float* out,
                     int outSegments, float outSpacingMm) {
    const float step = outSpacingMm / (scale * inSpacingMm);
    const float shift = -2.0f * std::log(scale);
    for (int k = 0; k <= outSegments; ++k) {
        const float position = static_cast<float>(k) * step;
        // Beyond the last knot along its last segment, were it to go on; never upwards.
        const int i = std::min(static_cast<int>(position), inSegments - 1);
        const float slope = in[(i + 1) * 3] - in[i * 3];
        const float t = position - static_cast<float>(i);
        const float value = t <= 1.0f ? in[i * 3] + slope * t
                                      : in[(i + 1) * 3] + std::min(slope, 0.0f) * (t - 1.0f);
        out[k * 3] = std::max(value + shift, kLogProfileFloor);
    }
}

std::vector<float> resampleProfile(const StoredProfile& profile, const ProfileLayout& layout) {
    if (profile.segments == layout.segments && profile.maxRadiusMm == layout.maxRadiusMm) {
        return profile.logProfile;
    }
    const float inSpacing = profile.maxRadiusMm / static_cast<float>(profile.segments);
    ProfileEditor source({profile.segments, profile.maxRadiusMm});
    source.load(profile.logProfile.data());
    ProfileEditor result(layout);
    for (int c = 0; c < 3; ++c) {
        resampleChannel(profile.logProfile.data() + c, profile.segments, inSpacing, 1.0f,
                        result.values() + c, layout.segments, layout.spacingMm());
    }
    result.measure();
    for (int c = 0; c < 3; ++c) {
        if (!result.isBlack(c)) {
            result.setAlbedo(c, source.albedo()[c]);
        }
    }
    return {result.result(), result.result() + layout.values()};
}

float heldRadiusMm(const StoredProfile& profile) {
    ProfileEditor editor({profile.segments, profile.maxRadiusMm});
    editor.load(profile.logProfile.data());
    return std::max({editor.radiusMm(0, kHeldEnergy), editor.radiusMm(1, kHeldEnergy),
                     editor.radiusMm(2, kHeldEnergy)});
}

ProfileEditor::ProfileEditor(const ProfileLayout& layout)
    : mLayout(layout), mEnergy(layout.segments), mValues(layout.values()), mOther(layout.values()) {
    CELADON_ASSERT(layout.segments >= 1 && layout.segments <= kMaxSegments &&
                   layout.maxRadiusMm > 0.0f);
}

void ProfileEditor::load(const float* logProfile) {
    std::copy_n(logProfile, mLayout.values(), mValues.data());
    measure();
}

void ProfileEditor::measure() {
    mEnergy.compute(mValues.data());
    for (int c = 0; c < 3; ++c) {
        mAlbedo[c] = mEnergy.albedo(c, mLayout.spacingMm());
    }
    mIsMeasured = true;
}

float ProfileEditor::radiusMm(int channel, float fraction) const {
    CELADON_ASSERT(mIsMeasured);
    const float h = mLayout.spacingMm();
    return h * mEnergy.channelRadius(mValues.data(), channel, fraction, TexelEnergy::blackTotal(h));
}

void ProfileEditor::setAlbedo(int channel, float albedo) {
    float* values = mValues.data() + channel;
    const int knots = mLayout.knots();
    if (albedo < kBlackAlbedo) {
        for (int k = 0; k < knots; ++k) {
            values[k * 3] = kLogProfileFloor;
        }
        mAlbedo[channel] = 0.0f;
        mIsMeasured = false;
        return;
    }
    if (isBlack(channel)) {
        int brightest = 0;
        for (int c = 1; c < 3; ++c) {
            brightest = mAlbedo[c] > mAlbedo[brightest] ? c : brightest;
        }
        const bool isAllBlack = isBlack(brightest);
        for (int k = 0; k < knots; ++k) {
            values[k * 3] = isAllBlack ? -kDefaultLengths * static_cast<float>(k) /
                                             static_cast<float>(mLayout.segments)
                                       : mValues[static_cast<std::size_t>(k * 3 + brightest)];
        }
        mEnergy.compute(mValues.data());
        mAlbedo[channel] = mEnergy.albedo(channel, mLayout.spacingMm());
    }
    const float shift = std::log(albedo / mAlbedo[channel]);
    for (int k = 0; k < knots; ++k) {
        values[k * 3] = std::max(values[k * 3] + shift, kLogProfileFloor);
    }
    mAlbedo[channel] = albedo;
    mIsMeasured = false;
}

void ProfileEditor::scaleRange(const glm::vec3& scale) {
    const glm::vec3 albedo = mAlbedo;
    bool isChanged = false;
    for (int c = 0; c < 3; ++c) {
        if (scale[c] == 1.0f || isBlack(c)) {
            continue;
        }
        isChanged = true;
        resampleChannel(mValues.data() + c, mLayout.segments, mLayout.spacingMm(), scale[c],
                        mOther.data() + c, mLayout.segments, mLayout.spacingMm());
        for (int k = 0; k < mLayout.knots(); ++k) {
            const auto i = static_cast<std::size_t>(k * 3 + c);
            mValues[i] = mOther[i];
        }
    }
    if (!isChanged) {
        return;
    }
    measure();
    for (int c = 0; c < 3; ++c) {
        if (mAlbedo[c] != albedo[c] && !isBlack(c)) {
            setAlbedo(c, albedo[c]);
        }
    }
}

} // namespace celadon::subedit
