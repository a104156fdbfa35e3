#include "subedit/models/dipole.h"

#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

/// One channel's real source below, virtual source above the surface.
struct Dipole {
    double alphaPrime; ///< reduced albedo
    double sigmaTr;    ///< effective transport coefficient, 1/mm
    double zReal;      ///< depth of the real source, mm
    double zVirtual;   ///< height of the virtual source, mm

    Dipole(double sigmaA, double sigmaSPrime, double eta) {
        const double sigmaTPrime = sigmaA + sigmaSPrime;
        const double diffuseReflectance = diffuseFresnelReflectance(eta);
        const double boundary = (1.0 + diffuseReflectance) / (1.0 - diffuseReflectance); // A
        alphaPrime = sigmaSPrime / sigmaTPrime;
        sigmaTr = std::sqrt(3.0 * sigmaA * sigmaTPrime);
        zReal = 1.0 / sigmaTPrime;
        zVirtual = zReal * (1.0 + 4.0 / 3.0 * boundary); // z_r + 4 A D, D = 1 / (3 sigma_t')
    }

    /// alpha' / 4 pi [z_r (1 + sigma_tr d_r) e^(-sigma_tr d_r) / d_r^3 + the same of z_v, d_v]
    [[nodiscard]] double reflectance(double r) const {
        const auto source = [&](double z) {
            const double d = std::sqrt(r * r + z * z);
            return z * (1.0 + sigmaTr * d) * std::exp(-sigmaTr * d) / (d * d * d);
        };
        return alphaPrime / (4.0 * std::numbers::pi) * (source(zReal) + source(zVirtual));
    }

    /// 2 pi integral of the above times r: with r dr = d dd the integrand is the derivative of
    /// -z e^(-sigma_tr d) / d.
    [[nodiscard]] double energyWithin(double r) const {
        const auto source = [&](double z) {
            const double d = std::sqrt(r * r + z * z);
            return std::exp(-sigmaTr * z) - z / d * std::exp(-sigmaTr * d);
        };
        return 0.5 * alphaPrime * (source(zReal) + source(zVirtual));
    }

    [[nodiscard]] double total() const {
        return 0.5 * alphaPrime * (std::exp(-sigmaTr * zReal) + std::exp(-sigmaTr * zVirtual));
    }
};

Dipole channelDipole(const Medium& medium, int channel) {
    return {medium.absorption[channel], medium.reducedScattering[channel], medium.eta};
}

} // namespace

double diffuseFresnelReflectance(double eta) {
    if (eta < 1.0) {
        return -0.4399 + 0.7099 / eta - 0.3319 / (eta * eta) + 0.0636 / (eta * eta * eta);
    }
    return -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
}

RadialCurves dipoleProfile(const Medium& medium) {
    RadialCurves curves;
    for (int channel = 0; channel < 3; ++channel) {
        const Dipole dipole = channelDipole(medium, channel);
        curves[static_cast<std::size_t>(channel)] = {
            [dipole](double r) { return dipole.reflectance(r); },
            [dipole](double r) { return dipole.energyWithin(r); }, dipole.total()};
    }
    return curves;
}

glm::dvec3 dipoleTotal(const Medium& medium) {
    return {channelDipole(medium, 0).total(), channelDipole(medium, 1).total(),
            channelDipole(medium, 2).total()};
}

} // namespace celadon::subedit
