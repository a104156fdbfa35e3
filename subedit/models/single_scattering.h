#pragma once

#include <memory>
#include <vector>

/// First order of scattering below a perpendicular pencil of light, exactly: what quantized and
/// photon beam diffusion leave out, since diffusion begins with the second.
namespace celadon::subedit {

class SingleScattering {
public:
    /// Isotropic scattering by the reduced coefficients (similarity).
    SingleScattering(double sigmaA, double sigmaSPrime, double eta);

    /// Integral over depth t of sigma_s' e^(-sigma_t' t) / 4 pi e^(-sigma_t' d) cos / d^2 F_t(cos),
    /// d^2 = r^2 + t^2, cos = t / d: per unit of flux that entered, 1/mm^2. Like 1/r at 0.
    [[nodiscard]] double reflectance(double r) const;

private:
    struct Node {
        double reach;  ///< (t + d) / r
        double weight; ///< of the rest of the integrand times r
    };
    double mScattering;
    double mExtinction;
    std::shared_ptr<const std::vector<Node>> mNodes;
};

} // namespace celadon::subedit
