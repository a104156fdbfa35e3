#include "subedit/radius_map.h"

#include "subedit/assert.h"
#include "subedit/texel_energy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace celadon::subedit {

namespace {

/// Calls work(texel index, its ln P, its energies) for the texels of a rectangle.
template<typename Work>
void forEachTexelOf(const MaterialMap& map, const TexelRect& rect, const Work& work) {
    const auto width = static_cast<std::size_t>(map.width);
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    TexelEnergy energy(map.segments);
    for (int y = rect.y; y != rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            const float* logProfile = map.logProfile.data() + i * stride;
            energy.compute(logProfile);
            work(i, logProfile, energy);
        }
    }
}

/// The same for the whole map, on all cores.
template<typename Work>
void forEachTexel(const MaterialMap& map, const Work& work) {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, map.height, 8), [&](const tbb::blocked_range<int>& rows) {
            forEachTexelOf(map, {0, rows.begin(), map.width, rows.end() - rows.begin()}, work);
        });
}

std::size_t texelsOf(const MaterialMap& map) {
    return static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
}

/// R_P of a texel in mm for one fraction; never zero.
struct RadiusRule {
    float h, blackTotal, smallest, largest, fraction;

    RadiusRule(const MaterialMap& map, double energyFraction)
        : h(map.maxRadiusMm / static_cast<float>(map.segments)),
          blackTotal(TexelEnergy::blackTotal(h)),
          smallest(map.maxRadiusMm * 1e-3f),
          largest(map.maxRadiusMm),
          fraction(static_cast<float>(energyFraction)) {}

    [[nodiscard]] float operator()(const float* logProfile, const TexelEnergy& energy) const {
        return fraction >= 1.0f ? largest
                                : std::clamp(h * energy.radius(logProfile, fraction, blackTotal),
                                             smallest, largest);
    }
};

} // namespace

void updateEffectiveRadii(const MaterialMap& map, const TexelRect& rect, double energyFraction,
                          std::span<float> radiusMm) {
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments);
    const RadiusRule rule(map, energyFraction);
    forEachTexelOf(map, rect,
                   [&](std::size_t i, const float* logProfile, const TexelEnergy& energy) {
                       radiusMm[i] = rule(logProfile, energy);
                   });
}

std::vector<std::vector<float>> effectiveRadiusMaps(const MaterialMap& map,
                                                    std::span<const double> energyFractions) {
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments);
    std::vector<std::vector<float>> radii(energyFractions.size(),
                                          std::vector<float>(texelsOf(map)));
    std::vector<RadiusRule> rules;
    for (const double fraction : energyFractions) {
        rules.emplace_back(map, fraction);
    }
    forEachTexel(map, [&](std::size_t i, const float* logProfile, const TexelEnergy& energy) {
        for (std::size_t e = 0; e < radii.size(); ++e) {
            radii[e][i] = rules[e](logProfile, energy);
        }
    });
    return radii;
}

std::vector<float> effectiveRadiusMap(const MaterialMap& map, double energyFraction) {
    return std::move(effectiveRadiusMaps(map, {&energyFraction, 1}).front());
}

std::vector<float> albedoMap(const MaterialMap& map) {
    std::vector<float> albedo(texelsOf(map) * 3);
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    forEachTexel(map, [&](std::size_t i, const float*, const TexelEnergy& energy) {
        for (int channel = 0; channel < 3; ++channel) {
            albedo[i * 3 + static_cast<std::size_t>(channel)] = energy.albedo(channel, h);
        }
    });
    return albedo;
}

std::vector<float> lastSegmentMap(const MaterialMap& map) {
    std::vector<float> part(texelsOf(map));
    const float blackTotal =
        TexelEnergy::blackTotal(map.maxRadiusMm / static_cast<float>(map.segments));
    forEachTexel(map, [&](std::size_t i, const float*, const TexelEnergy& energy) {
        for (int channel = 0; channel < 3; ++channel) {
            if (energy.total(channel) > blackTotal) {
                part[i] = std::max(part[i], energy.last(channel) / energy.total(channel));
            }
        }
    });
    return part;
}

} // namespace celadon::subedit
