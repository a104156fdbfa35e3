// sqrt(P_i P_o) for vectors of pairs, for pair_kernel.inl.

namespace celadon::gather {
namespace {

/// Whose profiles a vector of pairs multiplies. Codes are 16 bits; the sum of two is taken as their
/// mean, rounded up, where both have the same knots.
struct PairIndices {
    const std::int32_t* pixel;
    const std::int32_t* profile; ///< first code of the sample's
};

/// Knots of the samples' profiles, and the shorter range of both.
struct PairKnots {
    Float perMm, lastSegment, rangeMm;
};

template<Profiles kProfiles>
class PairProfiles {
public:
    PairProfiles(const Tile& tile, const Solve& solve)
        : mTile(tile),
          mCodes(solve.codes),
          // Rounding up adds a quarter of a code on average.
          mExponentOffset(solve.scale.exponentOffset - (kProfiles == Profiles::SameKnots
                                                            ? 0.5f * solve.scale.exponentStep
                                                            : 0.0f)),
          mExponentStep(solve.scale.exponentStep) {}

    /// @param slopes  -d ln / dr; null where they are not wanted
    void at(const PairIndices& pairs, const PairKnots& knots, Float r, Float* kernel,
            Float* slopes) const {
        const Mask inside = L::atMost(r, knots.rangeMm);
        const Float reach = L::minimum(r, knots.rangeMm);
        const Float position = reach * knots.perMm;
        const Int segment = L::toInt(L::minimum(position, knots.lastSegment));
        const Float fraction = position - L::toFloat(segment);
        alignas(64) std::int32_t own[L::kCount];
        L::store(own, segment);
        if constexpr (kProfiles == Profiles::Any) {
            atAny(pairs, knots, reach, fraction, own, kernel, slopes);
        } else {
            const L::Ends ends = sharedEnds(pairs, own);
            for (int c = 0; c < 3; ++c) {
                kernel[c] = value(ends.start[c] + fraction * ends.change[c], 2.0f);
                if (slopes != nullptr) {
                    slopes[c] = L::set(-2.0f * kLn2 * mExponentStep) * knots.perMm * ends.change[c];
                }
            }
        }
        for (int c = 0; c < 3; ++c) {
            kernel[c] = L::select(inside, kernel[c], L::set(0.0f));
        }
    }

private:
    [[nodiscard]] Float value(Float code, float step) const {
        return exp2(L::set(mExponentOffset) + L::set(step * mExponentStep) * code);
    }

    [[nodiscard]] L::Ends sharedEnds(const PairIndices& pairs, std::int32_t* segment) const {
        if constexpr (kProfiles == Profiles::One) {
            for (int i = 0; i < L::kCount; ++i) {
                segment[i] *= kKnotCodes;
            }
            return L::ends(mCodes, segment);
        } else {
            alignas(64) std::int32_t there[L::kCount];
            for (int i = 0; i < L::kCount; ++i) {
                const std::int32_t knot = segment[i] * kKnotCodes;
                segment[i] = knot + pairs.profile[i];
                there[i] = knot + pairs.pixel[i] * mTile.profileStride;
            }
            return L::meanEnds(mCodes, segment, mTile.profiles, there);
        }
    }

    void atAny(const PairIndices& pairs, const PairKnots& knots, Float reach, Float fraction,
               std::int32_t* own, Float* kernel, Float* slopes) const {
        const Float perMm = L::gather(mTile.perMm, pairs.pixel);
        const Float position = reach * perMm;
        const Int segment =
            L::toInt(L::minimum(position, L::gather(mTile.lastSegment, pairs.pixel)));
        const Float along = position - L::toFloat(segment);
        alignas(64) std::int32_t there[L::kCount];
        L::store(there, segment);
        for (int i = 0; i < L::kCount; ++i) {
            own[i] = own[i] * kKnotCodes + pairs.profile[i];
            there[i] = there[i] * kKnotCodes + pairs.pixel[i] * mTile.profileStride;
        }
        const L::Ends sample = L::ends(mCodes, own);
        const L::Ends pixel = L::ends(mTile.profiles, there);
        for (int c = 0; c < 3; ++c) {
            kernel[c] = value(sample.start[c] + fraction * sample.change[c] + pixel.start[c] +
                                  along * pixel.change[c],
                              1.0f);
            if (slopes != nullptr) {
                slopes[c] = L::set(-kLn2 * mExponentStep) *
                            (sample.change[c] * knots.perMm + pixel.change[c] * perMm);
            }
        }
    }

    const Tile& mTile;
    const std::uint16_t* mCodes;
    float mExponentOffset, mExponentStep;
};

} // namespace
} // namespace celadon::gather
