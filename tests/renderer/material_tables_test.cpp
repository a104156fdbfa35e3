// The tables of materials, in single precision and by whole vectors, against the closed forms in
// double precision.
#include "renderer/material_tables.h"
#include "subedit/effective_radius.h"
#include "subedit/log_linear.h"
#include "subedit/radius_map.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace celadon {
namespace {

using subedit::MaterialMap;

/// Smooth texels, one black in a channel, one black in all, one of a constant P, one that falls to
/// the floor within a segment.
MaterialMap variedMaterial() {
    MaterialMap map = subedit::test::varyingMaterial(19, 7, 24);
    const auto fill = [&](int x, int y, int channel, const auto& value) {
        for (int k = 0; k < map.knots(); ++k) {
            map.logProfile[map.index(x, y, k) + static_cast<std::size_t>(channel)] = value(k);
        }
    };
    const auto black = [](int) { return subedit::kLogProfileFloor; };
    fill(3, 1, 1, black);
    for (int c = 0; c < 3; ++c) {
        fill(18, 6, c, black);
        fill(0, 4, c, [](int) { return -7.0f; });
        fill(5, 5, c, [](int k) { return k == 0 ? -1.0f : subedit::kLogProfileFloor; });
    }
    return map;
}

TEST(MaterialTables, AreTheClosedForms) {
    const MaterialMap map = variedMaterial();
    const std::size_t values = static_cast<std::size_t>(map.knots()) * 3;
    const std::vector<float> mean = makeMaterialTables(map, 0.01).meanLogProfile;
    const double h = static_cast<double>(map.maxRadiusMm) / map.segments;
    for (const double energy : {1.0, 0.99, 0.8}) {
        const TexelTables tables =
            makeTexelTables(map, {0, 0, map.width, map.height}, energy, mean);
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                SCOPED_TRACE(::testing::Message() << x << ' ' << y << " energy " << energy);
                const subedit::ProfileView profile = subedit::profileAt(map, x, y);
                const auto t = static_cast<std::size_t>(y * map.width + x);
                const glm::dvec3 radius = subedit::effectiveRadiusMm(profile, 0.95);
                const glm::dvec3 cuts = subedit::effectiveRadiusMm(profile, energy);
                const double cut = energy < 1.0 ? std::max({cuts.x, cuts.y, cuts.z})
                                                : static_cast<double>(map.maxRadiusMm);
                const double tolerance = 1e-4 * static_cast<double>(map.maxRadiusMm);
                EXPECT_NEAR(tables.radii[4 * t], std::max({radius.x, radius.y, radius.z}),
                            tolerance);
                EXPECT_NEAR(tables.radii[4 * t + 1], cut, tolerance);
                EXPECT_NEAR(tables.radii[4 * t + 2], std::min({radius.x, radius.y, radius.z}),
                            tolerance);
                const glm::dvec3 inside = subedit::radialEnergy(profile, cut);
                const glm::dvec3 total = subedit::radialEnergy(profile, profile.maxRadiusMm);
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto i = static_cast<int>(c);
                    if (total[i] > 1e-10) {
                        EXPECT_NEAR(tables.kept[4 * t + c],
                                    std::clamp(inside[i] / total[i], 0.5, 1.0), 1e-4);
                    }
                    double beyond = 0.0;
                    for (int k = map.segments; k-- > 0;) {
                        const auto product = [&](int knot) {
                            const auto at = static_cast<std::size_t>(knot) * 3 + c;
                            return 0.5 * static_cast<double>(profile.logProfile[at] + mean[at]);
                        };
                        beyond += subedit::pieceEnergy(product(k), product(k + 1), k * h, h);
                        EXPECT_NEAR(
                            tables.logFarEnergy[t * values + static_cast<std::size_t>(k) * 3 + c],
                            std::log(beyond), 2e-5)
                            << "knot " << k;
                    }
                }
            }
        }
    }
}

TEST(MaterialTables, ARectangleGetsTheBitsOfTheWhole) {
    const MaterialMap map = variedMaterial();
    const std::vector<float> mean = makeMaterialTables(map, 0.01).meanLogProfile;
    const TexelTables whole = makeTexelTables(map, {0, 0, map.width, map.height}, 0.99, mean);
    const subedit::TexelRect rect{2, 1, 9, 5};
    const TexelTables part = makeTexelTables(map, rect, 0.99, mean);
    const std::size_t values = static_cast<std::size_t>(map.knots()) * 3;
    for (int y = 0; y < rect.height; ++y) {
        for (int x = 0; x < rect.width; ++x) {
            const auto t = static_cast<std::size_t>(y * rect.width + x);
            const auto w = static_cast<std::size_t>((rect.y + y) * map.width + rect.x + x);
            for (std::size_t i = 0; i < 4; ++i) {
                EXPECT_EQ(part.radii[4 * t + i], whole.radii[4 * w + i]);
                EXPECT_EQ(part.kept[4 * t + i], whole.kept[4 * w + i]);
            }
            for (std::size_t i = 0; i < values; ++i) {
                EXPECT_EQ(part.logFarEnergy[values * t + i], whole.logFarEnergy[values * w + i]);
            }
        }
    }
}

} // namespace
} // namespace celadon
