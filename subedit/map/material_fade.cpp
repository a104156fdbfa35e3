#include "subedit/map/material_fade.h"

#include "subedit/map/material_convert.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace celadon::subedit {

namespace {

std::vector<float> mix(std::span<const float> a, std::span<const float> b, float t) {
    std::vector<float> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        result[i] = std::lerp(a[i], b[i], t);
    }
    return result;
}

/// Of optional channels: where one map has none, the other's stays.
std::vector<float> mixIfBoth(const std::vector<float>& a, const std::vector<float>& b, float t) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    return mix(a, b, t);
}

} // namespace

MaterialFade::MaterialFade(MaterialMap from, MaterialMap to)
    : mFirst(std::move(from)), mSecond(std::move(to)) {
    ConvertSettings layout;
    layout.width = std::max(mFirst.width, mSecond.width);
    layout.height = std::max(mFirst.height, mSecond.height);
    const float radius = std::max(mFirst.maxRadiusMm, mSecond.maxRadiusMm);
    const float spacing = std::min(mFirst.maxRadiusMm / static_cast<float>(mFirst.segments),
                                   mSecond.maxRadiusMm / static_cast<float>(mSecond.segments));
    constexpr float kRounding = 1e-4f; // a quotient of 32 is not 33 segments
    layout.segments =
        std::clamp(static_cast<int>(std::ceil(radius / spacing - kRounding)), 1, kMaxSegments);
    layout.maxRadiusMm = static_cast<double>(radius);
    const auto laidOut = [&](const MaterialMap& map) {
        const bool fits = map.width == layout.width && map.height == layout.height &&
                          map.segments == layout.segments && map.maxRadiusMm == radius;
        return fits ? map : convertMaterial(map, layout);
    };
    mFirstLaidOut = laidOut(mFirst);
    mSecondLaidOut = laidOut(mSecond);
}

MaterialMap MaterialFade::at(double t) const {
    if (t <= 0.0) {
        return mFirst;
    }
    if (t >= 1.0) {
        return mSecond;
    }
    const auto weight = static_cast<float>(t);
    const MaterialMap& a = mFirstLaidOut;
    const MaterialMap& b = mSecondLaidOut;
    MaterialMap result = a;
    result.name = t < 0.5 ? a.name : b.name;
    result.eta = std::lerp(a.eta, b.eta, weight);
    result.logProfile = mix(a.logProfile, b.logProfile, weight);
    result.roughness = mixIfBoth(a.roughness, b.roughness, weight);
    result.specular = mixIfBoth(a.specular, b.specular, weight);
    return result;
}

} // namespace celadon::subedit
