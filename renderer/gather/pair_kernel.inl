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

/// Points of the radial rule, see radialTap in raster_splat.frag: places 1/2 - 1/2 cos(pi t) and
/// sin(pi t) / points.
template<int N>
struct RadialRule {
    float place[N];
    float weight[N];
    RadialRule() {
        for (int i = 0; i < N; ++i) {
            const float angle = kPi * (static_cast<float>(i) + 0.5f) / N;
            place[i] = 0.5f - 0.5f * __builtin_cosf(angle);
            weight[i] = __builtin_sinf(angle) / N;
        }
    }
};
constexpr int kRadialTaps = 24;
constexpr int kInnerTaps = 8;

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

    [[nodiscard]] Float range() const { return mRange; }

    /// Adds weight times sqrt(P_i P_o) at distance r, where within both ranges.
    void add(Float r2, Float weight, Float* sums) const {
        const Float r = L::sqrt(L::maximum(r2, L::set(0.0f)));
        const Float w = L::select(L::atMost(r, mRange), weight, L::set(0.0f));
        const Float reach = L::minimum(r, mRange);
        const Place own = placeOf(reach, L::set(mSample.knots.perMm),
                                  L::set(static_cast<float>(mSample.knots.segments - 1)));
        if (mSegments == nullptr) {
            for (int c = 0; c < 3; ++c) {
                const Float code = mTables[c].at(own.segment, own.fraction);
                sums[c] = sums[c] + w * value(code + code);
            }
            return;
        }
        const Place there = placeOf(reach, mPixelPerMm, mPixelLast);
        const Int index = L::add(L::times64(there.segment), L::iota());
        for (int c = 0; c < 3; ++c) {
            const Int ends = L::gather(mSegments + c * mChannelStride, index);
            const Float start = L::toFloat(L::lowHalf(ends));
            const Float end = L::toFloat(L::highHalf(ends));
            const Float code =
                mTables[c].at(own.segment, own.fraction) + start + there.fraction * (end - start);
            sums[c] = sums[c] + w * value(code);
        }
    }

private:
    [[nodiscard]] Float value(Float code) const {
        return L::exp2(L::set(mScale.exponentOffset) + L::set(mScale.exponentStep) * code);
    }

    const Sample& mSample;
    const L::Table* mTables;
    const CodeScale& mScale;
    const std::uint32_t* mSegments;
    int mChannelStride;
    Float mPixelPerMm, mPixelLast, mRange;
};

