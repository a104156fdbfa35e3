#include "renderer/scene/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

/// Bernstein polynomials of degree `count` - 1 and their derivatives at u in [0, 1].
struct Basis {
    std::array<double, kMaxLatticePoints> value{};
    std::array<double, kMaxLatticePoints> slope{};
};

Basis bernstein(int count, double u) {
    const int degree = count - 1;
    Basis basis;
    // By de Casteljau's recurrence; the derivative comes from the polynomials of one degree less.
    auto& b = basis.value;
    b[0] = 1.0;
    for (int n = 1; n <= degree; ++n) {
        if (n == degree) {
            for (int i = 0; i <= degree; ++i) {
                const auto k = static_cast<std::size_t>(i);
                basis.slope[k] = degree * ((i > 0 ? b[k - 1] : 0.0) - (i < degree ? b[k] : 0.0));
            }
        }
        for (int i = n; i >= 0; --i) {
            const auto k = static_cast<std::size_t>(i);
            b[k] = (i < n ? (1.0 - u) * b[k] : 0.0) + (i > 0 ? u * b[k - 1] : 0.0);
        }
    }
    return basis;
}

/// Beyond the ends each polynomial continues as a line.
Basis extendedBasis(int count, double u) {
    const double inside = std::clamp(u, 0.0, 1.0);
    Basis basis = bernstein(count, inside);
    for (std::size_t i = 0; i < basis.value.size(); ++i) {
        basis.value[i] += (u - inside) * basis.slope[i];
    }
    return basis;
}

} // namespace

Mapped mapThrough(const Lattice& lattice, const RestBox& box, const glm::dvec3& p) {
    const glm::dvec3 extent = box.high - box.low;
    const glm::dvec3 u = (p - box.low) / extent;
    const std::array<Basis, 3> basis{extendedBasis(lattice.size.x, u.x),
                                     extendedBasis(lattice.size.y, u.y),
                                     extendedBasis(lattice.size.z, u.z)};
    // Polynomials reproduce lines and sum to 1, so that the sum of offsets is all that is needed.
    Mapped result{p};
    std::size_t at = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(lattice.size.z); ++k) {
        for (std::size_t j = 0; j < static_cast<std::size_t>(lattice.size.y); ++j) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(lattice.size.x); ++i) {
                const glm::dvec3& offset = lattice.offsets[at++];
                const double x = basis[0].value[i];
                const double y = basis[1].value[j];
                const double z = basis[2].value[k];
                result.position += x * y * z * offset;
                result.jacobian[0] += basis[0].slope[i] * y * z / extent.x * offset;
                result.jacobian[1] += x * basis[1].slope[j] * z / extent.y * offset;
                result.jacobian[2] += x * y * basis[2].slope[k] / extent.z * offset;
            }
        }
    }
    return result;
}

bool flattensAll(const Lattice& lattice, const RestBox& box) {
    constexpr double kNothing = 1e-9; // of a volume
    constexpr int kSamples = 4;
    double largest = 0.0;
    for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
        const glm::dvec3 t(i % kSamples, i / kSamples % kSamples, i / kSamples / kSamples);
        const glm::dvec3 p = glm::mix(box.low, box.high, (t + 0.37) / double(kSamples));
        largest =
            std::max(largest, std::abs(glm::determinant(mapThrough(lattice, box, p).jacobian)));
    }
    return largest < kNothing;
}

} // namespace celadon
