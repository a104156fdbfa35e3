#include "subedit/fit/stored_curve.h"

#include "subedit/effective_radius.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace celadon::subedit {

RadialCurves storedCurves(const MaterialMap& map, int x, int y) {
    const auto texel = std::make_shared<MaterialMap>();
    texel->segments = map.segments;
    texel->maxRadiusMm = map.maxRadiusMm;
    const auto first = map.logProfile.begin() + static_cast<std::ptrdiff_t>(map.index(x, y, 0));
    texel->logProfile.assign(first, first + map.knots() * 3);
    const auto view = [texel] {
        return ProfileView{texel->logProfile.data(), texel->segments, texel->maxRadiusMm};
    };
    const glm::dvec3 albedo = diffuseAlbedo(view());
    RadialCurves curves;
    for (int channel = 0; channel < 3; ++channel) {
        curves[static_cast<std::size_t>(channel)] = {
            [texel, channel](double r) {
                const double maxRadius = static_cast<double>(texel->maxRadiusMm);
                if (r > maxRadius) {
                    return 0.0;
                }
                const double position = std::max(r, 0.0) / maxRadius * texel->segments;
                const int k = std::min(static_cast<int>(position), texel->segments - 1);
                const auto knot = [&](int i) {
                    return static_cast<double>(
                        texel->logProfile[static_cast<std::size_t>(i * 3 + channel)]);
                };
                return std::exp(knot(k) + (knot(k + 1) - knot(k)) * (position - k));
            },
            [view, channel](double r) {
                return 2.0 * std::numbers::pi * radialEnergy(view(), r)[channel];
            },
            albedo[channel]};
    }
    return curves;
}

} // namespace celadon::subedit
