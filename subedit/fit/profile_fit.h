#pragma once

#include "subedit/effective_radius.h"
#include "subedit/radial_curve.h"

#include <glm/vec3.hpp>

#include <vector>

/// From a curve P(r) to the stored form: n equal segments of [0, r_s] on which ln P is linear.
namespace celadon::subedit {

struct FitSettings {
    int segments = 32;
    double maxRadiusMm = 0.0;  ///< r_s; 0 takes the radius that holds `heldEnergy`
    double heldEnergy = 0.999; ///< of the channel that reaches farthest
};

struct FittedProfile {
    int segments = 0;
    float maxRadiusMm = 0.0f;
    std::vector<float> logProfile; ///< segments + 1 knots of ln P, three channels, channel fastest
    glm::dvec3 rmsLogError{0.0};   ///< of ln P, weighted by energy (P r dr), per channel

    [[nodiscard]] ProfileView view() const { return {logProfile.data(), segments, maxRadiusMm}; }
};

/// Least squares on ln P, each radius weighted by the energy around it. Then the first knot is set
/// so that 2 pi integral of P r dr over [0, r_s] is the curve's total: a curve that is infinite at
/// r = 0 keeps the energy of its first segment, and what lies beyond r_s is given back there.
/// @throws never for finite curves; a black curve becomes the floor e^-30
[[nodiscard]] FittedProfile fitProfile(const RadialCurves& curves, const FitSettings& settings);

/// How far a stored profile is from the curve that it was fitted to.
struct FitError {
    glm::dvec3 albedo{0.0}; ///< stored minus the curve's total
    glm::dvec3 rmsLog{0.0}; ///< of ln P, weighted by energy
    /// The same without the first segment, on which a peak like 1/r keeps its energy, not its
    /// shape.
    glm::dvec3 rmsLogOutside{0.0};
    /// Part of the energy that lies at another radius than it should: the largest difference of the
    /// energies within a radius.
    glm::dvec3 misplaced{0.0};
};

[[nodiscard]] FitError measureFit(const RadialCurves& curves, const FittedProfile& fitted);

/// The fewest segments, up to 128, with which in every channel the rms error of ln P outside of the
/// first segment, and the misplaced part of the energy, are at most `tolerance`; 128 if none does.
/// @param settings its `segments` are not used
[[nodiscard]] FittedProfile fitProfileWithin(const RadialCurves& curves, double tolerance,
                                             FitSettings settings = {});

/// r_s that `settings` ask for with these curves, mm.
[[nodiscard]] double chooseMaxRadiusMm(const RadialCurves& curves, const FitSettings& settings);

/// How a curve that is infinite at r = 0 is fitted; others are the same either way.
enum class PeakFit {
    Apart,  ///< the knots but the first look at what lies outside of the first segment only
    Blended ///< all look at everything, and ring a little beside the peak; of materials from maps
};

/// The same for one channel.
/// @param logKnots segments + 1 values are written
/// @return         rms error of ln P
double fitChannel(const RadialCurve& curve, int segments, double maxRadiusMm, double* logKnots,
                  PeakFit peak = PeakFit::Apart);

} // namespace celadon::subedit
