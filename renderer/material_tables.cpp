#include "renderer/material_tables.h"

#include "subedit/effective_radius.h"
#include "subedit/log_linear.h"
#include "subedit/mean_profile.h"
#include "subedit/radius_map.h"
#include "subedit/range_table.h"

#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

using subedit::MaterialMap;

constexpr double kTinyEnergy = 1e-30;

/// Mean of ln P over the texels: [segments + 1][3].
std::vector<double> meanLogProfile(const MaterialMap& map) {
    const std::size_t values = static_cast<std::size_t>(map.knots()) * 3;
    std::vector<double> mean(values, 0.0);
    const std::size_t texels = map.logProfile.size() / values;
    for (std::size_t t = 0; t < texels; ++t) {
        for (std::size_t i = 0; i < values; ++i) {
            mean[i] += static_cast<double>(map.logProfile[t * values + i]);
        }
    }
    for (double& value : mean) {
        value /= static_cast<double>(texels);
    }
    return mean;
}

void fillRadii(const MaterialMap& map, const subedit::TexelRect& rect, double energy,
               TexelTables& tables) {
    tables.radii.assign(rect.texels() * 4, 0.0f);
    tables.kept.assign(rect.texels() * 4, 1.0f);
    tbb::parallel_for(rect.y, rect.bottom(), [&](int y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            const subedit::ProfileView profile = subedit::profileAt(map, x, y);
            const glm::dvec3 radius = subedit::effectiveRadiusMm(profile, 0.95);
            double cut = map.maxRadiusMm;
            glm::dvec3 kept(1.0);
            if (energy < 1.0) {
                const glm::dvec3 cuts = subedit::effectiveRadiusMm(profile, energy);
                cut = std::max({cuts.x, cuts.y, cuts.z});
                const glm::dvec3 inside = subedit::radialEnergy(profile, cut);
                const glm::dvec3 total = subedit::radialEnergy(profile, map.maxRadiusMm);
                kept = glm::clamp(inside / glm::max(total, glm::dvec3(kTinyEnergy)), 0.5, 1.0);
            }
            const std::size_t i =
                4 * (static_cast<std::size_t>(y - rect.y) * static_cast<std::size_t>(rect.width) +
                     static_cast<std::size_t>(x - rect.x));
            tables.radii[i] = static_cast<float>(std::max({radius.x, radius.y, radius.z}));
            tables.radii[i + 1] = static_cast<float>(cut);
            tables.radii[i + 2] = static_cast<float>(std::min({radius.x, radius.y, radius.z}));
            for (int c = 0; c < 3; ++c) {
                tables.kept[i + static_cast<std::size_t>(c)] = static_cast<float>(kept[c]);
            }
        }
    });
}

void fillFarEnergy(const MaterialMap& map, const subedit::TexelRect& rect,
                   const std::vector<double>& mean, TexelTables& tables) {
    const std::size_t texels = rect.texels();
    const int knots = map.knots();
    tables.logFarEnergy.assign(texels * static_cast<std::size_t>(knots) * 4, 0.0f);
    const double h = static_cast<double>(map.maxRadiusMm) / map.segments;
    tbb::parallel_for(rect.y, rect.bottom(), [&](int y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            const float* logP = map.logProfile.data() + map.index(x, y, 0);
            const std::size_t texel =
                static_cast<std::size_t>(y - rect.y) * static_cast<std::size_t>(rect.width) +
                static_cast<std::size_t>(x - rect.x);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto product = [&](int k) {
                    const std::size_t i = static_cast<std::size_t>(k) * 3 + c;
                    return 0.5 * (static_cast<double>(logP[i]) + mean[i]);
                };
                double energy = 0.0;
                for (int k = knots - 1; k >= 0; --k) {
                    if (k < map.segments) {
                        energy += subedit::pieceEnergy(product(k), product(k + 1), k * h, h);
                    }
                    tables.logFarEnergy[(static_cast<std::size_t>(k) * texels + texel) * 4 + c] =
                        static_cast<float>(std::log(std::max(energy, kTinyEnergy)));
                }
            }
        }
    });
}

} // namespace

TexelTables makeTexelTables(const MaterialMap& map, const subedit::TexelRect& rect, double energy,
                            const std::vector<double>& meanLogProfile) {
    TexelTables tables;
    fillRadii(map, rect, energy, tables);
    fillFarEnergy(map, rect, meanLogProfile, tables);
    return tables;
}

MaterialTables makeMaterialTables(const MaterialMap& map, double energy, double epsilon) {
    MaterialTables tables;
    tables.meanLogProfile = meanLogProfile(map);
    tables.texels =
        makeTexelTables(map, {0, 0, map.width, map.height}, energy, tables.meanLogProfile);
    double sum = 0.0;
    const std::size_t texels = tables.texels.radii.size() / 4;
    for (std::size_t t = 0; t < texels; ++t) {
        sum += static_cast<double>(tables.texels.radii[4 * t]);
    }
    tables.meanRadiusMm = static_cast<float>(sum / static_cast<double>(texels));
    std::vector<float> radii = subedit::effectiveRadiusMap(map);
    const auto table = subedit::RangeTable::build(subedit::meanProfile(map, radii), epsilon);
    tables.rangeTable.assign(table.values().begin(), table.values().end());
    const auto quarter = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 4);
    std::nth_element(radii.begin(), quarter, radii.end());
    tables.shortRadiusMm = *quarter;
    return tables;
}

} // namespace celadon
