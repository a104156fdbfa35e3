#include "subedit/radius_map.h"

#include "subedit/assert.h"
#include "subedit/texel_energy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace celadon::subedit {

namespace {

/// Calls work(texel index, its ln P, its energies) for the texels of a rectangle, on all cores.
template<typename Work>
void forEachTexel(const MaterialMap& map, const TexelRect& rect, const Work& work) {
    const auto width = static_cast<std::size_t>(map.width);
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    tbb::parallel_for(tbb::blocked_range<int>(rect.y, rect.bottom(), 8),
                      [&](const tbb::blocked_range<int>& rows) {
                          TexelEnergy energy(map.segments);
                          for (int y = rows.begin(); y != rows.end(); ++y) {
                              for (int x = rect.x; x < rect.right(); ++x) {
                                  const std::size_t i = static_cast<std::size_t>(y) * width +
                                                        static_cast<std::size_t>(x);
                                  const float* logProfile = map.logProfile.data() + i * stride;
                                  energy.compute(logProfile);
                                  work(i, logProfile, energy);
                              }
                          }
                      });
}

TexelRect wholeMap(const MaterialMap& map) {
    return {0, 0, map.width, map.height};
}

} // namespace

void updateEffectiveRadiusMap(const MaterialMap& map, const TexelRect& rect, double energyFraction,
                              std::span<float> radiusMm) {
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments);
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    const float blackTotal = TexelEnergy::blackTotal(h);
    const float smallest = map.maxRadiusMm * 1e-3f;
    const auto fraction = static_cast<float>(energyFraction);
    forEachTexel(map, rect, [&](std::size_t i, const float* logProfile, const TexelEnergy& energy) {
        const float radius = fraction >= 1.0f ? map.maxRadiusMm
                                              : h * energy.radius(logProfile, fraction, blackTotal);
        radiusMm[i] = std::clamp(radius, smallest, map.maxRadiusMm);
    });
}

std::vector<std::vector<float>> effectiveRadiusMaps(const MaterialMap& map,
                                                    std::span<const double> energyFractions) {
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments);
    const std::size_t texels = wholeMap(map).texels();
    std::vector<std::vector<float>> radii(energyFractions.size(), std::vector<float>(texels));
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    const float blackTotal = TexelEnergy::blackTotal(h);
    const float smallest = map.maxRadiusMm * 1e-3f;
    forEachTexel(map, wholeMap(map),
                 [&](std::size_t i, const float* logProfile, const TexelEnergy& energy) {
                     for (std::size_t e = 0; e < radii.size(); ++e) {
                         const auto fraction = static_cast<float>(energyFractions[e]);
                         const float radius =
                             fraction >= 1.0f ? map.maxRadiusMm
                                              : h * energy.radius(logProfile, fraction, blackTotal);
                         radii[e][i] = std::clamp(radius, smallest, map.maxRadiusMm);
                     }
                 });
    return radii;
}

std::vector<float> effectiveRadiusMap(const MaterialMap& map, double energyFraction) {
    std::vector<float> radius(wholeMap(map).texels());
    updateEffectiveRadiusMap(map, wholeMap(map), energyFraction, radius);
    return radius;
}

std::vector<float> albedoMap(const MaterialMap& map) {
    std::vector<float> albedo(wholeMap(map).texels() * 3);
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    forEachTexel(map, wholeMap(map), [&](std::size_t i, const float*, const TexelEnergy& energy) {
        for (int channel = 0; channel < 3; ++channel) {
            albedo[i * 3 + static_cast<std::size_t>(channel)] = energy.albedo(channel, h);
        }
    });
    return albedo;
}

} // namespace celadon::subedit
