#pragma once

#include "subedit/medium.h"

/// Light that a semi-infinite scattering medium returns, exactly (radiative transfer, not
/// diffusion).
namespace celadon::subedit {

/// Total reflectance per unit of flux that has entered perpendicularly, after all orders of
/// scattering and internal reflection: the surface albedo A that normalized diffusion takes.
/// Isotropic scattering by Chandrasekhar's H function (1960, chapter V), coupled with the Fresnel
/// reflectance of the surface from within; anisotropy by similarity, sigma_s' = sigma_s (1 - g).
/// @param reducedAlbedo alpha' in [0, 1]
/// @param eta           relative index of refraction, > 0
[[nodiscard]] double halfSpaceTotal(double reducedAlbedo, double eta);

/// The inverse: alpha' that returns `total` (albedo inversion). @param total in [0, 1]
[[nodiscard]] double reducedAlbedoFromTotal(double total, double eta);

/// The total per channel.
[[nodiscard]] glm::dvec3 halfSpaceTotal(const Medium& medium);

/// Unpolarized Fresnel reflectance. @param cosine of the angle of incidence, in [0, 1]
/// @param eta index of refraction behind the surface over that before it
[[nodiscard]] double fresnelReflectance(double cosine, double eta);

/// Chandrasekhar's H(mu) for isotropic scattering, 1 <= H < 2.91. @param albedo in [0, 1]
[[nodiscard]] double chandrasekharH(double mu, double albedo);

} // namespace celadon::subedit
