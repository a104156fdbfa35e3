#include "renderer/material_tables.h"

#include "subedit/fast_log.h"
#include "subedit/mean_profile.h"
#include "subedit/multiversion.h"
#include "subedit/radius_map.h"
#include "subedit/range_table.h"
#include "subedit/texel_energy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace celadon {

namespace {

using subedit::MaterialMap;
using subedit::RadiusSearch;
using subedit::TexelEnergy;

constexpr float kTinyEnergy = 1e-30f; ///< in units of h^2

/// Mean of ln P over the texels: [segments + 1][3].
std::vector<float> meanLogProfile(const MaterialMap& map) {
    const std::size_t values = static_cast<std::size_t>(map.knots()) * 3;
    const auto width = static_cast<std::size_t>(map.width);
    const auto height = static_cast<std::size_t>(map.height);
    std::vector<double> rows(height * values, 0.0);
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        double* const sum = rows.data() + y * values;
        const float* from = map.logProfile.data() + y * width * values;
        for (std::size_t x = 0; x < width; ++x, from += values) {
            for (std::size_t i = 0; i < values; ++i) {
                sum[i] += static_cast<double>(from[i]);
            }
        }
    });
    std::vector<float> mean(values);
    for (std::size_t i = 0; i < values; ++i) {
        double sum = 0.0;
        for (std::size_t y = 0; y < height; ++y) {
            sum += rows[y * values + i];
        }
        mean[i] = static_cast<float>(sum / static_cast<double>(width * height));
    }
    return mean;
}

/// The same for all texels of a map.
struct Layout {
    const MaterialMap& map;
    float energy; ///< that R_cut holds
    const std::vector<float>& mean;
    float h = map.maxRadiusMm / static_cast<float>(map.segments);
    float blackTotal = TexelEnergy::blackTotal(h);
};

/// R_P and R_cut of a row's texels, mm, and what of their energy lies within R_cut.
void fillRadii(const Layout& layout, const float* logP, int width, TexelEnergy& energy,
               float* radii, float* kept) {
    constexpr float kRadiusEnergy = 0.95f;
    const auto values = static_cast<std::size_t>(layout.map.knots()) * 3;
    std::vector<std::array<float, 3>> found(static_cast<std::size_t>(width));
    std::vector<float> cuts(layout.energy < 1.0f ? found.size() : 0);
    RadiusSearch search;
    for (std::size_t x = 0; x < found.size(); ++x) {
        energy.compute(logP + x * values);
        for (int c = 0; c < 3; ++c) {
            energy.addChannelRadius(search, c, kRadiusEnergy, layout.blackTotal,
                                    found[x][static_cast<std::size_t>(c)]);
        }
        if (!cuts.empty()) {
            energy.addRadius(search, layout.energy, layout.blackTotal, cuts[x]);
        }
    }
    search.finish();
    for (std::size_t x = 0; x < found.size(); ++x) {
        const auto [shortest, longest] = std::ranges::minmax(found[x]);
        radii[4 * x] = layout.h * longest;
        radii[4 * x + 1] = cuts.empty() ? layout.map.maxRadiusMm : layout.h * cuts[x];
        radii[4 * x + 2] = layout.h * shortest;
        if (!cuts.empty()) {
            energy.compute(logP + x * values);
            for (int c = 0; c < 3; ++c) {
                const float total = std::max(energy.total(c), kTinyEnergy);
                kept[4 * x + static_cast<std::size_t>(c)] =
                    std::clamp(energy.within(c, cuts[x]) / total, 0.5f, 1.0f);
            }
        }
    }
}

CELADON_MULTIVERSION void takeMeans(const float* __restrict a, const float* __restrict b, int count,
                                    float* __restrict mean) {
    for (int i = 0; i < count; ++i) {
        mean[i] = 0.5f * (a[i] + b[i]);
    }
}

CELADON_MULTIVERSION void takeLogs(float* __restrict x, int count, float logScale) {
    for (int i = 0; i < count; ++i) {
        const float bounded = x[i] > kTinyEnergy ? x[i] : kTinyEnergy;
        x[i] = subedit::fastLog(bounded) + logScale;
    }
}

void fillFarEnergy(const Layout& layout, const float* logP, int width, TexelEnergy& energy,
                   float* logFar) {
    const float logUnit = 2.0f * std::log(layout.h);
    const int segments = layout.map.segments;
    const int values = layout.map.knots() * 3;
    for (int x = 0; x < width; ++x, logP += values, logFar += values) {
        takeMeans(logP, layout.mean.data(), values, energy.logProfile());
        energy.compute();
        std::array<float, 3> sum{};
        for (int k = segments; k >= 0; --k) {
            for (int c = 0; c < 3; ++c) {
                float& beyond = sum[static_cast<std::size_t>(c)];
                beyond += k < segments ? energy.ofSegment(k, c) : 0.0f;
                logFar[3 * k + c] = beyond;
            }
        }
        takeLogs(logFar, values, logUnit);
    }
}

} // namespace

TexelTables makeTexelTables(const MaterialMap& map, const subedit::TexelRect& rect, double energy,
                            const std::vector<float>& meanLogProfile) {
    const Layout layout{map, static_cast<float>(energy), meanLogProfile};
    const std::size_t values = static_cast<std::size_t>(map.knots()) * 3;
    TexelTables tables;
    tables.radii.assign(rect.texels() * 4, 0.0f);
    tables.kept.assign(rect.texels() * 4, 1.0f);
    tables.logFarEnergy.resize(rect.texels() * values);
    tbb::parallel_for(tbb::blocked_range<int>(0, rect.height, 4), [&](const auto& rows) {
        TexelEnergy texel(map.segments);
        for (int row = rows.begin(); row < rows.end(); ++row) {
            const float* const logP = map.logProfile.data() + map.index(rect.x, rect.y + row, 0);
            const std::size_t t =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(rect.width);
            fillRadii(layout, logP, rect.width, texel, &tables.radii[4 * t], &tables.kept[4 * t]);
            fillFarEnergy(layout, logP, rect.width, texel, &tables.logFarEnergy[values * t]);
        }
    });
    return tables;
}

MaterialTables makeMaterialTables(const MaterialMap& map, double epsilon) {
    MaterialTables tables;
    tables.meanLogProfile = meanLogProfile(map);
    std::vector<float> radii = subedit::effectiveRadiusMap(map);
    const auto table = subedit::RangeTable::build(subedit::meanProfile(map, radii), epsilon);
    tables.rangeTable.assign(table.values().begin(), table.values().end());
    tables.meanRadiusMm = static_cast<float>(std::accumulate(radii.begin(), radii.end(), 0.0) /
                                             static_cast<double>(radii.size()));
    const auto quarter = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 4);
    std::nth_element(radii.begin(), quarter, radii.end());
    tables.shortRadiusMm = *quarter;
    return tables;
}

} // namespace celadon
