#pragma once

// Eight lanes in plain loops for any processor, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/pair_kernel.h"

#include <cstdint>

namespace celadon::gather {
namespace {

struct Lanes {
    static constexpr int kCount = 8;
    using Float = float __attribute__((vector_size(32)));
    using Int = std::int32_t __attribute__((vector_size(32)));
    using Mask = Int;

    static Float set(float v) { return Float{v, v, v, v, v, v, v, v}; }
    static Float load(const float* p) {
        Float v;
        __builtin_memcpy(&v, p, sizeof v);
        return v;
    }
    static void store(float* p, Float v) { __builtin_memcpy(p, &v, sizeof v); }
    static void store(std::int32_t* p, Int v) { __builtin_memcpy(p, &v, sizeof v); }
    static Float minimum(Float a, Float b) { return a < b ? a : b; }
    static Float maximum(Float a, Float b) { return a > b ? a : b; }
    static Mask less(Float a, Float b) { return a < b; }
    static Mask atMost(Float a, Float b) { return a <= b; }
    static Mask both(Mask a, Mask b) { return a & b; }
    static Mask without(Mask a, Mask b) { return a & ~b; }
    /// One bit a lane.
    static unsigned bits(Mask m) {
        unsigned set = 0;
        for (int i = 0; i < kCount; ++i) {
            set |= (static_cast<unsigned>(m[i]) & 1u) << i;
        }
        return set;
    }
    static Float select(Mask m, Float a, Float b) { return m ? a : b; }
    static Float sqrt(Float x) {
        Float out;
        for (int i = 0; i < kCount; ++i) {
            out[i] = __builtin_sqrtf(x[i]);
        }
        return out;
    }
    static Float round(Float x) {             ///< to the nearest, |x| < 2^22
        constexpr float kRound = 12582912.0f; // 1.5 * 2^23
        return (x + kRound) - kRound;
    }
    /// x 2^n for whole n in [-126, 127].
    static Float scale(Float x, Float n) {
        return x * reinterpret_cast<Float>((__builtin_convertvector(n, Int) + 127) << 23);
    }
    static Int toInt(Float x) { return __builtin_convertvector(x, Int); } ///< towards zero
    static Float toFloat(Int x) { return __builtin_convertvector(x, Float); }

    /// The lanes of a mask, one after the other from `out`; up to kCount values behind them are
    /// overwritten.
    class Compression {
    public:
        explicit Compression(Mask m) : mBits(bits(m)) {}
        template<class Value, class Vector>
        void store(Value* out, Vector v) const {
            for (int i = 0; i < kCount; ++i) {
                if ((mBits >> i & 1u) != 0) {
                    *out++ = v[i];
                }
            }
        }

    private:
        unsigned mBits;
    };
    static Int load(const std::int32_t* p) {
        Int v;
        __builtin_memcpy(&v, p, sizeof v);
        return v;
    }
    static Float gather(const float* base, const std::int32_t* index) {
        Float out;
        for (int i = 0; i < kCount; ++i) {
            out[i] = base[index[i]];
        }
        return out;
    }

    /// Codes of two neighboring knots, of each lane's profile.
    struct Ends {
        Float start[3], change[3];
    };
    /// @param index of the first knot's first code
    static Ends ends(const std::uint16_t* codes, const std::int32_t* index) {
        Ends e;
        for (int i = 0; i < kCount; ++i) {
            const std::uint16_t* knot = codes + index[i];
            for (int c = 0; c < 3; ++c) {
                const float start = knot[c];
                e.start[c][i] = start;
                e.change[c][i] = static_cast<float>(knot[c + kKnotCodes]) - start;
            }
        }
        return e;
    }
    /// The mean of two profiles' codes, rounded up.
    static Ends meanEnds(const std::uint16_t* a, const std::int32_t* indexA, const std::uint16_t* b,
                         const std::int32_t* indexB) {
        Ends e;
        for (int i = 0; i < kCount; ++i) {
            const std::uint16_t* p = a + indexA[i];
            const std::uint16_t* q = b + indexB[i];
            for (int c = 0; c < 3; ++c) {
                const auto start = static_cast<float>((p[c] + q[c] + 1) >> 1);
                const auto end =
                    static_cast<float>((p[c + kKnotCodes] + q[c + kKnotCodes] + 1) >> 1);
                e.start[c][i] = start;
                e.change[c][i] = end - start;
            }
        }
        return e;
    }
    /// Codes of kRunKnots neighboring knots, of each lane's profile.
    struct Run {
        Float code[kRunKnots][3];
    };
    static Run run(const std::uint16_t* codes, const std::int32_t* index) {
        return turned([&](int i, int k) { return codes[index[i] + k]; });
    }
    static Run meanRun(const std::uint16_t* a, const std::int32_t* indexA, const std::uint16_t* b,
                       const std::int32_t* indexB) {
        return turned([&](int i, int k) { return (a[indexA[i] + k] + b[indexB[i] + k] + 1) >> 1; });
    }
    /// Adds a color to the sums of each lane's pixel; lanes may share one.
    static void addColors(float (*sums)[4], const std::int32_t* pixel, const Float* color) {
        for (int i = 0; i < kCount; ++i) {
            for (int c = 0; c < 3; ++c) {
                sums[pixel[i]][c] += color[c][i];
            }
        }
    }

private:
    template<class Code>
    static Run turned(const Code& code) {
        Run run;
        for (int i = 0; i < kCount; ++i) {
            for (int k = 0; k < kRunKnots; ++k) {
                for (int c = 0; c < 3; ++c) {
                    run.code[k][c][i] = static_cast<float>(code(i, k * kKnotCodes + c));
                }
            }
        }
        return run;
    }
};

} // namespace
} // namespace celadon::gather
