#include "subedit/map/material_convert.h"

#include "subedit/fit/profile_fit.h"
#include "subedit/map/material_resize.h"
#include "subedit/radius_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

/// One channel of one texel as a curve, for the fit: no copies, valid as long as the map.
RadialCurve texelCurve(const float* logProfile, int segments, double maxRadiusMm, int channel,
                       double albedo) {
    return {[=](double r) {
                if (r > maxRadiusMm) {
                    return 0.0;
                }
                const double position = r / maxRadiusMm * segments;
                const int k = std::min(static_cast<int>(position), segments - 1);
                const double a = static_cast<double>(logProfile[k * 3 + channel]);
                const double b = static_cast<double>(logProfile[(k + 1) * 3 + channel]);
                return std::exp(a + (b - a) * (position - k));
            },
            {},
            albedo};
}

MaterialMap refit(const MaterialMap& map, int segments, double maxRadiusMm) {
    MaterialMap out = map;
    out.segments = segments;
    out.maxRadiusMm = static_cast<float>(maxRadiusMm);
    const std::vector<float> albedo = albedoMap(map);
    const std::size_t texels = albedo.size() / 3;
    const auto values = static_cast<std::size_t>(map.knots()) * 3;
    const auto newKnots = static_cast<std::size_t>(segments) + 1;
    out.logProfile.resize(texels * newKnots * 3);
    tbb::parallel_for(std::size_t{0}, texels, [&](std::size_t texel) {
        std::vector<double> knots(newKnots);
        for (std::size_t c = 0; c < 3; ++c) {
            const double target = static_cast<double>(albedo[texel * 3 + c]);
            const RadialCurve curve =
                texelCurve(map.logProfile.data() + texel * values, map.segments,
                           static_cast<double>(map.maxRadiusMm), static_cast<int>(c), target);
            static_cast<void>(fitChannel(curve, segments, maxRadiusMm, knots.data()));
            for (std::size_t k = 0; k < newKnots; ++k) {
                out.logProfile[(texel * newKnots + k) * 3 + c] = static_cast<float>(knots[k]);
            }
        }
    });
    return out;
}

} // namespace

MaterialMap convertMaterial(const MaterialMap& map, const ConvertSettings& settings) {
    const int width = settings.width > 0 ? settings.width : map.width;
    const int height = settings.height > 0 ? settings.height : map.height;
    MaterialMap out =
        width == map.width && height == map.height ? map : resizeMaterial(map, width, height);
    const int segments = settings.segments > 0 ? settings.segments : map.segments;
    const double maxRadiusMm =
        settings.maxRadiusMm > 0.0 ? settings.maxRadiusMm : static_cast<double>(map.maxRadiusMm);
    if (segments != map.segments || static_cast<float>(maxRadiusMm) != map.maxRadiusMm) {
        out = refit(out, segments, maxRadiusMm);
    }
    return out;
}

} // namespace celadon::subedit
