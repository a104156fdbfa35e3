// Body of the pair loop, see pair_kernel.h. Included after the Lanes of one instruction set: a
// struct of vectors (Float, Int, Mask), their arithmetic, and Table, the lookup in a sample's
// profile.

#include "renderer/gather/pair_kernel.h"

#include <cstdint>

namespace celadon::gather {
namespace {

using L = Lanes;
using Float = L::Float;
using Int = L::Int;
using Mask = L::Mask;

constexpr float kPi = 3.14159265f;
constexpr float kLn2 = 0.69314718f;

/// 2^x, relative error 2e-7 (Taylor series of the fraction in [-1/2, 1/2]); 2^-126 below that.
Float exp2(Float x) {
    const Float clamped = L::maximum(x, L::set(-126.0f));
    const Float n = L::round(clamped);
    const Float f = clamped - n;
    Float p = f * L::set(1.5403530e-4f) + L::set(1.3333558e-3f);
    p = p * f + L::set(9.6181291e-3f);
    p = p * f + L::set(5.5504109e-2f);
    p = p * f + L::set(2.4022651e-1f);
    p = p * f + L::set(6.9314718e-1f);
    p = p * f + L::set(1.0f);
    return L::scale(p, n);
}

/// 0 at `from`, 1 at `to`; from < to.
Float smoothStep(float from, float to, Float x) {
    const Float t = L::minimum(
        L::maximum((x - L::set(from)) * L::set(1.0f / (to - from)), L::set(0.0f)), L::set(1.0f));
    return t * t * (L::set(3.0f) - L::set(2.0f) * t);
}

/// Arc cosine, error below 7e-5 (Abramowitz, Stegun 1964, 4.4.45).
Float arcCosine(Float x) {
    const Float a = L::maximum(x, L::set(0.0f) - x);
    Float p = L::set(-0.0187293f) * a + L::set(0.0742610f);
    p = p * a + L::set(-0.2121144f);
    p = p * a + L::set(1.5707288f);
    const Float positive = p * L::sqrt(L::maximum(L::set(1.0f) - a, L::set(0.0f)));
    return L::select(L::less(x, L::set(0.0f)), L::set(kPi) - positive, positive);
}

/// Midpoints in the angle of t = 1/2 - 1/2 cos(angle), for arcs that begin and end like a root:
/// places in [0, 1] and weights for an integral over it.
template<int N>
struct ArcRule {
    float place[N];
    float weight[N];
    ArcRule() {
        for (int i = 0; i < N; ++i) {
            const float angle = kPi * (static_cast<float>(i) + 0.5f) / N;
            place[i] = 0.5f - 0.5f * __builtin_cosf(angle);
            weight[i] = __builtin_sinf(angle) * (0.5f * kPi / N);
        }
    }
};

/// Gauss-Legendre on [0, 1] (Abramowitz, Stegun 1964, table 25.4).
template<int N>
struct GaussRule;
template<>
struct GaussRule<4> {
    static constexpr float place[4] = {0.06943184f, 0.33000948f, 0.66999052f, 0.93056816f};
    static constexpr float weight[4] = {0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f};
};
template<>
struct GaussRule<6> {
    static constexpr float place[6] = {0.03376524f, 0.16939531f, 0.38069041f,
                                       0.61930959f, 0.83060469f, 0.96623476f};
    static constexpr float weight[6] = {0.08566225f, 0.18038079f, 0.23395697f,
                                        0.23395697f, 0.18038079f, 0.08566225f};
};

/// A distance on a profile: its segment and how far along.
struct Place {
    Int segment;
    Float fraction;
};

Place placeOf(Float distance, Float perMm, Float lastSegment) {
    const Float position = distance * perMm;
    const Int segment = L::toInt(L::minimum(position, lastSegment));
    return {segment, position - L::toFloat(segment)};
}

/// One candidate and one row of pixels of the tile.
class PairRow {
public:
    PairRow(const Tile& tile, int first, const Sample& sample, const L::Table* tables,
            const CodeScale& scale)
        : mSample(sample),
          mTables(tables),
          mScale(scale),
          mSegments(tile.segments == nullptr ? nullptr : tile.segments + first),
          mChannelStride(tile.segmentsPerChannel * kTilePixels),
          mPixelPerMm(L::load(tile.perMm + first)),
          mPixelLast(L::load(tile.lastSegment + first)),
          mRange(L::minimum(L::load(tile.rangeMm + first), L::set(sample.knots.rangeMm))) {}

