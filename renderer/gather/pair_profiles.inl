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
    /// Profiles are read one by one where their knots differ, else as the mean of both.
    static constexpr int kRead = kProfiles == Profiles::Any ? 2 : 1;

public:
    PairProfiles(const Tile& tile, const Solve& solve)
        : mTile(tile),
          mCodes(solve.codes),
          // Rounding up adds a quarter of a code on average.
          mExponentOffset(solve.scale.exponentOffset - (kProfiles == Profiles::SameKnots
                                                            ? 0.5f * solve.scale.exponentStep
                                                            : 0.0f)),
          mExponentStep(solve.scale.exponentStep * (2.0f / kRead)) {}

    /// The product of profiles about a distance, from kRunKnots knots of each.
    class Run {
    public:
        /// At r, which covers() or about which this is.
        void at(Float r, Float* kernel) const {
            const Float reach = L::minimum(r, mRangeMm);
            Float code[3] = {L::set(0.0f), L::set(0.0f), L::set(0.0f)};
            for (const Stretch& stretch : mStretches) {
                const Float position = stretch.position(reach);
                Float along[kRunKnots - 1];
                for (int k = 0; k < kRunKnots - 1; ++k) {
                    const Float behind = position - L::set(static_cast<float>(k));
                    along[k] = L::minimum(L::maximum(behind, L::set(0.0f)), L::set(1.0f));
                }
                for (int c = 0; c < 3; ++c) {
                    code[c] = code[c] + stretch.codes.code[0][c];
                    for (int k = 0; k < kRunKnots - 1; ++k) {
                        code[c] = code[c] + along[k] * stretch.change(k, c);
                    }
                }
            }
            mOf.setKernel(L::atMost(r, mRangeMm), code, kernel);
        }

        /// -d ln / dr at the distance about which this is.
        void slopes(Float r, Float* slopes) const {
            const Float reach = L::minimum(r, mRangeMm);
            for (int c = 0; c < 3; ++c) {
                slopes[c] = L::set(0.0f);
            }
            for (const Stretch& stretch : mStretches) {
                const Float position = stretch.position(reach);
                const Mask isFirst = L::less(position, L::set(1.0f));
                const Mask isSecond = L::less(position, L::set(2.0f));
                const Float scale = L::set(-kLn2 * mOf.mExponentStep) * stretch.perMm;
                for (int c = 0; c < 3; ++c) {
                    const Float behind =
                        L::select(isSecond, stretch.change(1, c), stretch.change(2, c));
                    slopes[c] =
                        slopes[c] + scale * L::select(isFirst, stretch.change(0, c), behind);
                }
            }
        }

        /// Whether all distances between these lie between the first knot and the last.
        [[nodiscard]] Mask covers(Float least, Float most) const {
            const Float end = L::minimum(most, mRangeMm);
            Mask covered = L::atMost(L::set(0.0f), least);
            for (const Stretch& stretch : mStretches) {
                covered = L::both(covered, L::atMost(L::set(0.0f), stretch.position(least)));
                covered =
                    L::both(covered, L::atMost(stretch.position(end), L::set(kRunKnots - 1.0f)));
            }
            return covered;
        }

    private:
        friend class PairProfiles;
        struct Stretch {
            Float perMm, first;
            L::Run codes;

            /// In knots from the first one.
            [[nodiscard]] Float position(Float r) const { return r * perMm - first; }
            [[nodiscard]] Float change(int k, int c) const {
                return codes.code[k + 1][c] - codes.code[k][c];
            }
        };

        Run(const PairProfiles& of, Float rangeMm) : mOf(of), mRangeMm(rangeMm) {}

        const PairProfiles& mOf;
        Float mRangeMm;
        Stretch mStretches[kRead];
    };

    /// A knot before r and two behind it, where there are any.
    [[nodiscard]] Run runAbout(const PairIndices& pairs, const PairKnots& knots, Float r) const {
        Run run(*this, knots.rangeMm);
        const Float reach = L::minimum(r, knots.rangeMm);
        alignas(64) std::int32_t own[L::kCount];
        run.mStretches[0].perMm = knots.perMm;
        run.mStretches[0].first = runStart(reach * knots.perMm, knots.lastSegment, own);
        if constexpr (kProfiles == Profiles::One) {
            for (int i = 0; i < L::kCount; ++i) {
                own[i] *= kKnotCodes;
            }
            run.mStretches[0].codes = L::run(mCodes, own);
            return run;
        }
        alignas(64) std::int32_t there[L::kCount];
        if constexpr (kProfiles == Profiles::Any) {
            auto& stretch = run.mStretches[1];
            stretch.perMm = L::gather(mTile.perMm, pairs.pixel);
            stretch.first =
                runStart(reach * stretch.perMm, L::gather(mTile.lastSegment, pairs.pixel), there);
            toCodes(pairs, own, there);
            run.mStretches[0].codes = L::run(mCodes, own);
            stretch.codes = L::run(mTile.profiles, there);
        } else {
            L::store(there, L::load(own));
            toCodes(pairs, own, there);
            run.mStretches[0].codes = L::meanRun(mCodes, own, mTile.profiles, there);
        }
        return run;
    }

    /// At r, of any distance.
    /// @param slopes  -d ln / dr; null where they are not wanted
    void at(const PairIndices& pairs, const PairKnots& knots, Float r, Float* kernel,
            Float* slopes) const {
        const Float reach = L::minimum(r, knots.rangeMm);
        const Float position = reach * knots.perMm;
        alignas(64) std::int32_t own[L::kCount];
        const Float along = position - segmentAt(position, knots.lastSegment, own);
        Float code[3];
        Float change[3]; // per mm
        if constexpr (kProfiles == Profiles::One) {
            for (int i = 0; i < L::kCount; ++i) {
                own[i] *= kKnotCodes;
            }
            setCode(L::ends(mCodes, own), along, knots.perMm, code, change);
        } else {
            alignas(64) std::int32_t there[L::kCount];
            if constexpr (kProfiles == Profiles::Any) {
                const Float perMm = L::gather(mTile.perMm, pairs.pixel);
                const Float beyond = reach * perMm;
                const Float alongThere =
                    beyond - segmentAt(beyond, L::gather(mTile.lastSegment, pairs.pixel), there);
                toCodes(pairs, own, there);
                Float codeThere[3];
                Float changeThere[3];
                setCode(L::ends(mCodes, own), along, knots.perMm, code, change);
                setCode(L::ends(mTile.profiles, there), alongThere, perMm, codeThere, changeThere);
                for (int c = 0; c < 3; ++c) {
                    code[c] = code[c] + codeThere[c];
                    change[c] = change[c] + changeThere[c];
                }
            } else {
                L::store(there, L::load(own));
                toCodes(pairs, own, there);
                setCode(L::meanEnds(mCodes, own, mTile.profiles, there), along, knots.perMm, code,
                        change);
            }
        }
        setKernel(L::atMost(r, knots.rangeMm), code, kernel);
        for (int c = 0; c < 3 && slopes != nullptr; ++c) {
            slopes[c] = L::set(-kLn2 * mExponentStep) * change[c];
        }
    }

