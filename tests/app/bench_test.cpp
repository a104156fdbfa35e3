// What `celadon bench` measures with: materials of the ranges that it claims, and reports without
// NaN.
#include "app/bench/bench_scene.h"
#include "app/bench/scaling_suite.h"
#include "app/bench/table_report.h"
#include "app/bench/triangle_count.h"
#include "renderer/scene/builtin.h"
#include "renderer/scene/weld_vertices.h"
#include "subedit/effective_radius.h"
#include "subedit/errors.h"
#include "subedit/radius_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
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

/// Volume of what triangles enclose, and how many of their edges are not shared by two of them.
struct Solid {
    double volume = 0.0;
    std::size_t openEdges = 0;
};
Solid solidOf(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = weldVertices(mesh.positions);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    Solid solid;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* const t = &mesh.indices[i];
        const glm::dvec3 a(mesh.positions[t[0]]);
        solid.volume += glm::dot(a, glm::cross(glm::dvec3(mesh.positions[t[1]]),
                                               glm::dvec3(mesh.positions[t[2]]))) /
                        6.0;
        for (std::size_t c = 0; c < 3; ++c) {
            ++edges[std::minmax(welded[t[c]], welded[t[(c + 1) % 3]])];
        }
    }
    for (const auto& [edge, triangles] : edges) {
        solid.openEdges += triangles == 2 ? 0u : 1u;
    }
    return solid;
}

TEST(Bench, ModelsAreBroughtToTheTriangleCountsOfTheScenes) {
    const Scene sphere = makeBuiltin("sphere");
    const std::size_t present = sphere.meshes[0].triangleCount();
    const Solid before = solidOf(sphere.meshes[0]);
    ASSERT_EQ(before.openEdges, 0u);
    EXPECT_EQ(withTriangleCount(sphere, present + present / 100).meshes[0].indices,
              sphere.meshes[0].indices); // close enough: as it is
    for (const std::size_t count : {present / 3, 2 * present + 10}) {
        const Scene changed = withTriangleCount(sphere, count);
        const Mesh& mesh = changed.meshes.at(0);
        EXPECT_NEAR(static_cast<double>(mesh.triangleCount()), static_cast<double>(count), 1.0);
        EXPECT_TRUE(mesh.uvs.empty());
        const Solid after = solidOf(mesh);
        EXPECT_EQ(after.openEdges, 0u) << count;
        // Splitting keeps the surface; collapsing keeps its volume about as well as it can.
        EXPECT_NEAR(after.volume, before.volume, (count > present ? 1e-6 : 2e-3) * before.volume);
        EXPECT_EQ(withTriangleCount(sphere, count).meshes[0].positions, mesh.positions);
    }
}

TEST(Bench, AModelThatCannotHaveSoFewTrianglesIsRefused) {
    Scene open = makeBuiltin("sphere");
    Mesh& mesh = open.meshes[0];
    std::vector<glm::vec3> apart;
    for (const std::uint32_t i : mesh.indices) { // each triangle by itself: all border
        apart.push_back(mesh.positions[i] * (1.0f + 1e-3f * static_cast<float>(apart.size() / 3)));
    }
    mesh.positions = apart;
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    EXPECT_THROW((void)withTriangleCount(open, 100), InputError);
}

/// A scene with two methods by hand.
SceneResult exampleScene() {
    SceneResult scene;
    scene.scene = benchScenes("table1")[2];
    MethodResult none;
    none.method = "none";
    none.time.medianMs = none.time.leastMs = none.time.greatestMs = 100.0;
    MethodResult ours;
    ours.method = "hierarchical";
    ours.time.medianMs = 4.0;
    ours.image = {0.008, 0.999};
    scene.methods = {none, ours};
    return scene;
}

TEST(Bench, ReportsWhatWasNotMeasuredAsNull) {
    TableOptions options;
    options.backends = {SplatBackendKind::Cpu};
    const BenchDocument document = tableDocument({}, options, {exampleScene()});
    const nlohmann::json json = nlohmann::json::parse(document.json.dump());
    const auto& methods = json["scenes"][0]["methods"];
    EXPECT_DOUBLE_EQ(methods[1]["speedUp"].get<double>(), 25.0);
    EXPECT_DOUBLE_EQ(methods[1]["framesPerSecond"].get<double>(), 250.0);
    EXPECT_TRUE(methods[0]["imageReference"]["relativeRmse"].is_null());
    EXPECT_TRUE(methods[1]["splattingError"]["meanRatio"].is_null());
    EXPECT_TRUE(json["scenes"][0]["modelError"]["relativeRmse"].is_null());
    EXPECT_NEAR(methods[1]["paperSpeedUp"].get<double>(), 66.0 / 5.6, 1e-9);
    EXPECT_THAT(document.markdown, testing::HasSubstr("| bunny | 0 | hierarchical | cpu | 4 "));
    EXPECT_EQ(document.charts.size(), 2u);
    for (const auto& [name, chart] : document.charts) {
        EXPECT_FALSE(chart.shapes.empty()) << name;
    }
}

TEST(Bench, SpeedUpsAreOverNoneByTheSameBackend) {
    SceneResult scene = exampleScene();
    scene.methods[1].backend = SplatBackendKind::Raster;
    EXPECT_TRUE(std::isnan(speedUp(scene, scene.methods[1])));
    scene.methods[0].backend = SplatBackendKind::Raster;
    EXPECT_DOUBLE_EQ(speedUp(scene, scene.methods[1]), 25.0);
}

TEST(Bench, GrowthExponentIsThePowerOfAPowerLaw) {
    EXPECT_NEAR(growthExponent({{1, 3}, {2, 3 * std::sqrt(2.0)}, {4, 6}}), 0.5, 1e-12);
    EXPECT_NEAR(growthExponent({{10, 7}, {20, 7}}), 0.0, 1e-12);
    EXPECT_TRUE(std::isnan(growthExponent({{1, 3}})));
    EXPECT_TRUE(std::isnan(growthExponent({{1, 3}, {2, 0}})));
}

TEST(Bench, SaysWhereAModelIsMissing) {
    for (BenchScene scene : benchScenes("table1")) {
        scene.model = "mesh/nowhere.ply";
        EXPECT_TRUE(isModelMissing(scene));
        scene.model.clear();
        EXPECT_FALSE(isModelMissing(scene));
    }
    EXPECT_THAT(modelFolderMessage(), testing::HasSubstr("CELADON_MODELS"));
}

TEST(Bench, ALightTurnedAllTheWayIsTheSame) {
    BenchView view;
    view.lights = {Light{}};
    view.lights[0].direction = glm::normalize(glm::dvec3(-0.4, -0.5, -0.77));
    const glm::dvec3 d = view.lights[0].direction;
    EXPECT_LT(glm::distance(withTurnedLight(view, 360).lights[0].direction, d), 1e-12);
    const glm::dvec3 turned = withTurnedLight(view, 0.3).lights[0].direction;
    EXPECT_DOUBLE_EQ(turned.y, d.y);
    EXPECT_NEAR(glm::length(turned), 1.0, 1e-12);
    EXPECT_NEAR(glm::distance(turned, d), 0.3 * 3.14159265 / 180 * std::hypot(d.x, d.z), 1e-6);
}

} // namespace
} // namespace celadon::app
