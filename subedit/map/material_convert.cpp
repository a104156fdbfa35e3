#include "subedit/map/material_convert.h"

#include "subedit/fit/albedo_shift.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/radius_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::subedit {

namespace {

constexpr double kBlackAlbedo = 1e-6;

/// Weights of the source texels that make one target texel, along one axis: their shares of its
/// footprint, or the two around its center where the target is larger. Maps repeat.
struct Taps {
    std::vector<int> index;
    std::vector<double> weight;
};

Taps makeTaps(int target, int targetSize, int sourceSize) {
    Taps taps;
    const double ratio = static_cast<double>(sourceSize) / targetSize;
    if (ratio <= 1.0) {
        const double position = (target + 0.5) * ratio - 0.5;
        const double base = std::floor(position);
        const int first = static_cast<int>(base);
        taps.index = {(first + sourceSize) % sourceSize, (first + 1) % sourceSize};
        taps.weight = {1.0 - (position - base), position - base};
        return taps;
    }
    const double from = target * ratio;
    const double to = from + ratio;
    for (int i = static_cast<int>(from); i < std::min(to, static_cast<double>(sourceSize)); ++i) {
        const double share = std::min(to, i + 1.0) - std::max(from, static_cast<double>(i));
        if (share > 0.0) {
            taps.index.push_back(i);
            taps.weight.push_back(share / ratio);
        }
    }
    return taps;
}

/// Adds one number to a channel's ln P so that it has this albedo.
void shiftToAlbedo(float* logProfile, int segments, double maxRadiusMm, int channel,
                   double albedo) {
    if (albedo < kBlackAlbedo) {
        return;
    }
    const double shift = albedoShift(logProfile + channel, 3, segments, maxRadiusMm, albedo);
    for (int k = 0; k <= segments; ++k) {
        logProfile[k * 3 + channel] =
            std::max(logProfile[k * 3 + channel] + static_cast<float>(shift), kLogProfileFloor);
    }
}

class Resizer {
public:
    Resizer(const MaterialMap& map, int width, int height)
        : mMap(map), mAlbedo(albedoMap(map)), mShrinks(width < map.width || height < map.height) {
        for (int x = 0; x < width; ++x) {
            mX.push_back(makeTaps(x, width, map.width));
        }
        for (int y = 0; y < height; ++y) {
            mY.push_back(makeTaps(y, height, map.height));
        }
    }

    [[nodiscard]] MaterialMap run() const {
        MaterialMap out = mMap;
        out.width = static_cast<int>(mX.size());
        out.height = static_cast<int>(mY.size());
        const std::size_t texels = mX.size() * mY.size();
        const auto values = static_cast<std::size_t>(mMap.knots()) * 3;
        out.logProfile.resize(texels * values);
        tbb::parallel_for(0, out.height, [&](int y) {
            for (int x = 0; x < out.width; ++x) {
                resizeTexel(x, y, out.logProfile.data() + out.index(x, y, 0));
            }
        });
        out.roughness = resizePlane(mMap.roughness);
        out.specular = resizePlane(mMap.specular);
        return out;
    }

private:
    template<typename Visit>
    void forEachTap(int x, int y, const Visit& visit) const {
        const Taps& tx = mX[static_cast<std::size_t>(x)];
        const Taps& ty = mY[static_cast<std::size_t>(y)];
        for (std::size_t j = 0; j < ty.index.size(); ++j) {
            for (std::size_t i = 0; i < tx.index.size(); ++i) {
                visit(static_cast<std::size_t>(ty.index[j]) * static_cast<std::size_t>(mMap.width) +
                          static_cast<std::size_t>(tx.index[i]),
                      tx.weight[i] * ty.weight[j]);
            }
        }
    }

    void resizeTexel(int x, int y, float* out) const {
        const auto values = static_cast<std::size_t>(mMap.knots()) * 3;
        std::vector<double> sum(values, 0.0);
        std::array<double, 3> albedo{};
        forEachTap(x, y, [&](std::size_t texel, double weight) {
            const float* logProfile = mMap.logProfile.data() + texel * values;
            for (std::size_t i = 0; i < values; ++i) {
                const double logP = static_cast<double>(logProfile[i]);
                sum[i] += weight * (mShrinks ? std::exp(logP) : logP);
            }
            for (std::size_t c = 0; c < 3; ++c) {
                albedo[c] += weight * static_cast<double>(mAlbedo[texel * 3 + c]);
            }
        });
        for (std::size_t i = 0; i < values; ++i) {
            const double logP = mShrinks ? std::log(std::max(sum[i], 1e-30)) : sum[i];
            out[i] = std::max(static_cast<float>(logP), kLogProfileFloor);
        }
        for (int c = 0; c < 3; ++c) {
            shiftToAlbedo(out, mMap.segments, static_cast<double>(mMap.maxRadiusMm), c,
                          albedo[static_cast<std::size_t>(c)]);
        }
    }

    [[nodiscard]] std::vector<float> resizePlane(const std::vector<float>& plane) const {
        std::vector<float> out;
        if (plane.empty()) {
            return out;
        }
        for (int y = 0; y < static_cast<int>(mY.size()); ++y) {
            for (int x = 0; x < static_cast<int>(mX.size()); ++x) {
                double sum = 0.0;
                forEachTap(x, y, [&](std::size_t texel, double weight) {
                    sum += weight * static_cast<double>(plane[texel]);
                });
                out.push_back(static_cast<float>(sum));
            }
        }
        return out;
    }

    const MaterialMap& mMap;
    std::vector<float> mAlbedo;
    bool mShrinks;
    std::vector<Taps> mX, mY;
};

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
        width == map.width && height == map.height ? map : Resizer(map, width, height).run();
    const int segments = settings.segments > 0 ? settings.segments : map.segments;
    const double maxRadiusMm =
        settings.maxRadiusMm > 0.0 ? settings.maxRadiusMm : static_cast<double>(map.maxRadiusMm);
    if (segments != map.segments || static_cast<float>(maxRadiusMm) != map.maxRadiusMm) {
        out = refit(out, segments, maxRadiusMm);
    }
    return out;
}

} // namespace celadon::subedit
