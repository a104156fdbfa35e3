#include "subedit/edit/profile_editor.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"
#include "subedit/fast_log.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace celadon::subedit {

namespace {

constexpr float kFlatEnergy = -0.69314718f; ///< ln of a first segment's energy with l0 = l1 = 0
constexpr std::size_t kLanes = 4;           ///< the three channels, and one that does not count
using Lanes = std::array<float, kLanes>;

/// One Newton step towards the l0 of which the first segment has a given energy, in all lanes.
/// E = e^l0 M_1(l1 - l0) in units of h^2 (log_linear.h), d ln E / d l0 = 1 - M_2 / M_1, M_2 the
/// moment of s^2. Both branches of each moment are computed, so that the loop vectorizes.
CELADON_MULTIVERSION void stepFirstKnots(const Lanes& l1, const Lanes& logEnergy, Lanes& l0,
                                         Lanes& step) {
    for (std::size_t c = 0; c < kLanes; ++c) {
        const float z = l1[c] - l0[c];
        const bool isSmall = std::abs(z) < 0.5f;
        const float s1 =
            1.0f / 2 +
            z * (1.0f / 3 + z * (1.0f / 8 + z * (1.0f / 30 + z * (1.0f / 144 + z * (1.0f / 840)))));
        const float s2 =
            1.0f / 3 + z * (1.0f / 4 + z * (1.0f / 10 + z * (1.0f / 36 + z * (1.0f / 168))));
        const float e = fastExp(z);
        const float inverse = 1.0f / (isSmall ? 1.0f : z);
        const float e1 = (e - (e - 1.0f) * inverse) * inverse;
        const float e2 = (e - 2.0f * e1) * inverse;
        const float m1 = isSmall ? s1 : e1;
        const float m2 = isSmall ? s2 : e2;
        float slope = 1.0f - m2 / m1;
        slope = slope < 0.2f ? 0.2f : slope;
        slope = slope > 1.0f ? 1.0f : slope;
        float change = (logEnergy[c] - l0[c] - fastLog(m1)) / slope;
        change = change < -4.0f ? -4.0f : change;
        step[c] = change > 4.0f ? 4.0f : change;
        l0[c] += step[c];
    }
}

/// The l0 of given ln E, which grow with them, by Newton; to 1e-5, where scaling the whole profile
/// by the rest changes nothing that can be seen.
void solveFirstKnots(Lanes& l0, const Lanes& l1, const Lanes& logEnergy) {
    Lanes step;
    for (int i = 0; i < 8; ++i) {
        stepFirstKnots(l1, logEnergy, l0, step);
        float largest = 0.0f;
        for (const float s : step) {
            largest = std::max(largest, std::abs(s));
        }
        if (largest < 3e-3f) { // and its square is the error that is left
            break;
        }
    }
}

constexpr std::size_t kPattern = 24; ///< values: whole vectors, and whole knots
constexpr std::size_t kLargestValues =
    ((kMaxSegments + 1) * 3 + kPattern - 1) / kPattern * kPattern;
using PerValue = std::array<float, kLargestValues>;

/// One value per channel, over all values of a profile; some more are written.
void repeat(const glm::vec3& channels, int count, PerValue& values) {
    for (std::size_t i = 0; i < kPattern; i += 3) {
        values[i] = channels.x;
        values[i + 1] = channels.y;
        values[i + 2] = channels.z;
    }
    for (std::size_t i = kPattern; i < static_cast<std::size_t>(count); i += kPattern) {
        std::memcpy(values.data() + i, values.data(), kPattern * sizeof(float));
    }
}

CELADON_MULTIVERSION void shiftValues(const float* __restrict shift, int count,
                                      float* __restrict values) {
    for (int i = 0; i < count; ++i) {
        const float shifted = values[i] + shift[i];
        values[i] = shifted < kLogProfileFloor ? kLogProfileFloor : shifted;
    }
}

/// Of each value its knot and its channel.
struct ValuePlaces {
    PerValue knot;
    std::array<int, kLargestValues> channel;
    ValuePlaces() {
        for (std::size_t i = 0; i < kLargestValues; ++i) {
            knot[i] = static_cast<float>(i / 3);
            channel[i] = static_cast<int>(i % 3);
        }
    }
};
const ValuePlaces kPlaces;

/// @param step  knots of `in` from one of `out` to the next
/// @param shift added to ln P
CELADON_MULTIVERSION void resample(const float* __restrict in, int inSegments,
                                   const float* __restrict step, const float* __restrict shift,
                                   const float* __restrict knot, const int* __restrict channel,
                                   int count, float* __restrict out) {
    for (int i = 0; i < count; ++i) {
        float position = knot[i] * step[i];
        position = position > 1e6f ? 1e6f : position;
        int k = static_cast<int>(position);
        k = k < inSegments - 1 ? k : inSegments - 1;
        const float t = position - static_cast<float>(k);
        const int from = k * 3 + channel[i];
        const float start = in[from];
        const float end = in[from + 3];
        // Beyond the last knot along its last segment, were it to go on; never upwards.
        const float inside = t < 1.0f ? t : 1.0f;
        const float falling = end < start ? end - start : 0.0f;
        const float value =
            start * (1.0f - inside) + end * inside + falling * (t - inside) + shift[i];
        out[i] = value < kLogProfileFloor ? kLogProfileFloor : value;
    }
}

/// Shape of a texel that never scattered, r_s / (its 1/e length).
constexpr float kDefaultLengths = 8.0f;

} // namespace