    /// sqrt(P_i P_o) at distance r, zero beyond both ranges; and its logarithmic slopes, -d ln /
    /// dr.
    void at(Float r, Float* kernel, Float* slopes) const {
        const Float inRange = L::select(L::atMost(r, mRange), L::set(1.0f), L::set(0.0f));
        const Float reach = L::minimum(r, mRange);
        const Place own = placeOf(reach, L::set(mSample.knots.perMm),
                                  L::set(static_cast<float>(mSample.knots.segments - 1)));
        if (mSegments == nullptr) {
            const float perMm = -2.0f * kLn2 * mScale.exponentStep * mSample.knots.perMm;
            for (int c = 0; c < 3; ++c) {
                Float start;
                Float change;
                mTables[c].at(own.segment, start, change);
                const Float code = start + own.fraction * change;
                kernel[c] = inRange * value(code + code);
                slopes[c] = L::set(perMm) * change;
            }
            return;
        }
        const Place there = placeOf(reach, mPixelPerMm, mPixelLast);
        const Int index = L::add(L::times64(there.segment), L::iota());
        const Float perCode = L::set(-kLn2 * mScale.exponentStep);
        for (int c = 0; c < 3; ++c) {
            const Int ends = L::gather(mSegments + c * mChannelStride, index);
            const Float pixelStart = L::toFloat(L::lowHalf(ends));
            const Float pixelChange = L::toFloat(L::highHalf(ends)) - pixelStart;
            Float start;
            Float change;
            mTables[c].at(own.segment, start, change);
            kernel[c] = inRange * value(start + own.fraction * change + pixelStart +
                                        there.fraction * pixelChange);
            slopes[c] =
                perCode * (change * L::set(mSample.knots.perMm) + pixelChange * mPixelPerMm);
        }
    }

    /// Adds weight times sqrt(P_i P_o) at a distance given by its square.
    void add(Float r2, Float weight, Float* sums) const {
        Float kernel[3];
        Float slopes[3];
        at(L::sqrt(L::maximum(r2, L::set(0.0f))), kernel, slopes);
        for (int c = 0; c < 3; ++c) {
            sums[c] = sums[c] + weight * kernel[c];
        }
    }

private:
    [[nodiscard]] Float value(Float code) const {
        return exp2(L::set(mScale.exponentOffset) + L::set(mScale.exponentStep) * code);
    }

