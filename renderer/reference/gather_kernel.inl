// Body of the gather loop, see gather_kernel.h. Included by one file for each instruction set.
// Vectors are the compiler's own, so that the same text serves all of them.

#include "renderer/reference/gather_kernel.h"

#include <cstdint>

namespace celadon::gather {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Uint8 = std::uint32_t __attribute__((vector_size(32)));

constexpr float kSqrt2 = 1.41421356f;

/// A disc of variance q about d' is integrated by two distances where the kernel changes little
/// over it: by the product of its steepness and sqrt(q), and where the disc is small beside d'.
/// Two distances then err by h^4 / 96 < 2e-5 for an exponential, see disc_mean_test.
constexpr float kGentleChange = 0.2f;
constexpr float kGentleAngle = 0.25f;

float minimum(float a, float b) {
    return a < b ? a : b;
}
float maximum(float a, float b) {
    return a > b ? a : b;
}

Float4 load4(const float* p) {
    Float4 v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}

Float8 join(Float4 a, Float4 b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

Float8 join(float a, float b) {
    return Float8{a, a, a, a, b, b, b, b};
}

/// 2^x for -126 < x < 127, relative error 2e-7 (Taylor series of the fraction in [-1/2, 1/2]).
Float8 exp2(Float8 x) {
    constexpr float kRound = 12582912.0f; // 1.5 * 2^23: its sum has the rounded x in its low bits
    const Float8 shifted = x + kRound;
    const Float8 f = x - (shifted - kRound);
    Float8 p = f * 1.5403530e-4f + 1.3333558e-3f;
    p = p * f + 9.6181291e-3f;
    p = p * f + 5.5504109e-2f;
    p = p * f + 2.4022651e-1f;
    p = p * f + 6.9314718e-1f;
    p = p * f + 1.0f;
    return reinterpret_cast<Float8>(reinterpret_cast<Uint8>(p) +
                                    (reinterpret_cast<Uint8>(shifted) << 23));
}

/// Knot and fraction of a distance on one profile.
struct Lookup {
    int knot;
    float fraction;
};

Lookup lookUp(float distance, const Profiles& profiles) {
    const float position = distance * profiles.knotsPerMm;
    const int knot = static_cast<int>(position);
    const int last = profiles.segments - 1;
    const int clamped = knot < last ? knot : last;
    return {clamped, position - static_cast<float>(clamped)};
}

/// log2 sqrt(P) of one profile at two distances.
Float8 logHalf(const float* knots, Lookup a, Lookup b) {
    const Float8 low = join(load4(knots + 4 * a.knot), load4(knots + 4 * b.knot));
    const Float8 high = join(load4(knots + 4 * a.knot + 4), load4(knots + 4 * b.knot + 4));
    return low + (high - low) * join(a.fraction, b.fraction);
}

/// One exit point and the patch of the moment: sqrt(P_i P_o) at two distances each.
struct Pair {
    const float* patchKnots;
    const float* exitKnots;
    const Profiles& patchProfiles;
    const Profiles& exitProfiles;

    [[nodiscard]] Float8 kernel(float a, float b) const {
        return exp2(logHalf(patchKnots, lookUp(a, patchProfiles), lookUp(b, patchProfiles)) +
                    logHalf(exitKnots, lookUp(a, exitProfiles), lookUp(b, exitProfiles)));
    }
};

/// Weighted sum of the kernel over distances, two at a time.
struct DistanceSum {
    const Pair& pair;
    Float8 sum{};
    float waiting = 0.0f;
    float waitingWeight = 0.0f;
    bool odd = false;

    void add(float distance, float weight) {
        if (odd) {
            sum += pair.kernel(waiting, distance) * join(waitingWeight, weight);
        } else {
            waiting = distance;
            waitingWeight = weight;
        }
        odd = !odd;
    }

    Float8 finish() {
        if (odd) {
            add(waiting, 0.0f);
        }
        return sum;
    }
};

/// Gauss-Legendre nodes and weights on [0, 1].
constexpr int kPoints = 6;
constexpr float kNode[kPoints] = {0.03376524f, 0.16939531f, 0.38069041f,
                                  0.61930959f, 0.83060469f, 0.96623476f};
constexpr float kWeight[kPoints] = {0.08566225f, 0.18038079f, 0.23395697f,
                                    0.23395697f, 0.18038079f, 0.08566225f};

/// Panels of that rule, so that the kernel changes by a factor of e^3 at most over one.
int panelsFor(float change) {
    return 1 + static_cast<int>(minimum(change, 90.0f) / 3.0f);
}

/// The mean of the kernel over a disc of radius a in a plane through the exit point, its center at
/// distance c: a one-dimensional integral over the distance t, of the kernel times the part of the
/// disc at that distance, 2 t alpha(t) / (pi a^2), with alpha half the angle of the arc of radius t
/// that lies within the disc. Exact for every kernel up to the quadrature in t.
Float8 discMean(const Pair& pair, float center, float radius, float steepness, float reach) {
    constexpr float kPi = 3.14159265f;
    DistanceSum mean{pair};
    const float perArea = 2.0f / (radius * radius);
    // Distances whose whole circle lies within the disc: 0 < t < a - c.
    if (center < radius) {
        const float end = minimum(radius - center, reach);
        const int panels = panelsFor(steepness * end);
        const float width = end / static_cast<float>(panels);
        for (int panel = 0; panel < panels; ++panel) {
            for (int i = 0; i < kPoints; ++i) {
                const float t = (static_cast<float>(panel) + kNode[i]) * width;
                mean.add(t, perArea * t * kWeight[i] * width);
            }
        }
    }
    // The rest, |a - c| < t < a + c. alpha has square-root ends: t = middle + half cos(theta)
    // makes it smooth in theta.
    const float low = center < radius ? radius - center : center - radius;
    const float middle = 0.5f * (center + radius + low);
    const float half = 0.5f * (center + radius - low);
    if (half > 0.0f && low < reach) {
        const float first =
            reach < middle + half
                ? __builtin_acosf(minimum(maximum((reach - middle) / half, -1.0f), 1.0f))
                : 0.0f;
        const int panels = 1 + panelsFor(2.0f * steepness * half);
        const float width = (kPi - first) / static_cast<float>(panels);
        for (int panel = 0; panel < panels; ++panel) {
            for (int i = 0; i < kPoints; ++i) {
                const float theta = first + (static_cast<float>(panel) + kNode[i]) * width;
                const float t = middle + half * __builtin_cosf(theta);
                const float cosAlpha =
                    ((t - radius) * (t + radius) + center * center) / (2.0f * t * center);
                const float alpha = __builtin_acosf(minimum(maximum(cosAlpha, -1.0f), 1.0f));
                mean.add(t, perArea * t * (alpha / kPi) * half * __builtin_sinf(theta) *
                                kWeight[i] * width);
            }
        }
    }
    return mean.finish();
}

/// The mean of the kernel over a disc of variance q = spread^2 about d' = center, by as many
/// distances as it takes.
Float8 footprintMean(const Pair& pair, float center, float spread, float steepness, float reach) {
    if (steepness * spread < kGentleChange && spread <= kGentleAngle * center) {
        const float squared = center * center + spread * spread;
        const float deviation =
            spread * __builtin_sqrtf(2.0f * center * center + 0.33333333f * spread * spread);
        const float minus = __builtin_sqrtf(maximum(squared - deviation, 0.0f));
        const float plus = __builtin_sqrtf(squared + deviation);
        return pair.kernel(minimum(minus, reach), minimum(plus, reach)) *
               join(minus <= reach ? 0.5f : 0.0f, plus <= reach ? 0.5f : 0.0f);
    }
    return discMean(pair, center, kSqrt2 * spread, steepness, reach);
}

/// An exit point near a triangular patch: there neither a disc nor a covariance is the triangle,
/// and the kernel changes most. The triangle is cut in four until its parts are far for their size,
/// or so small that the kernel hardly changes over them.
struct NearTriangle {
    const Pair& pair;
    const float* patchSteepness;
    const float* exitSteepness;
    const float* exitPosition;
    float reach;

    static constexpr int kDeepest = 5;
    static constexpr float kNear = 6.0f;  ///< distance in spreads at which a part counts as far
    static constexpr float kFlat = 0.03f; ///< change of the kernel over a part that is small

    struct Corners {
        Float4 a, b, c; ///< relative to the exit point
    };

    static float dot(Float4 a, Float4 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

    [[nodiscard]] Float8 mean(const Corners& t, int depth) const {
        const Float4 m = (t.a + t.b + t.c) * (1.0f / 3.0f);
        const Float4 da = t.a - m;
        const Float4 db = t.b - m;
        const Float4 dc = t.c - m;
        const float variance = (dot(da, da) + dot(db, db) + dot(dc, dc)) / 12.0f;
        const float d2 = dot(m, m);
        const float steepest = patchSteepness[0] + exitSteepness[0];
        if (depth < kDeepest && d2 < kNear * kNear * variance &&
            steepest * steepest * variance > kFlat * kFlat) {
            const Float4 ab = (t.a + t.b) * 0.5f;
            const Float4 bc = (t.b + t.c) * 0.5f;
            const Float4 ca = (t.c + t.a) * 0.5f;
            return (mean({t.a, ab, ca}, depth + 1) + mean({ab, t.b, bc}, depth + 1) +
                    mean({ca, bc, t.c}, depth + 1) + mean({ab, bc, ca}, depth + 1)) *
                   0.25f;
        }
        // As a round patch on the triangle's plane.
        const Float4 normal{db[1] * dc[2] - db[2] * dc[1], db[2] * dc[0] - db[0] * dc[2],
                            db[0] * dc[1] - db[1] * dc[0], 0.0f};
        const float above = dot(normal, m);
        const float scale = dot(normal, normal) * d2;
        const float q =
            scale > 0.0f ? variance * maximum(1.0f - above * above / scale, 0.0f) : variance;
        const float center = __builtin_sqrtf(d2 + variance - q);
        const float spread = __builtin_sqrtf(q);
        const float nearest = maximum(center - kSqrt2 * spread, 0.0f);
        if (nearest > reach) {
            return Float8{};
        }
        const float steepness = patchSteepness[lookUp(nearest, pair.patchProfiles).knot] +
                                exitSteepness[lookUp(nearest, pair.exitProfiles).knot];
        return footprintMean(pair, center, spread, steepness, reach);
    }

    [[nodiscard]] Float8 mean(const float* corners) const {
        const auto relative = [&](const float* p) {
            return Float4{p[0] - exitPosition[0], p[1] - exitPosition[1], p[2] - exitPosition[2],
                          0.0f};
        };
        return mean({relative(corners), relative(corners + 3), relative(corners + 6)}, 0);
    }
};

/// Squared distance of a point from the bounds of a block.
float squaredDistance(const float* p, const PatchBlock& block) {
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const float outside = maximum(maximum(block.low[i] - p[i], p[i] - block.high[i]), 0.0f);
        sum += outside * outside;
    }
    return sum;
}

const float* knotsOf(const Profiles& profiles, int point) {
    return profiles.logKnots + 4 * static_cast<std::int64_t>(profiles.pointStride) * point;
}

const float* steepnessOf(const Profiles& profiles, int point) {
    return profiles.pointStride == 0
               ? profiles.steepness
               : profiles.steepness + static_cast<std::int64_t>(profiles.segments) * point;
}

void addTo(double* sums, Float8 value) {
    for (int c = 0; c < 3; ++c) {
        sums[c] += static_cast<double>(value[c]) + static_cast<double>(value[c + 4]);
    }
}

std::uint64_t gatherPoints(const ExitBlock& exits, const PatchBlock& patches, float reach) {
    std::uint64_t pairs = 0;
    alignas(32) float distance[kPatchBlock];
    int list[kPatchBlock + 1];
    for (int o = 0; o < exits.count; ++o) {
        const float* p = exits.positions + 3 * o;
        if (squaredDistance(p, patches) > reach * reach) {
            continue;
        }
        for (int j = 0; j < kPatchBlock; ++j) {
            const float dx = p[0] - patches.x[j];
            const float dy = p[1] - patches.y[j];
            const float dz = p[2] - patches.z[j];
            distance[j] = __builtin_sqrtf(dx * dx + dy * dy + dz * dz);
        }
        int n = 0;
        for (int j = 0; j < patches.count; ++j) {
            list[n] = j;
            n += distance[j] <= reach ? 1 : 0;
        }
        const float* exitKnots = knotsOf(exits.profiles, o);
        Float8 sum{};
        for (int i = 0; i < n; i += 2) {
            const int a = list[i];
            const bool single = i + 1 == n;
            const int b = single ? a : list[i + 1];
            const Lookup ia = lookUp(distance[a], patches.profiles);
            const Lookup ib = lookUp(distance[b], patches.profiles);
            const Lookup oa = lookUp(distance[a], exits.profiles);
            const Lookup ob = lookUp(distance[b], exits.profiles);
            const float* ka = knotsOf(patches.profiles, a) + 4 * ia.knot;
            const float* kb = knotsOf(patches.profiles, b) + 4 * ib.knot;
            const Float8 low = join(load4(ka), load4(kb));
            const Float8 high = join(load4(ka + 4), load4(kb + 4));
            const Float8 kernel = exp2(low + (high - low) * join(ia.fraction, ib.fraction) +
                                       logHalf(exitKnots, oa, ob));
            const Float4 zero{};
            sum += kernel * join(load4(patches.flux[a]), single ? zero : load4(patches.flux[b]));
        }
        addTo(exits.sums + 3 * o, sum);
        pairs += static_cast<std::uint64_t>(n);
    }
    return pairs;
}

std::uint64_t gatherFootprints(const ExitBlock& exits, const PatchBlock& patches, float reach) {
    // The nearest edge of a disc of variance q <= 1.3 s^2 about d' >= d - 0.55 s is never nearer
    // than d - 2.2 s.
    const float culled = reach + 2.2f * patches.largestSpread;
    std::uint64_t pairs = 0;
    alignas(32) float center[kPatchBlock]; // d'
    alignas(32) float spread[kPatchBlock]; // sqrt(q)
    alignas(32) float nearest[kPatchBlock];
    alignas(32) float minus[kPatchBlock]; // the two distances of the gentle rule
    alignas(32) float plus[kPatchBlock];
    int list[kPatchBlock + 1];
    for (int o = 0; o < exits.count; ++o) {
        const float* p = exits.positions + 3 * o;
        if (squaredDistance(p, patches) > culled * culled) {
            continue;
        }
        for (int j = 0; j < kPatchBlock; ++j) {
            const float dx = p[0] - patches.x[j];
            const float dy = p[1] - patches.y[j];
            const float dz = p[2] - patches.z[j];
            const float d2 = dx * dx + dy * dy + dz * dz;
            const float along =
                patches.xx[j] * dx * dx + patches.yy[j] * dy * dy + patches.zz[j] * dz * dz +
                2.0f *
                    (patches.xy[j] * dx * dy + patches.xz[j] * dx * dz + patches.yz[j] * dy * dz);
            const float v = patches.variance[j];
            // Seen along its plane the footprint has all of its variance beside the line of sight
            // and along it; seen from above, none that changes the distance. A pair at no distance
            // lies in the plane.
            const float directed = minimum(2.0f * along / maximum(d2, 1e-30f), 1.3f * v);
            const float q = d2 > 1e-12f ? maximum(directed, 0.0f) : v;
            const float c2 = maximum(d2 + v - q, 0.0f);
            const float c = __builtin_sqrtf(c2);
            const float s = __builtin_sqrtf(q);
            // t^2 over a disc has the mean d'^2 + q and the variance 2 q d'^2 + q^2 / 3.
            const float deviation = __builtin_sqrtf(q * (2.0f * c2 + 0.33333333f * q));
            center[j] = c;
            spread[j] = s;
            nearest[j] = maximum(c - kSqrt2 * s, 0.0f);
            minus[j] = __builtin_sqrtf(maximum(c2 + q - deviation, 0.0f));
            plus[j] = __builtin_sqrtf(c2 + q + deviation);
        }
        int n = 0;
        for (int j = 0; j < patches.count; ++j) {
            list[n] = j;
            n += nearest[j] <= reach ? 1 : 0;
        }
        const float* exitKnots = knotsOf(exits.profiles, o);
        const float* exitSteepness = steepnessOf(exits.profiles, o);
        Float8 sum{};
        for (int i = 0; i < n; ++i) {
            const int j = list[i];
            const Pair pair{knotsOf(patches.profiles, j), exitKnots, patches.profiles,
                            exits.profiles};
            const float steepness =
                steepnessOf(patches.profiles, j)[lookUp(nearest[j], patches.profiles).knot] +
                exitSteepness[lookUp(nearest[j], exits.profiles).knot];
            const Float4 flux = load4(patches.flux[j]);
            if (patches.corners != nullptr && center[j] * center[j] < NearTriangle::kNear *
                                                                          NearTriangle::kNear *
                                                                          patches.variance[j]) {
                const NearTriangle triangle{pair, steepnessOf(patches.profiles, j), exitSteepness,
                                            p, reach};
                sum += triangle.mean(patches.corners + 9 * j) * join(flux, flux);
            } else if (steepness * spread[j] < kGentleChange &&
                       spread[j] <= kGentleAngle * center[j]) {
                const Float8 weights =
                    join(minus[j] <= reach ? 0.5f : 0.0f, plus[j] <= reach ? 0.5f : 0.0f);
                sum += pair.kernel(minimum(minus[j], reach), minimum(plus[j], reach)) * weights *
                       join(flux, flux);
            } else {
                sum += discMean(pair, center[j], kSqrt2 * spread[j], steepness, reach) *
                       join(flux, flux);
            }
        }
        addTo(exits.sums + 3 * o, sum);
        pairs += static_cast<std::uint64_t>(n);
    }
    return pairs;
}

} // namespace

std::uint64_t CELADON_GATHER_NAME(const ExitBlock& exits, const PatchBlock& patches, float reachMm,
                                  bool pointSamples) {
    return pointSamples ? gatherPoints(exits, patches, reachMm)
                        : gatherFootprints(exits, patches, reachMm);
}

} // namespace celadon::gather
