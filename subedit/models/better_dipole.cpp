#include "subedit/models/better_dipole.h"

#include "subedit/models/grosjean.h"

#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

/// A real source one mean free path below the surface and its mirror image, negative, across the
/// plane at height z_b.
struct BetterDipole {
    GrosjeanMedium medium;
    double zReal;
    double zVirtual;

    explicit BetterDipole(const GrosjeanMedium& theMedium)
        : medium(theMedium),
          zReal(1.0 / theMedium.extinction),
          zVirtual(zReal + 2.0 * theMedium.extrapolationMm) {}

    [[nodiscard]] double reflectance(double r) const {
        const double tr = medium.sigmaTr;
        const double dReal = std::hypot(r, zReal);
        const double dVirtual = std::hypot(r, zVirtual);
        const double fluence =
            (std::exp(-tr * dReal) / dReal - std::exp(-tr * dVirtual) / dVirtual) /
            medium.diffusion;
        const auto flux = [&](double z, double d) {
            return z * (1.0 + tr * d) * std::exp(-tr * d) / (d * d * d);
        };
        return scale() *
               (medium.fluenceFactor * fluence +
                medium.irradianceFactor * (flux(zReal, dReal) + flux(zVirtual, dVirtual)));
    }

    /// 2 pi integral of the above: with r dr = d dd both terms are derivatives with respect to d.
    [[nodiscard]] double energyWithin(double r) const {
        const double tr = medium.sigmaTr;
        const double dReal = std::hypot(r, zReal);
        const double dVirtual = std::hypot(r, zVirtual);
        // Integral of e^(-tr d) dd over [z, d]; for tr -> 0 it is d - z.
        const auto path = [&](double z, double d) {
            return tr * (d - z) < 1e-8 ? std::exp(-tr * z) * (d - z)
                                       : -std::exp(-tr * z) * std::expm1(-tr * (d - z)) / tr;
        };
        // Without absorption each path grows with r, their difference does not.
        const double paths =
            tr == 0.0
                ? (zVirtual - zReal) + (zReal * zReal - zVirtual * zVirtual) / (dReal + dVirtual)
                : path(zReal, dReal) - path(zVirtual, dVirtual);
        const auto flux = [&](double z, double d) {
            return std::exp(-tr * z) - z / d * std::exp(-tr * d);
        };
        return 2.0 * std::numbers::pi * scale() *
               (medium.fluenceFactor * paths / medium.diffusion +
                medium.irradianceFactor * (flux(zReal, dReal) + flux(zVirtual, dVirtual)));
    }

    [[nodiscard]] double total() const {
        const double tr = medium.sigmaTr;
        const double real = std::exp(-tr * zReal);
        const double virtualImage = std::exp(-tr * zVirtual);
        const double paths =
            tr == 0.0 ? zVirtual - zReal : -real * std::expm1(-tr * (zVirtual - zReal)) / tr;
        return 2.0 * std::numbers::pi * scale() *
               (medium.fluenceFactor * paths / medium.diffusion +
                medium.irradianceFactor * (real + virtualImage));
    }

private:
    [[nodiscard]] double scale() const {
        return medium.alphaPrime * medium.alphaPrime / (4.0 * std::numbers::pi);
    }
};

} // namespace

RadialCurves betterDipoleProfile(const Medium& medium) {
    RadialCurves curves;
    for (int channel = 0; channel < 3; ++channel) {
        const BetterDipole dipole(GrosjeanMedium(medium.absorption[channel],
                                                 medium.reducedScattering[channel], medium.eta));
        curves[static_cast<std::size_t>(channel)] = {
            [dipole](double r) { return dipole.reflectance(r); },
            [dipole](double r) { return dipole.energyWithin(r); }, dipole.total()};
    }
    return curves;
}

} // namespace celadon::subedit
