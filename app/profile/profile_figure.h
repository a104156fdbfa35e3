#pragma once

#include "app/plot/drawing.h"
#include "subedit/radial_curve.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

/// A figure of scattering profiles: P over r, and how much of the energy lies within r, with the
/// effective radii marked.
namespace celadon::app {

struct NamedProfile {
    std::string name;
    subedit::RadialCurves curves;
    double maxRadiusMm = 0.0; ///< where the curves are drawn to
    /// Radii and standard errors of P by channel, drawn as bars; or empty.
    std::array<std::vector<std::array<double, 3>>, 3> samples{}; ///< r, P, error
};

struct FigureSettings {
    double energy = 0.95;
    std::array<bool, 3> channels{true, true, true};
    bool isLogRadius = false;
    std::optional<double> fromRadiusMm{}, toRadiusMm{};
    bool showsEnergy = true; ///< the second panel
    std::string title;
    /// Every profile divided by the first, on a logarithmic axis, as a further panel.
    bool showsRatio = false;
};

[[nodiscard]] plot::Drawing drawProfiles(const std::vector<NamedProfile>& profiles,
                                         const FigureSettings& settings);

} // namespace celadon::app
