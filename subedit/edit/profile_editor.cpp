#include "subedit/edit/profile_editor.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"
#include "subedit/fast_log.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

/// The first segment's energy E = e^l0 M_1(l1 - l0) in units of h^2 (log_linear.h).
struct FirstSegment {
    float logEnergy;
    float slope; ///< d ln E / d l0 = 1 - M_2 / M_1, M_2 the moment of s^2
};

FirstSegment firstSegment(float l0, float l1) {
    const float z = l1 - l0;
    float m1 = 0.0f;
    float m2 = 0.0f;
    if (std::abs(z) < 0.5f) {
        m1 = 1.0f / 2 +
             z * (1.0f / 3 + z * (1.0f / 8 + z * (1.0f / 30 + z * (1.0f / 144 + z / 840))));
        m2 = 1.0f / 3 + z * (1.0f / 4 + z * (1.0f / 10 + z * (1.0f / 36 + z / 168)));
    } else {
        const float e = fastExp(z);
        const float inverse = 1.0f / z;
        m1 = (e - (e - 1.0f) * inverse) * inverse;
        m2 = (e - 2.0f * m1) * inverse;
    }
    return {l0 + fastLog(m1), std::clamp(1.0f - m2 / m1, 0.2f, 1.0f)};
}

/// The l0 of a given ln E, which grows with it, by Newton; to 1e-5, where scaling the whole profile
/// by the rest changes nothing that can be seen.
/// @param start firstSegment() of the l0 given
float solveFirstKnot(float l0, float l1, FirstSegment start, float logEnergy) {
    for (int i = 0; i < 8; ++i) {
        const float step = std::clamp((logEnergy - start.logEnergy) / start.slope, -4.0f, 4.0f);
        l0 += step;
        if (std::abs(step) < 3e-3f) { // and its square is the error that is left
            break;
        }
        start = firstSegment(l0, l1);
    }
    return l0;
}

/// Shape of a texel that never scattered, r_s / (its 1/e length).
constexpr float kDefaultLengths = 8.0f;

} // namespace

void resampleChannel(const float* in, int inSegments, float inSpacingMm, float scale, float* out,
                     int outSegments, float outSpacingMm) {
    const float step = outSpacingMm / (scale * inSpacingMm);
    const float shift = -2.0f * fastLog(scale);
    int k = 0;
    for (; k <= outSegments; ++k) {
        const float position = static_cast<float>(k) * step;
        const auto i = static_cast<int>(position);
        if (i >= inSegments) {
            break;
        }
        const float value =
            in[i * 3] + (in[i * 3 + 3] - in[i * 3]) * (position - static_cast<float>(i));
        out[k * 3] = std::max(value + shift, kLogProfileFloor);
    }
    // Beyond the last knot along its last segment, were it to go on; never upwards.
    const float end = in[inSegments * 3];
    const float slope = std::min(end - in[inSegments * 3 - 3], 0.0f);
    for (; k <= outSegments; ++k) {
        const float beyond = static_cast<float>(k) * step - static_cast<float>(inSegments);
        out[k * 3] = std::max(end + slope * beyond + shift, kLogProfileFloor);
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
    result.fitFirstKnots(source.albedo());
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
    takeAlbedo();
}

void ProfileEditor::takeAlbedo() {
    for (int c = 0; c < 3; ++c) {
        mAlbedo[c] = mEnergy.albedo(c, mLayout.spacingMm());
    }
}

float ProfileEditor::radiusBoundMm(int channel, float fraction) const {
    const float h = mLayout.spacingMm();
    return isBlack(channel)
               ? 0.0f
               : h * mEnergy.radiusBound(channel, fraction, TexelEnergy::blackTotal(h));
}

float ProfileEditor::radiusMm(int channel, float fraction) const {
    if (isBlack(channel)) {
        return 0.0f;
    }
    // Energies may have been measured before setAlbedo() scaled them: their ratios are the same.
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
    const float shift = fastLog(albedo / mAlbedo[channel]);
    for (int k = 0; k < knots; ++k) {
        values[k * 3] = std::max(values[k * 3] + shift, kLogProfileFloor);
    }
    mAlbedo[channel] = albedo;
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
    fitFirstKnots(albedo);
    for (int c = 0; c < 3; ++c) {
        if (mAlbedo[c] != albedo[c] && !isBlack(c)) {
            setAlbedo(c, albedo[c]);
        }
    }
}

void ProfileEditor::fitFirstKnots(const glm::vec3& albedo) {
    const float h = mLayout.spacingMm();
    bool isChanged = false;
    for (int c = 0; c < 3; ++c) {
        if (isBlack(c) || mAlbedo[c] == albedo[c]) {
            continue;
        }
        float& l0 = mValues[static_cast<std::size_t>(c)];
        const float l1 = mValues[static_cast<std::size_t>(3 + c)];
        const FirstSegment segment = firstSegment(l0, l1);
        const float first = fastExp(segment.logEnergy);
        const float rest = mEnergy.total(c) - first;
        const float wanted = albedo[c] / (2.0f * std::numbers::pi_v<float> * h * h) - rest;
        // A first segment of a tenth or ten times the energy is no longer the same profile.
        if (wanted > 0.1f * first && wanted < 10.0f * first) {
            l0 = solveFirstKnot(l0, l1, segment, fastLog(wanted));
            isChanged = true;
        }
    }
    if (isChanged) {
        mEnergy.computeFirst(mValues.data());
        takeAlbedo();
    }
}

} // namespace celadon::subedit