/// The mean over a disc of radius sqrt(2) blur at distance `center`, as an integral over the
/// distance: for discs that are wide for the profile. Adds to sums; returns the sum of weights.
Float addDisc(const PairRow& row, Float center, Float blur, Mask where, Float* sums) {
    static const RadialRule<kRadialTaps> whole;
    static const RadialRule<kInnerTaps> inner;
    static const RadialRule<kRadialTaps - kInnerTaps> outer;
    const Float zero = L::set(0.0f);
    const Float radius = blur * L::set(1.41421356f);
    const Mask inside = L::less(center, radius);
    const Float gap = L::maximum(radius - center, center - radius);
    Float total = zero;
    for (int i = 0; i < kRadialTaps; ++i) {
        const bool isInner = i < kInnerTaps;
        const float place = isInner ? inner.place[i] : outer.place[i - kInnerTaps];
        const float share = isInner ? inner.weight[i] : outer.weight[i - kInnerTaps];
        const Float low = L::select(inside, isInner ? zero : gap, gap);
        const Float high = L::select(inside, isInner ? gap : radius + center, radius + center);
        const Float width = high - low;
        const Float r = low + width * L::select(inside, L::set(place), L::set(whole.place[i]));
        const Float cosine = L::divide(center * center + r * r - radius * radius,
                                       L::maximum(L::set(2.0f) * center * r, L::set(1e-20f)));
        Float halfAngle = arcCosine(L::minimum(L::maximum(cosine, L::set(-1.0f)), L::set(1.0f)));
        if (isInner) {
            halfAngle = L::select(inside, L::set(kPi), halfAngle);
        }
        const Float weight = L::select(
            where,
            r * halfAngle * width * L::select(inside, L::set(share), L::set(whole.weight[i])),
            zero);
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

constexpr float kNeverUsed = 1e29f;

/// Weight of the candidate's node and of its ring (DESIGN 3.2, 3.3), where `where`.
Float hierarchicalWeight(const Tile& tile, int first, const Candidate& candidate, float fade,
                         Float distance, Mask where) {
    Float w = outside(candidate.sample->ball, fade, distance);
    if (candidate.parent != nullptr && candidate.parent->ball < kNeverUsed) {
        const Offsets fromParent(tile, first, candidate.parent->position);
        w = w * (L::set(1.0f) - outside(candidate.parent->ball, fade, L::sqrt(fromParent.squared)));
    }
    if (candidate.low > 0.0f) {
        w = w * smoothStep(0.8f * candidate.low, 1.2f * candidate.low, distance);
    }
    if (candidate.high > 0.0f) {
        w = w * (L::set(1.0f) - smoothStep(0.8f * candidate.high, 1.2f * candidate.high, distance));
    }
    return L::select(where, w, L::set(0.0f));
}

int addRow(Tile& tile, int first, const Candidate& candidate, const L::Table* tables,
           const Solve& solve) {
    const Sample& sample = *candidate.sample;
    const Float zero = L::set(0.0f);
    const Offsets d(tile, first, sample.position);
    const Float distance = L::sqrt(d.squared);
    const Float reach =
        L::minimum(L::load(tile.rangeMm + first), L::set(1e30f)); // 0 where not covered
    Mask where = L::both(L::less(zero, reach), L::less(distance, L::set(sample.knots.rangeMm)));
    Float weight;
    if (solve.hierarchical) {
        weight = hierarchicalWeight(tile, first, candidate, solve.fade, distance, where);
        where = L::less(zero, weight);
    } else {
        where = L::both(where, L::both(L::atMost(L::set(candidate.low), distance),
                                       L::less(distance, L::set(candidate.high))));
        weight = L::select(where, L::set(1.0f), zero);
    }
    if (!L::any(where)) {
        return 0;
    }
    const Float along =
        d.x * d.x * L::set(sample.diagonal[0]) + d.y * d.y * L::set(sample.diagonal[1]) +
        d.z * d.z * L::set(sample.diagonal[2]) +
        L::set(2.0f) *
            (d.x * d.y * L::set(sample.offDiagonal[0]) + d.x * d.z * L::set(sample.offDiagonal[1]) +
             d.y * d.z * L::set(sample.offDiagonal[2]));
    const Float variance = L::set(sample.variance);
    const Float directed =
        L::minimum(L::divide(L::set(2.0f) * along, L::maximum(d.squared, L::set(1e-8f))),
                   L::set(1.3f) * variance);
    const Float q =
        L::maximum(L::select(L::less(L::set(1e-8f), d.squared), directed, variance), zero);
    const Float closest2 = L::maximum(d.squared + variance - q, zero);
    const Float closest = L::sqrt(closest2);
    const Float blur = L::sqrt(q);
    const Float change = L::set(sample.steepness) * blur;

    const PairRow row(tile, first, sample, tables, solve.scale);
    const Mask narrow =
        L::both(L::less(blur, L::set(0.1f) * closest), L::less(change, L::set(0.25f)));
    const Mask wide = L::both(
        where, L::both(L::less(closest, L::set(4.0f) * blur), L::less(L::set(1.0f), change)));
    Float kernel[3] = {zero, zero, zero};
    const Mask gentle = L::without(where, wide);
    if (!L::any(L::without(where, narrow))) {
        row.add(closest2 + q, L::set(1.0f), kernel);
    } else if (L::any(gentle)) {
        // A third each, of one distance where narrow; where wide, the sums are replaced below.
        const Float middle = closest2 + L::select(narrow, q, L::set(0.98f) * q);
        const Float step = L::select(narrow, zero, L::set(1.7320508f) * blur * closest);
        const Float third = L::select(gentle, L::set(1.0f / 3.0f), zero);
        row.add(middle - step, third, kernel);
        row.add(middle, third, kernel);
        row.add(middle + step, third, kernel);
    }
    if (L::any(wide)) {
        Float mean[3] = {zero, zero, zero};
        const Float total = addDisc(row, closest, blur, wide, mean);
        const Float perTotal = L::divide(L::set(1.0f), L::maximum(total, L::set(1e-20f)));
        for (int c = 0; c < 3; ++c) {
            kernel[c] = L::select(wide, mean[c] * perTotal, kernel[c]);
        }
    }
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
