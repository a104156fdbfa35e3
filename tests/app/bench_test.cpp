// What `celadon bench` measures with: materials of the ranges that it claims, and reports without
// NaN.
#include "app/bench/bench_report.h"
#include "app/bench/bench_scene.h"
#include "subedit/effective_radius.h"
#include "subedit/errors.h"
#include "subedit/radius_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace celadon::app {
namespace {

TEST(Bench, Table1HasThePapersScenes) {
    const std::vector<BenchScene> scenes = benchScenes("table1");
    ASSERT_EQ(scenes.size(), 6u);
    for (const BenchScene& scene : scenes) {
        EXPECT_GT(scene.paperFps[3], scene.paperFps[0]) << scene.name;
    }
    EXPECT_THROW(benchScenes("table2"), UsageError);
}

TEST(Bench, MapsSpanTheirRanges) {
    for (const std::string suite : {"table1", "quick"}) {
        for (BenchScene scene : benchScenes(suite)) {
            scene.mapSize = glm::min(scene.mapSize, glm::ivec2(64)); // the ranges are the same
            constexpr double kRadiusMm = 50.0;
            const MaterialPointer map = benchMaterial(scene, kRadiusMm);
            ASSERT_EQ(glm::ivec2(map->width, map->height), scene.mapSize);
            std::vector<float> radii = subedit::effectiveRadiusMap(*map);
            const auto [least, greatest] = std::ranges::minmax(radii);
            // Of 32 segments the shortest profiles fill few.
            EXPECT_NEAR(static_cast<double>(greatest), scene.range.y * kRadiusMm,
                        0.05 * scene.range.y * kRadiusMm)
                << scene.name;
            EXPECT_NEAR(static_cast<double>(least), scene.range.x * kRadiusMm,
                        0.25 * scene.range.x * kRadiusMm)
                << scene.name;
            for (int x = 0; x < map->width; x += 7) {
                const glm::dvec3 energy =
                    subedit::radialEnergy(subedit::profileAt(*map, x, x % map->height),
                                          static_cast<double>(map->maxRadiusMm));
                EXPECT_LT(std::max({energy.r, energy.g, energy.b}) * 2.0 * 3.14159265, 1.0);
            }
        }
    }
}

TEST(Bench, ReportsWhatWasNotMeasuredAsNull) {
    BenchReport report;
    SceneResult scene;
    scene.scene = benchScenes("table1")[2];
    MethodResult none;
    none.method = "none";
    none.time.medianMs = 100.0;
    MethodResult ours;
    ours.method = "hierarchical";
    ours.time.medianMs = 4.0;
    ours.image = {0.008, 0.999};
    scene.methods = {none, ours};
    report.scenes = {scene};
    const nlohmann::json json = nlohmann::json::parse(toJson(report));
    const auto& methods = json["scenes"][0]["methods"];
    EXPECT_DOUBLE_EQ(methods[1]["speedUp"].get<double>(), 25.0);
    EXPECT_DOUBLE_EQ(methods[1]["framesPerSecond"].get<double>(), 250.0);
    EXPECT_TRUE(methods[0]["imageReference"]["relativeRmse"].is_null());
    EXPECT_TRUE(methods[1]["surfaceReference"]["meanRatio"].is_null());
    EXPECT_NEAR(json["scenes"][0]["paperSpeedUp"].get<double>(), 66.0 / 5.6, 1e-9);
    EXPECT_THAT(toMarkdown(report), testing::HasSubstr("| bunny | 0 | hierarchical | 4 | 25.0 |"));
}

} // namespace
} // namespace celadon::app
