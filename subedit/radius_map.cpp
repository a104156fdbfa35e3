#include "subedit/radius_map.h"

#include "subedit/assert.h"
#include "subedit/texel_energy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace celadon::subedit {

namespace {

std::size_t texelOf(const MaterialMap& map, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
           static_cast<std::size_t>(x);
}

/// Calls work(texel index, its energies) for the texels of a rectangle.
template<typename Work>
void forEachTexelOf(const MaterialMap& map, const TexelRect& rect, const Work& work) {
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    TexelEnergy energy(map.segments);
    for (int y = rect.y; y != rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            const std::size_t i = texelOf(map, x, y);
            energy.compute(map.logProfile.data() + i * stride);
            work(i, energy);
        }
    }
}

/// Calls work(rectangle) for all rows, some at a time, on all cores.
template<typename Work>
void forEachRows(const MaterialMap& map, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<int>(0, map.height, 8),
                      [&](const tbb::blocked_range<int>& rows) {
                          work(TexelRect{0, rows.begin(), map.width, rows.end() - rows.begin()});
                      });
}

/// The same for each texel.
template<typename Work>
void forEachTexel(const MaterialMap& map, const Work& work) {
    forEachRows(map, [&](const TexelRect& rows) { forEachTexelOf(map, rows, work); });
}

std::size_t texelsOf(const MaterialMap& map) {
    return static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
}

/// R_P in mm for one fraction; never zero.
struct RadiusRule {
    float h, blackTotal, smallest, largest, fraction;

    RadiusRule(const MaterialMap& map, double energyFraction)
        : h(map.maxRadiusMm / static_cast<float>(map.segments)),
          blackTotal(TexelEnergy::blackTotal(h)),
          smallest(map.maxRadiusMm * 1e-3f),
          largest(map.maxRadiusMm),
          fraction(static_cast<float>(energyFraction)) {}

    /// In units of h, and not yet within bounds, when the search has finished.
    void add(RadiusSearch& search, const TexelEnergy& energy, float& radius) const {
        energy.addRadius(search, fraction, blackTotal, radius);
    }

    [[nodiscard]] float inMm(float radius) const {
        return fraction >= 1.0f ? largest : std::clamp(h * radius, smallest, largest);
    }
};

} // namespace

void updateEffectiveRadii(const MaterialMap& map, const TexelRect& rect, double energyFraction,
                          std::span<float> radiusMm) {
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments);
    const RadiusRule rule(map, energyFraction);
    RadiusSearch search;
    forEachTexelOf(map, rect, [&](std::size_t i, const TexelEnergy& energy) {
        rule.add(search, energy, radiusMm[i]);
    });
    search.finish();
    for (int y = rect.y; y != rect.bottom(); ++y) {
        float* const row = radiusMm.data() + texelOf(map, rect.x, y);
        std::transform(row, row + rect.width, row, [&](float radius) { return rule.inMm(radius); });
    }
}

std::vector<float> effectiveRadiusMap(const MaterialMap& map, double energyFraction) {
    std::vector<float> radius(texelsOf(map));
    forEachRows(map, [&](const TexelRect& rows) {
        updateEffectiveRadii(map, rows, energyFraction, radius);
    });
    return radius;
}

std::vector<float> albedoMap(const MaterialMap& map) {
    std::vector<float> albedo(texelsOf(map) * 3);
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    forEachTexel(map, [&](std::size_t i, const TexelEnergy& energy) {
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
    forEachTexel(map, [&](std::size_t i, const TexelEnergy& energy) {
        for (int channel = 0; channel < 3; ++channel) {
            if (energy.total(channel) > blackTotal) {
                part[i] = std::max(part[i], energy.last(channel) / energy.total(channel));
            }
        }
    });
    return part;
}

} // namespace celadon::subedit
