#pragma once

/// Tolerances of the renderer's tests, relative unless they say otherwise. Each says why it is not
/// zero, and what was measured; widening one needs a cause.
namespace celadon::test {

/// The same formula in single precision on both sides, in another order.
inline constexpr double kSameFormula = 1e-5;
/// Sums of flux over some 10^4 texels in float on one side, in double on the other.
inline constexpr double kFluxSum = 1e-4;
/// Flux of a sphere against the closed form: its 144 x 72 facets and the texels at its rim.
inline constexpr double kSphereFlux = 5e-3;
/// B of a plane against A F_t H: the patches of the light view, and profile tables in half floats.
inline constexpr double kSlabExitance = 5e-3;
/// The same surface from two cameras: coarse rings are upsampled on different grids.
inline constexpr double kCameraIndependence = 1e-2;
/// Splatting against the image reference, over the picture: coarse samples, coarse rings, halves.
inline constexpr double kSplattingRmse = 1e-2;
/// The same for millimeter ranges, where the patch of a texel is as wide as the profile.
inline constexpr double kSplattingShortRmse = 2e-2;
/// Mean of splatting over mean of the reference: nothing may be lost or gained systematically.
inline constexpr double kSplattingMean = 3e-3;
/// Two drivers on the same frame: they rasterize edges and round halves differently.
inline constexpr double kBackends = 1e-3;

} // namespace celadon::test
