#include "subedit/models/photon_beam.h"

#include "subedit/integrated_curve.h"
#include "subedit/models/gauss_legendre.h"
#include "subedit/models/grosjean.h"
#include "subedit/models/single_scattering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace celadon::subedit {

namespace {

constexpr double kBeamEnd = 36.0; ///< mean free paths; e^-36 of the light goes on

class PhotonBeam {
public:
    PhotonBeam(double sigmaA, double sigmaSPrime, double eta)
        : mMedium(sigmaA, sigmaSPrime, eta), mSingle(sigmaA, sigmaSPrime, eta) {
        appendGaussLegendre(mNodes, 0.0, 1.0, 8);
    }

    [[nodiscard]] double reflectance(double r) const {
        if (r <= 0.0) {
            return std::numeric_limits<double>::infinity();
        }
        return multiple(r) + mSingle.reflectance(r);
    }

private:
    /// Integral over the beam of alpha' Q(t) R_d(r, t) kappa(r, t) dt, Q = alpha' sigma_t'
    /// e^(-sigma_t' t) (Habel et al. 2013, section 4). With t = r sinh u both the peak near the
    /// surface and the end of the beam are smooth.
    [[nodiscard]] double multiple(double r) const {
        const double end = std::asinh(kBeamEnd / (mMedium.extinction * r));
        const int panels = std::max(4, static_cast<int>(std::ceil(end / 1.5)));
        const double width = end / panels;
        double sum = 0.0;
        for (int panel = 0; panel < panels; ++panel) {
            for (const QuadratureNode& node : mNodes) {
                const double grown = std::exp(width * (panel + node.position));
                const double t = 0.5 * r * (grown - 1.0 / grown);
                const double dReal = 0.5 * r * (grown + 1.0 / grown); // = dt/du as well
                sum += node.weight * width * dReal * source(r, t, dReal);
            }
        }
        return mMedium.alphaPrime * mMedium.alphaPrime * mMedium.extinction * sum;
    }

    /// e^(-sigma_t' t), times the exitance that a source at depth t causes, times the correction
    /// for what diffusion has too much near the beam:
    /// kappa = 1 - e^(-2 sigma_t' (d_r + t)) (their eq. 13).
    [[nodiscard]] double source(double r, double t, double dReal) const {
        const double tr = mMedium.sigmaTr;
        const double zVirtual = t + 2.0 * mMedium.extrapolationMm;
        const double dVirtual = std::sqrt(r * r + zVirtual * zVirtual);
        const double real = std::exp(-tr * dReal) / dReal;
        const double mirrored = std::exp(-tr * dVirtual) / dVirtual;
        const double fluence = (real - mirrored) / mMedium.diffusion;
        const double flux = t * (1.0 + tr * dReal) * real / (dReal * dReal) +
                            zVirtual * (1.0 + tr * dVirtual) * mirrored / (dVirtual * dVirtual);
        const double kappa = -std::expm1(-2.0 * mMedium.extinction * (dReal + t));
        return std::exp(-mMedium.extinction * t) * kappa *
               (mMedium.fluenceFactor * fluence + mMedium.irradianceFactor * flux) /
               (4.0 * std::numbers::pi);
    }

    GrosjeanMedium mMedium;
    SingleScattering mSingle;
    std::vector<QuadratureNode> mNodes;
};

} // namespace

RadialCurves photonBeamProfile(const Medium& medium) {
    RadialCurves curves;
    for (int channel = 0; channel < 3; ++channel) {
        const double absorption = medium.absorption[channel];
        const double scattering = medium.reducedScattering[channel];
        const PhotonBeam beam(absorption, scattering, medium.eta);
        curves[static_cast<std::size_t>(channel)] = integrateCurve(
            [beam](double r) { return beam.reflectance(r); }, 1.0 / (absorption + scattering));
    }
    return curves;
}

} // namespace celadon::subedit
