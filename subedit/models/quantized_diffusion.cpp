#include "subedit/models/quantized_diffusion.h"

#include "subedit/integrated_curve.h"
#include "subedit/models/grosjean.h"
#include "subedit/models/single_scattering.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace celadon::subedit {

namespace {

/// Variances from (1e-4 mean free paths)^2 to (1e4)^2. The paper steps by the golden ratio; finer
/// steps cost little and leave no ripples.
constexpr double kSmallestSpread = 1e-4;
constexpr double kLargestSpread = 1e4;
constexpr double kRatio = 1.1;

struct Gaussian {
    double variance; ///< mm^2
    double energy;   ///< integral over the plane
};

/// The fluence of a point source, e^(-sigma_tr d) / (4 pi D d), is the integral over variances
/// v = 2 D c t of a three-dimensional Gaussian times e^(-sigma_a v / 2D) / 2D dv: light that has
/// spread for a time t. Cut into steps of v ("quanta"), each Gaussian separates into one over r and
/// one over depth, and the latter's integral over the beam is closed (their section 5).
class QuantizedBeam {
public:
    QuantizedBeam(double sigmaA, double sigmaSPrime, double eta)
        : mMedium(sigmaA, sigmaSPrime, eta) {
        const double lengthMm = 1.0 / mMedium.extinction;
        const double decay = sigmaA / (2.0 * mMedium.diffusion); // per variance
        const double largest = kLargestSpread * kLargestSpread * lengthMm * lengthMm;
        double from = 0.0;
        double to = kSmallestSpread * kSmallestSpread * lengthMm * lengthMm;
        while (from < largest) {
            const double variance = 0.5 * (from + to);
            // Integral of e^(-decay v) dv / 2D over the step.
            const double span = to - from;
            const double weight =
                std::exp(-decay * from) *
                (decay * span < 1e-8 ? span : -std::expm1(-decay * span) / decay) /
                (2.0 * mMedium.diffusion);
            const double energy = weight * exitance(variance);
            if (!(energy > 0.0) && from > 0.0) {
                break; // absorbed: what follows is less than the smallest number
            }
            mGaussians.push_back({variance, energy});
            from = to;
            to *= kRatio;
        }
    }

    [[nodiscard]] double reflectance(double r) const {
        double sum = 0.0;
        for (const Gaussian& gaussian : mGaussians) {
            sum += gaussian.energy / (2.0 * std::numbers::pi * gaussian.variance) *
                   std::exp(-r * r / (2.0 * gaussian.variance));
        }
        return sum;
    }

    [[nodiscard]] double energyWithin(double r) const {
        double sum = 0.0;
        for (const Gaussian& gaussian : mGaussians) {
            sum -= gaussian.energy * std::expm1(-r * r / (2.0 * gaussian.variance));
        }
        return sum;
    }

    [[nodiscard]] double total() const {
        double sum = 0.0;
        for (const Gaussian& gaussian : mGaussians) {
            sum += gaussian.energy;
        }
        return sum;
    }

private:
    /// Exitance over all r that Gaussians of this variance cause along the beam, per step weight:
    /// alpha'^2 (C_phi (F(0) - F(2 z_b)) + C_E D (E(0) + E(2 z_b))), the second of each pair the
    /// mirrored beam's.
    [[nodiscard]] double exitance(double variance) const {
        const double sigma = mMedium.extinction;
        const double spread = std::sqrt(variance);
        // F(z0) = integral of sigma e^(-sigma z) G(z + z0) dz over the beam.
        const auto fluence = [&](double z0) {
            return 0.5 * sigma * std::exp(-z0 * z0 / (2.0 * variance)) *
                   scaledErfc((z0 / spread + sigma * spread) / std::numbers::sqrt2);
        };
        const auto gaussian = [&](double z) {
            return std::exp(-z * z / (2.0 * variance)) /
                   (spread * std::sqrt(2.0 * std::numbers::pi));
        };
        // E(z0), the same of -dG/dz, by parts.
        const auto flux = [&](double z0) { return sigma * (gaussian(z0) - fluence(z0)); };
        const double mirror = 2.0 * mMedium.extrapolationMm;
        return mMedium.alphaPrime * mMedium.alphaPrime *
               (mMedium.fluenceFactor * (fluence(0.0) - fluence(mirror)) +
                mMedium.irradianceFactor * mMedium.diffusion * (flux(0.0) + flux(mirror)));
    }

    GrosjeanMedium mMedium;
    std::vector<Gaussian> mGaussians;
};

} // namespace

double scaledErfc(double x) {
    if (x < 20.0) {
        return std::exp(x * x) * std::erfc(x);
    }
    // Asymptotic series; its next term is below 1e-10 here.
    const double inverse = 1.0 / (x * x);
    return (1.0 - inverse * (0.5 - inverse * (0.75 - inverse * 1.875))) /
           (x * std::sqrt(std::numbers::pi));
}

RadialCurves quantizedDiffusionProfile(const Medium& medium) {
    RadialCurves curves;
    for (int channel = 0; channel < 3; ++channel) {
        const double absorption = medium.absorption[channel];
        const double scattering = medium.reducedScattering[channel];
        const auto beam = std::make_shared<const QuantizedBeam>(absorption, scattering, medium.eta);
        const SingleScattering single(absorption, scattering, medium.eta);
        const RadialCurve first = integrateCurve(
            [single](double r) { return single.reflectance(r); }, 1.0 / (absorption + scattering));
        curves[static_cast<std::size_t>(channel)] = {
            [beam, single](double r) { return beam->reflectance(r) + single.reflectance(r); },
            [beam, first](double r) { return beam->energyWithin(r) + first.energyWithin(r); },
            beam->total() + first.total};
    }
    return curves;
}

} // namespace celadon::subedit