void resampleChannels(const float* in, int inSegments, float inSpacingMm, const glm::vec3& scale,
                      float* out, int outSegments, float outSpacingMm) {
    const int count = (outSegments + 1) * 3;
    PerValue step;
    PerValue shift;
    repeat(outSpacingMm / (scale * inSpacingMm), count, step);
    repeat(-2.0f * glm::vec3(fastLog(scale.x), fastLog(scale.y), fastLog(scale.z)), count, shift);
    resample(in, inSegments, step.data(), shift.data(), kPlaces.knot.data(), kPlaces.channel.data(),
             TexelEnergy::wholeVectors(count), out);
}

std::vector<float> resampleProfile(const StoredProfile& profile, const ProfileLayout& layout) {
    if (profile.segments == layout.segments && profile.maxRadiusMm == layout.maxRadiusMm) {
        return profile.logProfile;
    }
    const float inSpacing = profile.maxRadiusMm / static_cast<float>(profile.segments);
    ProfileEditor source({profile.segments, profile.maxRadiusMm});
    source.load(profile.logProfile.data());
    ProfileEditor result(layout);
    resampleChannels(profile.logProfile.data(), profile.segments, inSpacing, glm::vec3(1.0f),
                     result.values(), layout.segments, layout.spacingMm());
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
    : mLayout(layout),
      mEnergy(layout.segments),
      mOther(static_cast<std::size_t>(TexelEnergy::wholeVectors(layout.knots() * 3))) {
    CELADON_ASSERT(layout.segments >= 1 && layout.segments <= kMaxSegments &&
                   layout.maxRadiusMm > 0.0f);
}

void ProfileEditor::load(const float* logProfile) {
    std::copy_n(logProfile, mLayout.values(), values());
    measure();
}

void ProfileEditor::measure() {
    mEnergy.compute();
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
    return h * mEnergy.channelRadius(channel, fraction, TexelEnergy::blackTotal(h));
}

void ProfileEditor::setAlbedo(int channel, float albedo) {
    float* values = this->values() + channel;
    const int knots = mLayout.knots();
    if (albedo < kBlackAlbedo) {
        for (int k = 0; k < knots; ++k) {
            values[k * 3] = kLogProfileFloor;
        }
        mAlbedo[channel] = 0.0f;
        return;
    }
    if (isBlack(channel)) {
        fillBlack(channel);
    }
    const float shift = fastLog(albedo / mAlbedo[channel]);
    for (int k = 0; k < knots; ++k) {
        values[k * 3] = std::max(values[k * 3] + shift, kLogProfileFloor);
    }
    mAlbedo[channel] = albedo;
}

void ProfileEditor::setAlbedo(const glm::vec3& albedo) {
    glm::vec3 shift(0.0f);
    bool isShifted = false;
    for (int c = 0; c < 3; ++c) {
        if (albedo[c] == mAlbedo[c]) {
            continue;
        }
        if (albedo[c] < kBlackAlbedo || isBlack(c)) {
            setAlbedo(c, albedo[c]);
            continue;
        }
        shift[c] = fastLog(albedo[c] / mAlbedo[c]);
        mAlbedo[c] = albedo[c];
        isShifted = true;
    }
    if (isShifted) {
        const int count = mLayout.knots() * 3;
        PerValue shifts;
        repeat(shift, count, shifts);
        shiftValues(shifts.data(), TexelEnergy::wholeVectors(count), values());
    }
}

/// Gives a black channel the brightest other one's shape.
void ProfileEditor::fillBlack(int channel) {
    float* values = this->values() + channel;
    int brightest = 0;
    for (int c = 1; c < 3; ++c) {
        brightest = mAlbedo[c] > mAlbedo[brightest] ? c : brightest;
    }
    const bool isAllBlack = isBlack(brightest);
    for (int k = 0; k < mLayout.knots(); ++k) {
        values[k * 3] = isAllBlack ? -kDefaultLengths * static_cast<float>(k) /
                                         static_cast<float>(mLayout.segments)
                                   : this->values()[k * 3 + brightest];
    }
    mEnergy.compute();
    mAlbedo[channel] = mEnergy.albedo(channel, mLayout.spacingMm());
}

void ProfileEditor::scaleRange(const glm::vec3& scale) {
    const glm::vec3 albedo = mAlbedo;
    glm::vec3 used(1.0f);
    for (int c = 0; c < 3; ++c) {
        used[c] = isBlack(c) ? 1.0f : scale[c];
    }
    if (used == glm::vec3(1.0f)) {
        return;
    }
    resampleChannels(values(), mLayout.segments, mLayout.spacingMm(), used, mOther.data(),
                     mLayout.segments, mLayout.spacingMm());
    std::copy(mOther.begin(), mOther.end(), values());
    measure();
    fitFirstKnots(albedo);
    glm::vec3 restored = albedo;
    for (int c = 0; c < 3; ++c) {
        restored[c] = isBlack(c) ? mAlbedo[c] : albedo[c];
    }
    setAlbedo(restored);
}

void ProfileEditor::fitFirstKnots(const glm::vec3& albedo) {
    const float h = mLayout.spacingMm();
    Lanes l0{};
    Lanes l1{};
    Lanes logEnergy{};
    glm::bvec3 isFitted(false);
    for (int c = 0; c < 3; ++c) {
        const auto lane = static_cast<std::size_t>(c);
        l0[lane] = values()[c];
        l1[lane] = values()[3 + c];
        const float first = mEnergy.first(c);
        const float rest = mEnergy.total(c) - first;
        const float wanted = albedo[c] / (2.0f * std::numbers::pi_v<float> * h * h) - rest;
        // A first segment of a tenth or ten times the energy is no longer the same profile.
        isFitted[c] = !isBlack(c) && mAlbedo[c] != albedo[c] && wanted > 0.1f * first &&
                      wanted < 10.0f * first;
        logEnergy[lane] = isFitted[c] ? fastLog(wanted) : kFlatEnergy;
        if (!isFitted[c]) {
            l0[lane] = l1[lane] = 0.0f;
        }
    }
    if (!isFitted[0] && !isFitted[1] && !isFitted[2]) {
        return;
    }
    logEnergy[3] = kFlatEnergy;
    solveFirstKnots(l0, l1, logEnergy);
    for (int c = 0; c < 3; ++c) {
        if (isFitted[c]) {
            values()[c] = l0[static_cast<std::size_t>(c)];
        }
    }
    mEnergy.computeFirst();
    takeAlbedo();
}

} // namespace celadon::subedit
