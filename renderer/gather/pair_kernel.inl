// Body of the pair loop, see pair_kernel.h. Included after the Lanes of one instruction set: a
// struct of vectors (Float, Int, Mask) and their arithmetic.
//
// Few pixels of a tile are within the reach of most samples. So nothing but distances is computed
// pixel by pixel: pairs that count are queued, and go on in whole vectors, sorted by how many
// distances their kernel takes.

#include "renderer/gather/pair_kernel.h"
#include "renderer/gather/pair_math.inl"
#include "renderer/gather/pair_profiles.inl"
#include "renderer/gather/pair_queue.inl"

#include <cstdint>

namespace celadon::gather {
namespace {

/// Below these a disc is small, and one distance with its second order does.
constexpr float kNarrowAngle = 0.1f;
constexpr float kNarrowChange = 0.4f;

/// 0 inside a ball, 1 well outside.
Float outside(float ball, float fade, Float distance) {
    return ball > 0.0f ? smoothStep(ball, (1.0f + fade) * ball, distance) : L::set(1.0f);
}

/// Weight of the candidate's node and of its ring (DESIGN 3.2, 3.3).
Float hierarchicalWeight(const Candidate& candidate, float fade, Float distance,
                         Float fromParentSquared) {
    Float w = outside(candidate.sample->ball, fade, distance);
    if (candidate.parentReach > 0.0f) { // where its ball has faded out
        const float ball = candidate.parentReach / (1.0f + fade);
        w = w * (L::set(1.0f) - outside(ball, fade, L::sqrt(fromParentSquared)));
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

struct Offsets {
    Float x, y, z;
    Offsets(Float px, Float py, Float pz, const float* from)
        : x(px - L::set(from[0])), y(py - L::set(from[1])), z(pz - L::set(from[2])) {}
    [[nodiscard]] Float squared() const { return x * x + y * y + z * z; }
};

/// Spheres about the pixels of a row, that is of one vector; without covered pixels of radius
/// -1e30.
class RowBounds {
public:
    explicit RowBounds(const Tile& tile) {
        for (int row = 0; row < L::kCount; ++row) {
            mX[row] = mY[row] = mZ[row] = 0.0f;
            mRadius[row] = -1e30f;
        }
        for (int row = 0; row < kTilePixels / L::kCount; ++row) {
            boundRow(tile, row);
        }
    }

    /// Rows that a candidate may reach, a bit each.
    [[nodiscard]] unsigned reached(const Candidate& candidate) const {
        const Float radius = L::load(mRadius);
        const Float distance = distanceFrom(candidate.position);
        Mask where = L::both(L::less(distance - radius, L::set(candidate.most)),
                             L::atMost(L::set(candidate.least), distance + radius));
        if (candidate.parentReach > 0.0f) {
            where = L::both(where, L::less(distanceFrom(candidate.parent) - radius,
                                           L::set(candidate.parentReach)));
        }
        return L::bits(where);
    }

private:
    [[nodiscard]] Float distanceFrom(const float* p) const {
        return L::sqrt(Offsets(L::load(mX), L::load(mY), L::load(mZ), p).squared());
    }

    void boundRow(const Tile& tile, int row) {
        const float* axes[3] = {tile.x, tile.y, tile.z};
        float low[3] = {1e30f, 1e30f, 1e30f};
        float high[3] = {-1e30f, -1e30f, -1e30f};
        for (int i = row * L::kCount; i < (row + 1) * L::kCount; ++i) {
            for (int c = 0; c < 3 && tile.rangeMm[i] > 0.0f; ++c) {
                low[c] = axes[c][i] < low[c] ? axes[c][i] : low[c];
                high[c] = axes[c][i] > high[c] ? axes[c][i] : high[c];
            }
        }
        if (low[0] > high[0]) {
            return;
        }
        mX[row] = 0.5f * (low[0] + high[0]);
        mY[row] = 0.5f * (low[1] + high[1]);
        mZ[row] = 0.5f * (low[2] + high[2]);
        float squared = 0.0f;
        for (int c = 0; c < 3; ++c) {
            squared += (high[c] - low[c]) * (high[c] - low[c]);
        }
        // Rounding must not lose a pixel.
        mRadius[row] = 0.5f * __builtin_sqrtf(squared) * 1.0001f +
                       1e-5f * (__builtin_fabsf(mX[row]) + __builtin_fabsf(mY[row]) +
                                __builtin_fabsf(mZ[row]));
    }

    alignas(64) float mX[L::kCount], mY[L::kCount], mZ[L::kCount], mRadius[L::kCount];
};

template<Profiles kProfiles>
class PairPipeline {
public:
    PairPipeline(Tile& tile, const Solve& solve)
        : mTile(tile), mSolve(solve), mProfiles(tile, solve), mRows(tile) {
        // Whole vectors are read: behind the pixels collected stands one of the tile at any time.
        for (std::int32_t& pixel : mPairs.pixel) {
            pixel = 0;
        }
    }

    void add(const Candidate& candidate) {
        const int count = collect(candidate);
        if (count > 0) {
            queue(candidate, count);
        }
    }

    /// What still waits. @return pairs that counted
    std::uint64_t finish() {
        drainPairs(true);
        drainGentle(true);
        drainWide<4, 8>(mWide, true);
        drainWide<6, 10>(mSteep, true);
        return mCounted;
    }

private:
    /// Knots differ from pair to pair only where they may.
    static constexpr int kKnotColumns = kProfiles == Profiles::Any ? 3 : 0;
    enum PairColumn {
        kClosestSquared,
        kBlurSquared,
        kSteepness,
        kWeight,
        kPairColumns = kWeight + 3
    };
    enum GentleColumn { kMiddle, kStep, kThird, kSum = kThird + 3, kGentleColumns = kSum + 3 };
    enum WideColumn { kCenter, kBlur, kWideWeight, kWideColumns = kWideWeight + 3 };
    using Pairs = PairQueue<kPairColumns + kKnotColumns>;
    using Gentle = PairQueue<kGentleColumns + kKnotColumns>;
    using Wide = PairQueue<kWideColumns + kKnotColumns>;

    /// Pixels that count, from squared distances alone.
    int collect(const Candidate& candidate) {
        const auto square = [](float x) { return L::set(x * x); };
        const bool inclusive = !mSolve.hierarchical;
        int count = 0;
        unsigned rows = mRows.reached(candidate);
        if (rows != 0) {
            __builtin_prefetch(candidate.sample);
            __builtin_prefetch(&candidate.sample->knots);
        }
        for (; rows != 0; rows &= rows - 1) {
            const int first = __builtin_ctz(rows) * L::kCount;
            const Float x = L::load(mTile.x + first);
            const Float y = L::load(mTile.y + first);
            const Float z = L::load(mTile.z + first);
            const Offsets d(x, y, z, candidate.position);
            const Float squared = d.squared();
            Mask where = L::both(L::less(L::set(0.0f), L::load(mTile.rangeMm + first)),
                                 L::less(squared, square(candidate.most)));
            where = L::both(where, inclusive ? L::atMost(square(candidate.least), squared)
                                             : L::less(square(candidate.least), squared));
            Float fromParentSquared = squared;
            if (candidate.parentReach > 0.0f) {
                fromParentSquared = Offsets(x, y, z, candidate.parent).squared();
                where = L::both(where, L::less(fromParentSquared, square(candidate.parentReach)));
            }
            const unsigned bits = L::bits(where);
            if (bits == 0) {
                continue;
            }
            const typename L::Compression compression(where);
            compression.store(mX + count, d.x);
            compression.store(mY + count, d.y);
            compression.store(mZ + count, d.z);
            compression.store(mFromParent + count, fromParentSquared);
            compression.store(mPairs.pixel + mPairs.size + count, L::load(kLanes.index + first));
            count += __builtin_popcount(bits);
        }
        return count;
    }

    /// Weights and blurs of the pixels collected.
    void queue(const Candidate& candidate, int count) {
        const Sample& sample = *candidate.sample;
        // Profiles of a painted map are more than a cache holds; most pairs are near the least
        // distance.
        const auto nearest = static_cast<int>(candidate.least * sample.knots.perMm) * kKnotCodes;
        __builtin_prefetch(mSolve.codes + sample.profile + nearest);
        __builtin_prefetch(mSolve.codes + sample.profile + nearest + 8 * kKnotCodes);
        const Float variance = L::set(sample.variance);
        for (int i = 0; i < count; i += L::kCount) {
            const Float x = L::load(mX + i);
            const Float y = L::load(mY + i);
            const Float z = L::load(mZ + i);
            const Float squared = x * x + y * y + z * z;
            const Float along =
                x * x * L::set(sample.diagonal[0]) + y * y * L::set(sample.diagonal[1]) +
                z * z * L::set(sample.diagonal[2]) +
                L::set(2.0f) *
                    (x * y * L::set(sample.offDiagonal[0]) + x * z * L::set(sample.offDiagonal[1]) +
                     y * z * L::set(sample.offDiagonal[2]));
            const Float directed =
                L::minimum((L::set(2.0f) * along) / L::maximum(squared, L::set(1e-8f)),
                           L::set(1.3f) * variance);
            const Float q = L::maximum(
                L::select(L::less(L::set(1e-8f), squared), directed, variance), L::set(0.0f));
            const int at = mPairs.size + i;
            const auto put = [&](int column, Float v) { L::store(mPairs.columns[column] + at, v); };
            put(kClosestSquared, L::maximum(squared + variance - q, L::set(0.0f)));
            put(kBlurSquared, q);
            put(kSteepness, L::set(sample.steepness));
            const Float weight = mSolve.hierarchical
                                     ? hierarchicalWeight(candidate, mSolve.fade, L::sqrt(squared),
                                                          L::load(mFromParent + i))
                                     : L::set(1.0f);
            for (int c = 0; c < 3; ++c) {
                put(kWeight + c, weight * L::set(sample.flux[c]));
            }
            const Knots& knots = sample.knots;
            if constexpr (kProfiles == Profiles::Any) {
                put(kPairColumns, L::set(knots.perMm));
                put(kPairColumns + 1, L::set(static_cast<float>(knots.segments - 1)));
                put(kPairColumns + 2,
                    L::minimum(L::set(knots.rangeMm), L::gather(mTile.rangeMm, mPairs.pixel + at)));
            }
            for (int j = 0; j < L::kCount; ++j) {
                mPairs.profile[at + j] = static_cast<std::int32_t>(sample.profile);
            }
        }
        if constexpr (kProfiles != Profiles::Any) {
            mShared = {L::set(sample.knots.perMm),
                       L::set(static_cast<float>(sample.knots.segments - 1)),
                       L::set(sample.knots.rangeMm)};
        }
        mPairs.size += count;
        mCounted += static_cast<std::uint64_t>(count);
        if (mPairs.size >= Pairs::kFull) {
            drainPairs(false);
        }
    }

    template<class Queue>
    [[nodiscard]] PairKnots knotsOf(const Queue& queue, int firstColumn, int i) const {
        if constexpr (kProfiles == Profiles::Any) {
            return {queue.at(firstColumn, i), queue.at(firstColumn + 1, i),
                    queue.at(firstColumn + 2, i)};
        } else {
            return mShared;
        }
    }

    /// Adds weight times sqrt(P_i P_o) at a distance given by its square.
    void addAt(Float r2, const PairIndices& pairs, const PairKnots& knots, Float weight,
               Float* sums) const {
        Float kernel[3];
        mProfiles.at(pairs, knots, L::sqrt(L::maximum(r2, L::set(0.0f))), kernel, nullptr);
        for (int c = 0; c < 3; ++c) {
            sums[c] = sums[c] + weight * kernel[c];
        }
    }

    void drainPairs(bool all) {
        mPairs.drain(all, [&](int i) { computePairs(i); });
    }

    /// Of pairs: their patches as discs of radius sqrt(2) blur at the distance closest.
    struct Discs {
        PairIndices pairs;
        PairKnots knots;
        Float blurSquared, blur, closest;
        Float middle, r; ///< of the distances a disc is at, squared and not
    };

    void computePairs(int i) {
        const Float closestSquared = mPairs.at(kClosestSquared, i);
        const Float q = mPairs.at(kBlurSquared, i);
        const Float middle = closestSquared + L::set(0.98f) * q;
        const Discs discs{mPairs.indices(i), knotsOf(mPairs, kPairColumns, i), q,
                          L::sqrt(q),        L::sqrt(closestSquared),          middle,
                          L::sqrt(middle)};
        if (any(L::without(all(), isSmall(discs)))) {
            computeDiscs(i, discs);
        } else {
            computeSmallDiscs(i, discs);
        }
    }

    /// Of the kernel's logarithm over the blur, steepest channel.
    static Float changeOf(const Float* slopes, Float blur) {
        const Float steepest = L::maximum(L::maximum(slopes[0], slopes[1]), slopes[2]);
        return L::maximum(steepest * blur, L::set(0.0f));
    }

    /// A disc that is small beside its distance takes one distance, and the rest is of second
    /// order, q / 4 (f'' - f' / r): for f = e^(-s r) that is q / 4 s (s + 1 / r), for f = r^-n
    /// twice the second term. Profiles lie between the two.
    struct NarrowDiscs {
        Mask where;
        Float color[3];
    };
    [[nodiscard]] NarrowDiscs narrowOf(int i, const Discs& discs, const Float* kernel,
                                       const Float* slopes) const {
        NarrowDiscs narrow;
        narrow.where =
            L::both(isSmall(discs), L::less(changeOf(slopes, discs.blur), L::set(kNarrowChange)));
        const Float perR = L::set(1.5f) / L::maximum(discs.r, L::set(1e-6f));
        for (int c = 0; c < 3; ++c) {
            const Float secondOrder =
                L::set(0.25f) * discs.blurSquared * slopes[c] * (slopes[c] + perR);
            narrow.color[c] = L::select(
                narrow.where, mPairs.at(kWeight + c, i) * kernel[c] * (L::set(1.0f) + secondOrder),
                L::set(0.0f));
        }
        return narrow;
    }

    static Mask all() { return L::atMost(L::set(0.0f), L::set(0.0f)); }
    static Mask isSmall(const Discs& discs) {
        return L::less(discs.blur, L::set(kNarrowAngle) * discs.closest);
    }

    void computeSmallDiscs(int i, const Discs& discs) {
        Float kernel[3];
        Float slopes[3];
        mProfiles.at(discs.pairs, discs.knots, discs.r, kernel, slopes);
        const NarrowDiscs narrow = narrowOf(i, discs, kernel, slopes);
        L::addColors(mTile.sums, discs.pairs.pixel, narrow.color);
        appendGentle(L::without(isSmall(discs), narrow.where), i, discs, kernel);
    }

    /// Others take three distances, nearly always between the knots of one run, and more where they
    /// are wide for the profile.
    void computeDiscs(int i, const Discs& discs) {
        const Float blur = discs.blur;
        const typename PairProfiles<kProfiles>::Run run =
            mProfiles.runAbout(discs.pairs, discs.knots, discs.r);
        Float kernel[3];
        Float slopes[3];
        run.at(discs.r, kernel);
        run.slopes(discs.r, slopes);
        const NarrowDiscs narrow = narrowOf(i, discs, kernel, slopes);
        // Near zero a profile is steeper than at r: what the disc can reach counts.
        const Float change = changeOf(slopes, blur);
        const Float nearest = (discs.closest - L::set(1.41421356f) * blur) * discs.knots.perMm;
        const Float greatest =
            L::select(L::less(nearest, L::set(1.0f)),
                      L::maximum(change, mPairs.at(kSteepness, i) * blur), change);
        const Mask wide =
            L::both(L::less(discs.closest, L::set(4.0f) * blur), L::less(L::set(1.0f), greatest));
        const Mask gentle = L::without(L::without(all(), wide), narrow.where);
        const Float step = stepOf(discs);
        const Float low = L::sqrt(L::maximum(discs.middle - step, L::set(0.0f)));
        const Float high = L::sqrt(discs.middle + step);
        const Mask covered = L::both(gentle, run.covers(low, high));
        Float nearer[3];
        Float farther[3];
        run.at(low, nearer);
        run.at(high, farther);
        Float color[3];
        for (int c = 0; c < 3; ++c) {
            const Float third = L::set(1.0f / 3.0f) * mPairs.at(kWeight + c, i);
            color[c] =
                L::select(covered, third * (nearer[c] + kernel[c] + farther[c]), narrow.color[c]);
        }
        L::addColors(mTile.sums, discs.pairs.pixel, color);
        appendGentle(L::without(gentle, covered), i, discs, kernel);
        const Mask steep = L::both(wide, L::less(L::set(4.0f), greatest));
        appendWide<4, 8>(mWide, L::without(wide, steep), i, discs);
        appendWide<6, 10>(mSteep, steep, i, discs);
    }

    /// Squared distances of three that stand for a disc: the middle one, and so much less and more.
    static Float stepOf(const Discs& discs) {
        return L::set(1.7320508f) * discs.blur * discs.closest;
    }

    void appendGentle(Mask where, int i, const Discs& discs, const Float* kernel) {
        if (!any(where)) {
            return;
        }
        Float values[kGentleColumns + kKnotColumns];
        values[kMiddle] = discs.middle;
        values[kStep] = stepOf(discs);
        for (int c = 0; c < 3; ++c) {
            values[kThird + c] = L::set(1.0f / 3.0f) * mPairs.at(kWeight + c, i);
            values[kSum + c] = values[kThird + c] * kernel[c];
        }
        putKnots(values + kGentleColumns, discs.knots);
        mGentle.append(where, values, discs.pairs);
        if (mGentle.size >= Gentle::kFull) {
            drainGentle(false);
        }
    }

    void drainGentle(bool all) {
        mGentle.drain(all, [&](int i) {
            const PairIndices pairs = mGentle.indices(i);
            const PairKnots knots = knotsOf(mGentle, kGentleColumns, i);
            const Float middle = mGentle.at(kMiddle, i);
            const Float step = mGentle.at(kStep, i);
            Float mean[3] = {L::set(0.0f), L::set(0.0f), L::set(0.0f)};
            addAt(middle - step, pairs, knots, L::set(1.0f), mean);
            addAt(middle + step, pairs, knots, L::set(1.0f), mean);
            Float color[3];
            for (int c = 0; c < 3; ++c) {
                color[c] = mGentle.at(kSum + c, i) + mGentle.at(kThird + c, i) * mean[c];
            }
            L::addColors(mTile.sums, pairs.pixel, color);
        });
    }

    template<int Inner, int Outer>
    void appendWide(Wide& queue, Mask where, int i, const Discs& discs) {
        if (!any(where)) {
            return;
        }
        Float values[kWideColumns + kKnotColumns];
        values[kCenter] = discs.closest;
        values[kBlur] = discs.blur;
        for (int c = 0; c < 3; ++c) {
            values[kWideWeight + c] = mPairs.at(kWeight + c, i);
        }
        putKnots(values + kWideColumns, discs.knots);
        queue.append(where, values, discs.pairs);
        if (queue.size >= Wide::kFull) {
            drainWide<Inner, Outer>(queue, false);
        }
    }

    /// The mean over a disc of radius sqrt(2) blur at distance `center`, as an integral over the
    /// distance r: whole circles up to R - d, then arcs of half angle acos((d^2 + r^2 - R^2) / (2 d
    /// r)). Within 0.5 % for exp(-s r), s blur < 4 with 4 + 8 points, < 12 with 6 + 10.
    template<int Inner, int Outer>
    void drainWide(Wide& queue, bool all) {
        static const ArcRule<Outer> arcs;
        queue.drain(all, [&](int i) {
            const PairIndices pairs = queue.indices(i);
            const PairKnots knots = knotsOf(queue, kWideColumns, i);
            const Float center = queue.at(kCenter, i);
            const Float radius = queue.at(kBlur, i) * L::set(1.41421356f);
            const Float gap = L::maximum(radius - center, center - radius);
            const Float zero = L::set(0.0f);
            Float mean[3] = {zero, zero, zero};
            Float total = zero;
            const Mask inside = L::less(center, radius);
            for (int j = 0; j < Inner && any(inside); ++j) {
                const Float r = gap * L::set(GaussRule<Inner>::place[j]);
                const Float weight =
                    L::select(inside, r * gap * L::set(kPi * GaussRule<Inner>::weight[j]), zero);
                addAt(r * r, pairs, knots, weight, mean);
                total = total + weight;
            }
            const Float width = radius + center - gap;
            for (int j = 0; j < Outer; ++j) {
                const Float r = gap + width * L::set(arcs.place[j]);
                const Float cosine = (center * center + r * r - radius * radius) /
                                     L::maximum(L::set(2.0f) * center * r, L::set(1e-20f));
                const Float halfAngle =
                    arcCosine(L::minimum(L::maximum(cosine, L::set(-1.0f)), L::set(1.0f)));
                const Float weight = r * halfAngle * width * L::set(arcs.weight[j]);
                addAt(r * r, pairs, knots, weight, mean);
                total = total + weight;
            }
            const Float perTotal = L::set(1.0f) / L::maximum(total, L::set(1e-20f));
            Float color[3];
            for (int c = 0; c < 3; ++c) {
                color[c] = queue.at(kWideWeight + c, i) * mean[c] * perTotal;
            }
            L::addColors(mTile.sums, pairs.pixel, color);
        });
    }

    static void putKnots(Float* values, const PairKnots& knots) {
        if constexpr (kProfiles == Profiles::Any) {
            values[0] = knots.perMm;
            values[1] = knots.lastSegment;
            values[2] = knots.rangeMm;
        }
    }

    struct LaneIndices {
        alignas(64) std::int32_t index[kTilePixels] = {};
        constexpr LaneIndices() {
            for (int i = 0; i < kTilePixels; ++i) {
                index[i] = i;
            }
        }
    };
    static constexpr LaneIndices kLanes{};

    Tile& mTile;
    const Solve& mSolve;
    PairProfiles<kProfiles> mProfiles;
    RowBounds mRows;
    PairKnots mShared{};
    std::uint64_t mCounted = 0;
    /// Of one candidate: offsets from the sample, squared distances from its parent.
    alignas(64) float mX[kTilePixels + L::kCount], mY[kTilePixels + L::kCount],
        mZ[kTilePixels + L::kCount], mFromParent[kTilePixels + L::kCount];
    Pairs mPairs;
    Gentle mGentle;
    Wide mWide, mSteep;
};

template<Profiles kProfiles>
std::uint64_t addAll(Tile& tile, const Candidate* candidates, int count, const Solve& solve) {
    PairPipeline<kProfiles> pipeline(tile, solve);
    for (int i = 0; i < count; ++i) {
        pipeline.add(candidates[i]);
    }
    return pipeline.finish();
}

} // namespace

std::uint64_t CELADON_PAIR_FUNCTION(Tile& tile, const Candidate* candidates, int count,
                                    const Solve& solve) {
    switch (solve.profiles) {
    case Profiles::One:
        return addAll<Profiles::One>(tile, candidates, count, solve);
    case Profiles::SameKnots:
        return addAll<Profiles::SameKnots>(tile, candidates, count, solve);
    case Profiles::Any:
        break;
    }
    return addAll<Profiles::Any>(tile, candidates, count, solve);
}

} // namespace celadon::gather
