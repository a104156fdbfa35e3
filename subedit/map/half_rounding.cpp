#include "subedit/map/half_rounding.h"

#include "subedit/fast_exp.h"
#include "subedit/map/material_map.h"

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace celadon::subedit {

namespace {

constexpr float kTolerance = 1e-4f;    ///< of the energy
constexpr std::size_t kFewKnots = 17;  ///< which flips alone may not serve
constexpr float kFewTolerance = 4e-4f; ///< of theirs
constexpr int kMostSteps = 6;          ///< that one of them is moved by
constexpr float kFarthest = 1.0f / 64; ///< from the true ln P

/// Bits of a half from a float that is one exactly.
std::uint16_t halfBits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000);
    const int exponent = static_cast<int>((bits >> 23) & 0xff) - 127 + 15;
    if (exponent <= 0) { // roundDown() leaves nothing between 0 and the smallest normal half
        return sign;
    }
    return static_cast<std::uint16_t>(sign | (exponent << 10) | ((bits >> 13) & 0x3ff));
}

/// The half next below (or at) `value`, and the step to the one above.
float roundDown(float value, float& step) {
    constexpr float kSmallestNormal = 6.103515625e-5f; // 2^-14
    if (std::abs(value) < kSmallestNormal) { // ln P this near 0: coarse enough to be 0 or 2^-14
        step = kSmallestNormal;
        return value < 0.0f ? -kSmallestNormal : 0.0f;
    }
    const int exponent = std::ilogb(value);
    step = std::ldexp(1.0f, exponent - 10);
    return std::floor(value / step) * step;
}

/// `rounded` moved by whole steps; unchanged where the result is no half, or too far from `value`.
float moved(float rounded, int steps, float value) {
    float step = 0.0f;
    static_cast<void>(roundDown(rounded, step));
    const float result = rounded + static_cast<float>(steps) * step;
    return roundDown(result, step) == result && std::abs(result - value) <= kFarthest ? result
                                                                                      : rounded;
}

/// How far from each other two roundings' energies are, to the second order: P changes by e^d - 1.
float change(float weight, float from, float to, float value) {
    const float before = from - value;
    const float after = to - value;
    return weight * (after - before + 0.5f * (after * after - before * before));
}

} // namespace

HalfRounding::HalfRounding(int segments, float segmentMm)
    : mAlbedoPerTotal(2.0f * std::numbers::pi_v<float> * segmentMm * segmentMm),
      mEnergy(segments),
      mRounded(static_cast<std::size_t>(segments + 1) * 3) {
    mChannels.fill(Channel(static_cast<std::size_t>(segments + 1)));
}

/// Each knot to the nearest half. @return the error of the energy, times 3 / h^2
float HalfRounding::layOut(const float* logProfile, int channel, Channel& knots) {
    for (std::size_t k = 0; k < knots.size(); ++k) {
        Knot& knot = knots[k];
        knot.value = logProfile[k * 3 + static_cast<std::size_t>(channel)];
        knot.weight = 0.0f;
        float step = 0.0f;
        const float below = roundDown(knot.value, step);
        const float above = below + step;
        const bool isDown = knot.value - below < above - knot.value;
        knot.rounded = isDown ? below : above;
        knot.other = isDown ? above : below;
    }
    // Integral of P r under each knot's hat function, by Simpson's rule.
    const int parts = knots.size() <= kFewKnots ? 32 : 2; // few segments are steep
    const float part = 1.0f / static_cast<float>(parts);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        for (int i = 0; i <= parts; ++i) {
            const float t = static_cast<float>(i) * part;
            const float factor = i == 0 || i == parts ? 1.0f : i % 2 == 1 ? 4.0f : 2.0f;
            const float value =
                part * factor *
                fastExp(knots[k].value + t * (knots[k + 1].value - knots[k].value)) *
                (static_cast<float>(k) + t);
            knots[k].weight += (1.0f - t) * value;
            knots[k + 1].weight += t * value;
        }
    }
    float error = 0.0f;
    for (const Knot& knot : knots) {
        error += change(knot.weight, knot.value, knot.rounded, knot.value);
    }
    return error;
}

