#include "subedit/map/material_resize.h"

#include "subedit/assert.h"
#include "subedit/radius_map.h"
#include "subedit/texel_energy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace celadon::subedit {

namespace {

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

/// Of the targets from `first` on.
std::vector<Taps> makeAxis(int first, int count, int targetSize, int sourceSize) {
    std::vector<Taps> axis;
    for (int i = first; i < first + count; ++i) {
        axis.push_back(makeTaps(i, targetSize, sourceSize));
    }
    return axis;
}

class Resizer {
public:
    /// @param size of the whole target @param rect of it that will be made
    Resizer(const MaterialMap& map, glm::ivec2 size, const TexelRect& rect)
        : mMap(map),
          mValues(static_cast<std::size_t>(map.knots()) * 3),
          mRect(rect),
          mX(makeAxis(rect.x, rect.width, size.x, map.width)),
          mY(makeAxis(rect.y, rect.height, size.y, map.height)),
          mShrinks(size.x < map.width || size.y < map.height) {
        if (!mShrinks) { // each is asked for several times
            mAlbedo = albedoMap(map);
        }
    }

    /// The rectangle's profiles.
    void resizeProfiles(MaterialMap& out) const {
        tbb::parallel_for(
            tbb::blocked_range<int>(0, mRect.height, 4), [&](const tbb::blocked_range<int>& rows) {
                TexelEnergy energy(mMap.segments);
                std::vector<float> sum(mValues);
                for (int y = rows.begin(); y != rows.end(); ++y) {
                    for (int x = 0; x < mRect.width; ++x) {
                        resizeTexel(x, y, energy, sum,
                                    out.logProfile.data() + out.index(mRect.x + x, mRect.y + y, 0));
                    }
                }
            });
    }

    [[nodiscard]] std::vector<float> resizePlane(const std::vector<float>& plane) const {
        std::vector<float> out;
        if (plane.empty()) {
            return out;
        }
        for (int y = 0; y < mRect.height; ++y) {
            for (int x = 0; x < mRect.width; ++x) {
                double sum = 0.0;
                forEachTap(x, y, [&](std::size_t texel, double weight) {
                    sum += weight * static_cast<double>(plane[texel]);
                });
                out.push_back(static_cast<float>(sum));
            }
        }
        return out;
    }

private:
    /// @param x, y within the rectangle
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

    /// @param energy, sum scratch
    void resizeTexel(int x, int y, TexelEnergy& energy, std::vector<float>& sum, float* out) const {
        const float h = mMap.maxRadiusMm / static_cast<float>(mMap.segments);
        std::ranges::fill(sum, 0.0f);
        std::array<double, 3> albedo{};
        forEachTap(x, y, [&](std::size_t texel, double weight) {
            const float* const logProfile = mMap.logProfile.data() + texel * mValues;
            if (mShrinks) {
                energy.compute(logProfile);
            }
            const float* const from = mShrinks ? energy.values() : logProfile;
            const float share = static_cast<float>(weight);
            for (std::size_t i = 0; i < mValues; ++i) {
                sum[i] += share * from[i];
            }
            for (int c = 0; c < 3; ++c) {
                const auto channel = static_cast<std::size_t>(c);
                albedo[channel] +=
                    weight * static_cast<double>(mShrinks ? energy.albedo(c, h)
                                                          : mAlbedo[texel * 3 + channel]);
            }
        });
        for (std::size_t i = 0; i < mValues; ++i) {
            const float logP = mShrinks ? std::log(std::max(sum[i], 1e-30f)) : sum[i];
            out[i] = std::max(logP, kLogProfileFloor);
        }
        energy.compute(out);
        for (int c = 0; c < 3; ++c) {
            const double wanted = albedo[static_cast<std::size_t>(c)];
            if (wanted >= static_cast<double>(kBlackAlbedo)) {
                shiftChannel(out + c, static_cast<float>(std::log(
                                          wanted / static_cast<double>(energy.albedo(c, h)))));
            }
        }
    }

    void shiftChannel(float* logProfile, float shift) const {
        for (std::size_t i = 0; i < mValues; i += 3) {
            logProfile[i] = std::max(logProfile[i] + shift, kLogProfileFloor);
        }
    }

    const MaterialMap& mMap;
    std::size_t mValues; ///< of a profile
    TexelRect mRect;
    std::vector<Taps> mX, mY;
    bool mShrinks;
    std::vector<float> mAlbedo; ///< of the map, where it does not shrink
};

/// First and one past the last target whose footprint touches the source texels [first, end).
std::pair<int, int> touched(int first, int end, int sourceSize, int targetSize) {
    const double scale = static_cast<double>(targetSize) / sourceSize;
    return {static_cast<int>(first * scale),
            std::min(static_cast<int>(std::ceil(end * scale)), targetSize)};
}

} // namespace

MaterialMap resizeMaterial(const MaterialMap& map, int width, int height) {
    CELADON_ASSERT(width > 0 && height > 0);
    const TexelRect all{0, 0, width, height};
    const Resizer resizer(map, {width, height}, all);
    MaterialMap out;
    out.name = map.name;
    out.width = width;
    out.height = height;
    out.segments = map.segments;
    out.maxRadiusMm = map.maxRadiusMm;
    out.eta = map.eta;
    out.logProfile.resize(all.texels() * static_cast<std::size_t>(map.knots()) * 3);
    resizer.resizeProfiles(out);
    out.roughness = resizer.resizePlane(map.roughness);
    out.specular = resizer.resizePlane(map.specular);
    return out;
}

TexelRect updateSmaller(const MaterialMap& map, const TexelRect& rect, MaterialMap& smaller) {
    CELADON_ASSERT(!rect.isEmpty() && smaller.width <= map.width && smaller.height <= map.height);
    const auto [left, right] = touched(rect.x, rect.right(), map.width, smaller.width);
    const auto [top, bottom] = touched(rect.y, rect.bottom(), map.height, smaller.height);
    const TexelRect made{left, top, right - left, bottom - top};
    Resizer(map, {smaller.width, smaller.height}, made).resizeProfiles(smaller);
    return made;
}

} // namespace celadon::subedit
