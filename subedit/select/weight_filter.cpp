#include "subedit/select/weight_filter.h"

#include "subedit/paint/surface_distance.h"

#include <algorithm>
#include <vector>

namespace celadon::subedit {

namespace {

constexpr int kSoftLevels = 16;

struct CoveredWeights {
    std::vector<float> weight; ///< per texel of the map
    int levels = 1;            ///< one if all are 0 or 1
};

CoveredWeights coveredWeights(const Surface& surface, const WeightMask& mask) {
    CoveredWeights result{std::vector<float>(surface.texelCount(), 0.0f), 1};
    for (const Surface::Texel texel : surface.coveredTexels()) {
        const WeightMask::Weight w = mask.at(std::size_t{texel});
        result.weight[texel] = weightToFloat(w);
        if (w != 0 && w != WeightMask::kFull) {
            result.levels = kSoftLevels;
        }
    }
    return result;
}

std::vector<Surface::Texel> texelsWhere(const Surface& surface, const std::vector<float>& weight,
                                        float threshold, bool isAbove) {
    std::vector<Surface::Texel> texels;
    for (const Surface::Texel texel : surface.coveredTexels()) {
        if ((weight[texel] > threshold) == isAbove) {
            texels.push_back(texel);
        }
    }
    return texels;
}

WeightMask toMask(const Surface& surface, const std::vector<float>& weight) {
    WeightMask mask(surface.width(), surface.height());
    for (const Surface::Texel texel : surface.coveredTexels()) {
        mask.set(std::size_t{texel}, weightFromFloat(weight[texel]));
    }
    repeatInGutters(surface, mask);
    return mask;
}

float levelOf(int i, int levels) {
    return (static_cast<float>(i) + 0.5f) / static_cast<float>(levels);
}

} // namespace

void repeatInGutters(const Surface& surface, WeightMask& mask) {
    for (Surface::Texel texel = 0; texel < surface.texelCount(); ++texel) {
        if (!surface.isCovered(texel)) {
            const Surface::Texel source = surface.sourceOf(texel);
            mask.set(std::size_t{texel}, source == Surface::kNone ? WeightMask::Weight{0}
                                                                  : mask.at(std::size_t{source}));
        }
    }
}

WeightMask growWeights(const Surface& surface, const WeightMask& mask, float distanceMm) {
    const CoveredWeights before = coveredWeights(surface, mask);
    std::vector<float> after = before.weight;
    // Distances to the sets of weight above falling levels: the weight that reaches a texel is the
    // level whose set is just `distanceMm` away, interpolated between the levels computed.
    const float reach = distanceMm + 4.0f * surface.texelSizeMm();
    std::vector<float> higher(surface.texelCount(), kUnreached);
    for (int i = before.levels - 1; i >= 0; --i) {
        const float level = levelOf(i, before.levels);
        const std::vector<float> distance =
            surfaceDistanceMm(surface, texelsWhere(surface, before.weight, level, true), reach);
        const bool isTop = i == before.levels - 1;
        const float next = isTop ? 1.0f : levelOf(i + 1, before.levels);
        for (const Surface::Texel texel : surface.coveredTexels()) {
            if (distance[texel] > distanceMm || higher[texel] <= distanceMm) {
                continue; // not yet, or already decided by a higher level
            }
            const float far = std::min(higher[texel], reach);
            const float t = isTop ? 1.0f : (distanceMm - distance[texel]) / (far - distance[texel]);
            after[texel] = std::max(after[texel], level + t * (next - level));
        }
        higher = distance;
    }
    return toMask(surface, after);
}

WeightMask featherWeights(const Surface& surface, const WeightMask& mask, float distanceMm) {
    const CoveredWeights before = coveredWeights(surface, mask);
    std::vector<float> after(surface.texelCount(), 0.0f);
    const float half = 0.5f * surface.texelSizeMm(); // the edge lies between two texels' centers
    for (int i = 0; i < before.levels; ++i) {
        const float level = levelOf(i, before.levels);
        const float reach = distanceMm + surface.texelSizeMm();
        const std::vector<float> outside =
            surfaceDistanceMm(surface, texelsWhere(surface, before.weight, level, true), reach);
        const std::vector<float> inside =
            surfaceDistanceMm(surface, texelsWhere(surface, before.weight, level, false), reach);
        for (const Surface::Texel texel : surface.coveredTexels()) {
            const float signedDistance =
                before.weight[texel] > level ? half - inside[texel] : outside[texel] - half;
            const float t = std::clamp(0.5f - 0.5f * signedDistance / distanceMm, 0.0f, 1.0f);
            after[texel] += t * t * (3.0f - 2.0f * t) / static_cast<float>(before.levels);
        }
    }
    return toMask(surface, after);
}

} // namespace celadon::subedit