    const Sample& mSample;
    const L::Table* mTables;
    const CodeScale& mScale;
    const std::uint32_t* mSegments;
    int mChannelStride;
    Float mPixelPerMm, mPixelLast, mRange;
};

/// The mean over a disc of radius sqrt(2) blur at distance `center`, as an integral over the
/// distance r: whole circles up to R - d, then arcs of half angle acos((d^2 + r^2 - R^2) / (2 d
/// r)). Adds to sums; returns the sum of weights. Within 0.5 % for exp(-s r), s blur < 4 with 4 + 8
/// points, < 12 with 6 + 10.
template<int Inner, int Outer>
Float addDisc(const PairRow& row, Float center, Float blur, Mask where, Float* sums) {
    static const ArcRule<Outer> arcs;
    const Float zero = L::set(0.0f);
    const Float radius = blur * L::set(1.41421356f);
    const Float gap = L::maximum(radius - center, center - radius);
    Float total = zero;
    const Mask inside = L::both(where, L::less(center, radius));
    if (L::any(inside)) {
        for (int i = 0; i < Inner; ++i) {
            const Float r = gap * L::set(GaussRule<Inner>::place[i]);
            const Float weight =
                L::select(inside, r * gap * L::set(kPi * GaussRule<Inner>::weight[i]), zero);
            row.add(r * r, weight, sums);
            total = total + weight;
        }
    }
    const Float width = radius + center - gap;
    for (int i = 0; i < Outer; ++i) {
        const Float r = gap + width * L::set(arcs.place[i]);
        const Float cosine = (center * center + r * r - radius * radius) /
                             L::maximum(L::set(2.0f) * center * r, L::set(1e-20f));
        const Float halfAngle =
            arcCosine(L::minimum(L::maximum(cosine, L::set(-1.0f)), L::set(1.0f)));
        const Float weight = L::select(where, r * halfAngle * width * L::set(arcs.weight[i]), zero);
        row.add(r * r, weight, sums);
        total = total + weight;
    }
    return total;
}

/// 0 inside a ball, 1 well outside.
Float outside(float ball, float fade, Float distance) {
    return ball > 0.0f ? smoothStep(ball, (1.0f + fade) * ball, distance) : L::set(1.0f);
}

struct Offsets {
    Float x, y, z, squared;
    Offsets(const Tile& tile, int first, const float* from)
        : x(L::load(tile.x + first) - L::set(from[0])),
          y(L::load(tile.y + first) - L::set(from[1])),
          z(L::load(tile.z + first) - L::set(from[2])),
          squared(x * x + y * y + z * z) {}
};

constexpr float kRingLow = 0.8f; ///< cross-fade of a ring about its radius
constexpr float kRingHigh = 1.2f;

/// Lanes that may count, from squared distances alone: most rows of most candidates have none, and
/// nothing else is computed for them.
Mask mayCount(const Tile& tile, int first, const Candidate& candidate, const Solve& solve,
              Float squared, Float fromParentSquared) {
    const Sample& sample = *candidate.sample;
    const auto square = [](float x) { return L::set(x * x); };
    Mask where = L::both(L::less(L::set(0.0f), L::load(tile.rangeMm + first)),
                         L::less(squared, square(sample.knots.rangeMm)));
    if (!solve.hierarchical) {
        return L::both(where, L::both(L::atMost(square(candidate.low), squared),
                                      L::less(squared, square(candidate.high))));
    }
    const float ring = kRingLow * candidate.low;
    where = L::both(where, L::less(square(sample.ball > ring ? sample.ball : ring), squared));
    if (candidate.high > 0.0f) {
        where = L::both(where, L::less(squared, square(kRingHigh * candidate.high)));
    }
    if (candidate.parent != nullptr) {
        where = L::both(where, L::less(fromParentSquared,
                                       square((1.0f + solve.fade) * candidate.parent->ball)));
    }
    return where;
}

/// Weight of the candidate's node and of its ring (DESIGN 3.2, 3.3).
Float hierarchicalWeight(const Candidate& candidate, float fade, Float distance,
                         Float fromParentSquared) {
    Float w = outside(candidate.sample->ball, fade, distance);
    if (candidate.parent != nullptr) {
        w = w * (L::set(1.0f) - outside(candidate.parent->ball, fade, L::sqrt(fromParentSquared)));
    }
    if (candidate.low > 0.0f) {
        w = w * smoothStep(kRingLow * candidate.low, kRingHigh * candidate.low, distance);
    }
    if (candidate.high > 0.0f) {
        w = w * (L::set(1.0f) -
                 smoothStep(kRingLow * candidate.high, kRingHigh * candidate.high, distance));
    }
    return w;
}

/// Below these a disc is small, and one distance with its second order does.
constexpr float kNarrowAngle = 0.1f;
constexpr float kNarrowChange = 0.4f;

void replace(Float* kernel, const Float* by, Mask where) {
    for (int c = 0; c < 3; ++c) {
        kernel[c] = L::select(where, by[c], kernel[c]);
    }
}

int addRow(Tile& tile, int first, const Candidate& candidate, const L::Table* tables,
           const Solve& solve) {
    const Sample& sample = *candidate.sample;
    const Float zero = L::set(0.0f);
    const Offsets d(tile, first, sample.position);
    Float fromParentSquared = zero;
    if (candidate.parent != nullptr) {
        fromParentSquared = Offsets(tile, first, candidate.parent->position).squared;
    }
    const Mask where = mayCount(tile, first, candidate, solve, d.squared, fromParentSquared);
    if (!L::any(where)) {
        return 0;
    }
    const Float weight =
        solve.hierarchical
            ? hierarchicalWeight(candidate, solve.fade, L::sqrt(d.squared), fromParentSquared)
            : L::set(1.0f);
    const Float along =
        d.x * d.x * L::set(sample.diagonal[0]) + d.y * d.y * L::set(sample.diagonal[1]) +
        d.z * d.z * L::set(sample.diagonal[2]) +
        L::set(2.0f) *
            (d.x * d.y * L::set(sample.offDiagonal[0]) + d.x * d.z * L::set(sample.offDiagonal[1]) +
             d.y * d.z * L::set(sample.offDiagonal[2]));
    const Float variance = L::set(sample.variance);
    const Float directed = L::minimum((L::set(2.0f) * along) / L::maximum(d.squared, L::set(1e-8f)),
                                      L::set(1.3f) * variance);
    const Float q =
        L::maximum(L::select(L::less(L::set(1e-8f), d.squared), directed, variance), zero);
    const Float closest2 = L::maximum(d.squared + variance - q, zero);
    const Float closest = L::sqrt(closest2);
    const Float blur = L::sqrt(q);

    // The middle distance first. For a disc that is small beside its distance the rest is of second
    // order, q / 4 (f'' - f' / r): for f = e^(-s r) that is q / 4 s (s + 1 / r), for f = r^-n twice
    // the second term. Profiles lie between the two.
    const PairRow row(tile, first, sample, tables, solve.scale);
    const Float middle = closest2 + L::set(0.98f) * q;
    const Float r = L::sqrt(middle);
    Float kernel[3];
    Float slopes[3];
    row.at(r, kernel, slopes);
    Float change = zero; // of the kernel's logarithm over the blur, steepest channel
    for (int c = 0; c < 3; ++c) {
        change = L::maximum(change, slopes[c] * blur);
    }
    const Mask narrow = L::both(L::less(blur, L::set(kNarrowAngle) * closest),
                                L::less(change, L::set(kNarrowChange)));
    const Float perR = (L::set(1.5f)) / L::maximum(r, L::set(1e-6f));
    Float near[3];
    for (int c = 0; c < 3; ++c) {
        near[c] = kernel[c] * (L::set(1.0f) + L::set(0.25f) * q * slopes[c] * (slopes[c] + perR));
    }
    if (L::any(L::without(where, narrow))) {
        // Near zero a profile is steeper than at r: what the disc can reach counts.
        const Float nearest = closest - L::set(1.41421356f) * blur;
        change = L::select(L::less(nearest, L::set(1.0f / sample.knots.perMm)),
                           L::maximum(change, L::set(sample.steepness) * blur), change);
        const Mask wide =
            L::both(L::without(where, narrow),
                    L::both(L::less(closest, L::set(4.0f) * blur), L::less(L::set(1.0f), change)));
        const Mask gentle = L::without(L::without(where, narrow), wide);
        if (L::any(gentle)) {
            const Float step = L::set(1.7320508f) * blur * closest;
            const Float third = L::set(1.0f / 3.0f);
            Float mean[3] = {third * kernel[0], third * kernel[1], third * kernel[2]};
            row.add(middle - step, third, mean);
            row.add(middle + step, third, mean);
            replace(kernel, mean, gentle);
        }
        if (L::any(wide)) {
            Float mean[3] = {zero, zero, zero};
            const bool steep = L::any(L::both(wide, L::less(L::set(4.0f), change)));
            const Float total = steep ? addDisc<6, 10>(row, closest, blur, wide, mean)
                                      : addDisc<4, 8>(row, closest, blur, wide, mean);
            const Float perTotal = (L::set(1.0f)) / L::maximum(total, L::set(1e-20f));
            for (Float& m : mean) {
                m = m * perTotal;
            }
            replace(kernel, mean, wide);
        }
    }
    replace(kernel, near, narrow);
    for (int c = 0; c < 3; ++c) {
        float* sums = tile.sums[c] + first;
        L::store(sums, L::load(sums) +
                           L::select(where, kernel[c] * weight * L::set(sample.flux[c]), zero));
    }
    return L::count(where);
}

} // namespace

std::uint64_t CELADON_PAIR_FUNCTION(Tile& tile, const Candidate* candidates, int count,
                                    const Solve& solve) {
    std::uint64_t pairs = 0;
    L::Table tables[3];
    const std::uint16_t* loaded = nullptr;
    for (int i = 0; i < count; ++i) {
        const Sample& sample = *candidates[i].sample;
        const std::uint16_t* codes = solve.codes + sample.profile;
        if (codes != loaded) {
            for (int c = 0; c < 3; ++c) {
                tables[c].fill(codes + c * (sample.knots.segments + 1), sample.knots.segments);
            }
            loaded = codes;
        }
        for (int first = 0; first < tile.pixels; first += L::kCount) {
            pairs += static_cast<std::uint64_t>(addRow(tile, first, candidates[i], tables, solve));
        }
    }
    return pairs;
}

} // namespace celadon::gather