/// From the center outwards, where weights fall off: each flip that helps leaves an error that
/// finer ones can mend.
float HalfRounding::flip(Channel& knots, float error, const Goal& goal) {
    for (int pass = 0; pass < 2; ++pass) {
        for (Knot& knot : knots) {
            const float flipped = error + change(knot.weight, knot.rounded, knot.other, knot.value);
            if (goal.miss(flipped) < goal.miss(error)) {
                error = flipped;
                std::swap(knot.rounded, knot.other);
            }
        }
    }
    return error;
}

/// Of all pairs of knots the one that comes nearest to the goal, moved by at most so many steps.
/// @return by how much it misses
float HalfRounding::search(Channel& knots, float error, const Goal& goal, int mostSteps) {
    float best = goal.miss(error);
    std::array<std::pair<std::size_t, float>, 2> chosen{};
    bool isFound = false;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            for (int a = -mostSteps; a <= mostSteps; ++a) {
                const float first = moved(knots[i].rounded, a, knots[i].value);
                const float half =
                    error + change(knots[i].weight, knots[i].rounded, first, knots[i].value);
                for (int b = -mostSteps; b <= mostSteps; ++b) {
                    const float second = moved(knots[j].rounded, b, knots[j].value);
                    const float both =
                        half + change(knots[j].weight, knots[j].rounded, second, knots[j].value);
                    if (goal.miss(both) < best) {
                        best = goal.miss(both);
                        chosen = {std::pair(i, first), std::pair(j, second)};
                        isFound = true;
                    }
                }
            }
        }
    }
    if (isFound) {
        for (const auto& [knot, rounded] : chosen) {
            knots[knot].rounded = rounded;
        }
    }
    return best;
}

/// A channel as it has been rounded into the profile.
void HalfRounding::place(int channel) {
    const Channel& knots = mChannels[static_cast<std::size_t>(channel)];
    for (std::size_t k = 0; k < knots.size(); ++k) {
        mRounded[k * 3 + static_cast<std::size_t>(channel)] = knots[k].rounded;
    }
}

/// The weights are the beginning of a series: where the energy has missed the mark, once more from
/// where it is.
void HalfRounding::correct(int channel, float totalBefore) {
    Channel& knots = mChannels[static_cast<std::size_t>(channel)];
    const float scale = 3.0f * totalBefore;
    const float tolerance = (knots.size() <= kFewKnots ? kFewTolerance : kTolerance) * scale;
    const float room = 3.0f * (1.0f / mAlbedoPerTotal - totalBefore); // up to an albedo of 1
    Goal goal; // of what is above 1 already, the energy as it is
    if (room > -tolerance) {
        goal = {std::min(0.0f, room - 0.5f * tolerance), room};
    }
    float best = std::numeric_limits<float>::max();
    Channel kept = knots;
    for (int attempt = 0; attempt < 4; ++attempt) {
        place(channel);
        mEnergy.compute(mRounded.data());
        const float error = 3.0f * (mEnergy.total(channel) - totalBefore);
        if (goal.miss(error) < best) {
            best = goal.miss(error);
            kept = knots;
        }
        if (best <= 0.5f * tolerance) {
            break;
        }
        const float flipped = flip(knots, error, goal);
        if (knots.size() <= kFewKnots) {
            const Channel before = knots;
            float miss = goal.miss(flipped);
            for (int steps = 1; steps <= kMostSteps && miss > 0.5f * tolerance; ++steps) {
                knots = before;
                miss = search(knots, flipped, goal, steps);
            }
        }
    }
    knots = kept;
}

void HalfRounding::round(const float* logProfile, std::uint16_t* halves) {
    const auto totals = [this] {
        return std::array{mEnergy.total(0), mEnergy.total(1), mEnergy.total(2)};
    };
    mEnergy.compute(logProfile);
    const std::array<float, 3> before = totals();
    for (int channel = 0; channel < 3; ++channel) {
        Channel& knots = mChannels[static_cast<std::size_t>(channel)];
        flip(knots, layOut(logProfile, channel, knots), {});
        place(channel);
    }
    mEnergy.compute(mRounded.data());
    const std::array<float, 3> after = totals();
    for (int channel = 0; channel < 3; ++channel) {
        const auto c = static_cast<std::size_t>(channel);
        if (std::abs(after[c] - before[c]) > kTolerance * before[c] ||
            after[c] * mAlbedoPerTotal > 1.0f) {
            correct(channel, before[c]);
            place(channel);
        }
    }
    for (std::size_t i = 0; i < mRounded.size(); ++i) {
        halves[i] = halfBits(mRounded[i]);
    }
}

} // namespace celadon::subedit
