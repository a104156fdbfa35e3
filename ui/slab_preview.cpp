#include "ui/slab_preview.h"

#include "subedit/effective_radius.h"

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

/// ln P of a channel at a distance, as stored: linear between knots.
double logAt(const subedit::StoredProfile& profile, int channel, double radiusMm) {
    const double position =
        std::clamp(radiusMm / static_cast<double>(profile.maxRadiusMm), 0.0, 1.0) *
        profile.segments;
    const int k = std::min(static_cast<int>(position), profile.segments - 1);
    const auto knot = [&](int i) {
        return static_cast<double>(profile.logProfile[static_cast<std::size_t>(i * 3 + channel)]);
    };
    return knot(k) + (position - k) * (knot(k + 1) - knot(k));
}

} // namespace

SlabLook lookOfSlab(const subedit::StoredProfile& profile, float thicknessMm) {
    const glm::dvec3 albedo = subedit::diffuseAlbedo(profile.view());
    const glm::dvec3 radius = subedit::effectiveRadiusMm(profile.view(), 0.95);
    SlabLook look;
    for (int c = 0; c < 3; ++c) {
        const double R = std::clamp(albedo[c], 1e-4, 0.9999);
        const double near = 0.5 * radius[c];
        if (!(near > 0.0)) {
            continue;
        }
        // Slope of ln(P r) over the outer half of the effective radius.
        const double fall = logAt(profile, c, near) - logAt(profile, c, 2.0 * near) - std::log(2.0);
        const double sigma = std::max(fall / near, 1e-3 / radius[c]);
        const double a = 0.5 * (1.0 / R + R);
        const double b = 0.5 * (1.0 / R - R);
        const double x = std::min(sigma * static_cast<double>(thicknessMm), 300.0); // b S X
        const double denominator = a * std::sinh(x) + b * std::cosh(x);
        look.reflected[c] = static_cast<float>(std::sinh(x) / denominator);
        look.transmitted[c] = static_cast<float>(b / denominator);
    }
    return look;
}

} // namespace celadon::ui
