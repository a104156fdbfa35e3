#include "subedit/map/material_bake.h"

#include "subedit/assert.h"
#include "subedit/fit/albedo_shift.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/normalized_diffusion.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

constexpr double kEnergyOfRadius = 0.95;
constexpr float kBlackAlbedo = 1e-6f;

/// Fitted profiles of albedo 1 over a logarithmic range of effective radii: texels interpolate
/// between them, so that a map costs no fit per texel.
class ShapeTable {
public:
    ShapeTable(double shortestMm, double longestMm, int segments, double maxRadiusMm)
        : mKnots(static_cast<std::size_t>(segments) + 1), mLogShortest(std::log(shortestMm)) {
        constexpr double kEntriesPerUnit = 64.0; // 1.6 % from one to the next
        const double span = std::log(longestMm) - mLogShortest;
        const auto entries = static_cast<std::size_t>(std::ceil(span * kEntriesPerUnit)) + 1;
        mScale = entries > 1 ? static_cast<double>(entries - 1) / span : 0.0;
        mLogP.resize(entries * mKnots);
        const double unitRadius = normalizedDiffusionRadius(kEnergyOfRadius);
        tbb::parallel_for(std::size_t{0}, entries, [&](std::size_t i) {
            const double along =
                entries > 1 ? static_cast<double>(i) / static_cast<double>(entries - 1) : 0.0;
            const double radius = std::exp(mLogShortest + span * along);
            static_cast<void>(fitChannel(normalizedDiffusionCurve(1.0, radius / unitRadius),
                                         segments, maxRadiusMm, mLogP.data() + i * mKnots,
                                         PeakFit::Blended));
        });
    }

    /// @param out segments + 1 values of ln P
    void profile(double radiusMm, double* out) const {
        const std::size_t entries = mLogP.size() / mKnots;
        const double position = std::clamp((std::log(radiusMm) - mLogShortest) * mScale, 0.0,
                                           static_cast<double>(entries - 1));
        const auto first = static_cast<std::size_t>(position);
        const std::size_t second = std::min(first + 1, entries - 1);
        const double t = position - static_cast<double>(first);
        for (std::size_t k = 0; k < mKnots; ++k) {
            const double a = mLogP[first * mKnots + k];
            out[k] = a + (mLogP[second * mKnots + k] - a) * t;
        }
    }

private:
    std::size_t mKnots;
    double mLogShortest;
    double mScale = 0.0;
    std::vector<double> mLogP;
};

} // namespace

MaterialMap bakeAppearance(const AppearanceMap& appearance, const BakeSettings& settings) {
    const std::size_t texels = appearance.albedo.size();
    CELADON_ASSERT(texels > 0 && appearance.effectiveRadius.size() == texels);
    float shortest = appearance.effectiveRadius.front().x;
    float longest = shortest;
    for (const glm::vec3& radius : appearance.effectiveRadius) {
        CELADON_ASSERT(std::min({radius.x, radius.y, radius.z}) > 0.0f);
        shortest = std::min({shortest, radius.x, radius.y, radius.z});
        longest = std::max({longest, radius.x, radius.y, radius.z});
    }
    const double held =
        normalizedDiffusionRadius(settings.heldEnergy) / normalizedDiffusionRadius(kEnergyOfRadius);
    const double maxRadiusMm =
        settings.maxRadiusMm > 0.0 ? settings.maxRadiusMm : held * static_cast<double>(longest);

    MaterialMap map;
    map.name = appearance.name;
    map.width = appearance.width;
    map.height = appearance.height;
    map.segments = settings.segments;
    map.maxRadiusMm = static_cast<float>(maxRadiusMm);
    map.eta = appearance.eta;
    map.roughness = appearance.roughness;
    const auto knots = static_cast<std::size_t>(map.knots());
    map.logProfile.resize(texels * knots * 3);

    const ShapeTable table(static_cast<double>(shortest), static_cast<double>(longest),
                           settings.segments, maxRadiusMm);
    tbb::parallel_for(std::size_t{0}, texels, [&](std::size_t texel) {
        std::vector<double> logP(knots);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const auto c = static_cast<glm::vec3::length_type>(channel);
            const float albedo = appearance.albedo[texel][c];
            float* out = map.logProfile.data() + texel * knots * 3 + channel;
            if (albedo <= kBlackAlbedo) {
                for (std::size_t k = 0; k < knots; ++k) {
                    out[k * 3] = kLogProfileFloor;
                }
                continue;
            }
            table.profile(static_cast<double>(appearance.effectiveRadius[texel][c]), logP.data());
            const double shift = albedoShift(logP.data(), 1, settings.segments, maxRadiusMm,
                                             static_cast<double>(albedo));
            for (std::size_t k = 0; k < knots; ++k) {
                out[k * 3] = std::max(static_cast<float>(logP[k] + shift), kLogProfileFloor);
            }
        }
    });
    return map;
}

glm::vec3 effectiveRadiusFromMeanFreePath(const glm::vec3& albedo,
                                          const glm::vec3& meanFreePathMm) {
    static const double unitRadius = normalizedDiffusionRadius(kEnergyOfRadius);
    glm::vec3 radius;
    for (int channel = 0; channel < 3; ++channel) {
        const double scale = normalizedDiffusionScale(static_cast<double>(albedo[channel]),
                                                      DiffusionFit::Searchlight);
        radius[channel] =
            static_cast<float>(static_cast<double>(meanFreePathMm[channel]) / scale * unitRadius);
    }
    return radius;
}

} // namespace celadon::subedit