private:
    /// @return the number of the knot before, also written to `knot`
    static Float segmentAt(Float position, Float lastSegment, std::int32_t* knot) {
        const Int segment = L::toInt(L::minimum(position, lastSegment));
        L::store(knot, segment);
        return L::toFloat(segment);
    }

    /// The first knot of a run, as segmentAt.
    static Float runStart(Float position, Float lastSegment, std::int32_t* knot) {
        const Float last = lastSegment - L::set(kRunKnots - 2.0f);
        return segmentAt(L::maximum(L::minimum(position - L::set(1.0f), last), L::set(0.0f)),
                         L::set(1e9f), knot);
    }

    /// From knots to their codes, of the samples' profiles and of the pixels'.
    void toCodes(const PairIndices& pairs, std::int32_t* own, std::int32_t* there) const {
        for (int i = 0; i < L::kCount; ++i) {
            own[i] = own[i] * kKnotCodes + pairs.profile[i];
            there[i] = there[i] * kKnotCodes + pairs.pixel[i] * mTile.profileStride;
        }
    }

    static void setCode(const L::Ends& ends, Float along, Float perMm, Float* code, Float* change) {
        for (int c = 0; c < 3; ++c) {
            code[c] = ends.start[c] + along * ends.change[c];
            change[c] = ends.change[c] * perMm;
        }
    }

    void setKernel(Mask inside, const Float* code, Float* kernel) const {
        for (int c = 0; c < 3; ++c) {
            const Float value = exp2(L::set(mExponentOffset) + L::set(mExponentStep) * code[c]);
            kernel[c] = L::select(inside, value, L::set(0.0f));
        }
    }

    const Tile& mTile;
    const std::uint16_t* mCodes;
    float mExponentOffset, mExponentStep;
};

} // namespace
} // namespace celadon::gather
