// Functions over vectors of lanes, and rules of integration, for pair_kernel.inl. Included after
// the Lanes of one instruction set.

namespace celadon::gather {
namespace {

using L = Lanes;
using Float = L::Float;
using Int = L::Int;
using Mask = L::Mask;

inline bool any(Mask m) {
    return L::bits(m) != 0;
}

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

} // namespace
} // namespace celadon::gather
