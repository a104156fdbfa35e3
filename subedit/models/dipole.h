#pragma once

#include "subedit/medium.h"
#include "subedit/radial_curve.h"

/// The dipole diffusion model of Jensen, Marschner, Levoy, Hanrahan 2001, "A Practical Model for
/// Subsurface Light Transport". P is per unit of flux that has entered by a perpendicular pencil of
/// light: Fresnel factors at entry and exit are the renderer's.
namespace celadon::subedit {

/// Average diffuse Fresnel reflectance inside the medium: the rational fit that Jensen et al. give
/// for eta >= 1, and that of Egan and Hilgeman 1979 for eta < 1.
[[nodiscard]] double diffuseFresnelReflectance(double eta);

/// Of the dipole: above, the fit says that more is reflected than there is.
inline constexpr double kLargestDipoleEta = 3.8;

/// Jensen et al. 2001, eq. 4. Finite at r = 0.
/// @param medium valid by validateMedium()
[[nodiscard]] RadialCurves dipoleProfile(const Medium& medium);

/// Total diffuse reflectance in closed form (Jensen and Buhler 2002, eq. 15), per channel.
[[nodiscard]] glm::dvec3 dipoleTotal(const Medium& medium);

} // namespace celadon::subedit
