#include "renderer/scene/atlas.h"
#include "subedit/errors.h"
#include "tests/renderer/scene/atlas_checks.h"
#include "tests/renderer/scene/atlas_shapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <set>

namespace celadon {
namespace {

using namespace test;

Atlas atlasOf(const Mesh& mesh, const AtlasSettings& settings = kSmallMap) {
    const Mesh* one = &mesh;
    return generateAtlas(std::span(&one, 1), settings);
}

TEST(Atlas, SingleTriangleFillsWhatATriangleCan) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    const Atlas atlas = expectGoodAtlas(mesh);
    EXPECT_EQ(atlas.report.charts, 1);
    EXPECT_GT(atlas.report.coverage, 0.45);
    EXPECT_NEAR(atlas.report.areaDistortionMean, 1.0, 1e-6);
}

TEST(Atlas, CubeUnfoldsWithoutDistortion) {
    const Atlas atlas = expectGoodAtlas(makeCube());
    EXPECT_LE(atlas.report.charts, 3);
    EXPECT_NEAR(atlas.report.areaDistortionMax, 1.0, 1e-3);
}

TEST(Atlas, CylinderRollsOut) {
    const Atlas atlas = expectGoodAtlas(makeCylinder(48, 20));
    EXPECT_LE(atlas.report.charts, 2);
    EXPECT_NEAR(atlas.report.areaDistortionMean, 1.0, 1e-3);
}

TEST(Atlas, SphereAndTorusInFewChartsOfLowDistortion) {
    const Atlas sphere = expectGoodAtlas(makeSphere(64, 32));
    EXPECT_LE(sphere.report.charts, 6);
    EXPECT_LT(sphere.report.areaDistortionMean, 1.12);
    EXPECT_GT(sphere.report.coverage, 0.45); // two disks in a square: 0.54 without gutters
    const Atlas torus = expectGoodAtlas(makeTorus(64, 32));
    EXPECT_LE(torus.report.charts, 10);
    EXPECT_LT(torus.report.areaDistortionMean, 1.12);
}

TEST(Atlas, MoebiusStrip) {
    expectGoodAtlas(makeMoebiusStrip(40));
}

TEST(Atlas, VerticesAtEqualPositionsAreJoined) {
    const Mesh sphere = makeSphere(32, 16);
    const Mesh loose = exploded(sphere);
    EXPECT_EQ(expectGoodAtlas(loose).report.charts, atlasOf(sphere).report.charts);
}

TEST(Atlas, InconsistentWindingKeepsEachTriangleItsOwnWay) {
    expectGoodAtlas(inconsistentlyWound(makeSphere(16, 8)));
}

TEST(Atlas, EdgesOfManyTriangles) {
    for (const int pages : {3, 4, 60}) {
        expectGoodAtlas(makeBook(pages));
    }
}

TEST(Atlas, SheetsBackToBackStayApart) {
    Mesh mesh = makeCylinder(24, 6);
    const std::size_t corners = mesh.indices.size();
    for (std::size_t i = 0; i < corners; i += 3) {
        mesh.indices.insert(mesh.indices.end(),
                            {mesh.indices[i], mesh.indices[i + 2], mesh.indices[i + 1]});
    }
    EXPECT_LE(expectGoodAtlas(mesh).report.charts, 4);
}

TEST(Atlas, Soup) {
    expectGoodAtlas(makeSoup(30, 300, 1), AtlasSettings{1400, 2});
    expectGoodAtlas(makeSoup(2000, 1000, 2), AtlasSettings{1400, 2});
}

TEST(Atlas, DegenerateTrianglesGetFiniteCoordinates) {
    Mesh mesh = makeSphere(24, 12);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{3, 0, 0}, {3, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}});
    mesh.indices.insert(mesh.indices.end(), {5, 5, 9});                      // two corners alike
    mesh.indices.insert(mesh.indices.end(), {7, 7, 7});                      // a point
    mesh.indices.insert(mesh.indices.end(), {base, base + 1, base + 2});     // a loose point
    mesh.indices.insert(mesh.indices.end(), {base + 2, base + 3, base + 4}); // a loose line
    const Atlas atlas = expectGoodAtlas(mesh);
    EXPECT_LE(atlas.report.charts, 6);
}

TEST(Atlas, SliversInsideASurface) {
    // A flat strip whose middle row of triangles has no height (T-junctions filled with lines).
    Mesh mesh;
    constexpr std::uint32_t kCount = 20;
    for (std::uint32_t i = 0; i <= kCount; ++i) {
        const auto x = static_cast<float>(i);
        for (const float y : {0.0f, 1.0f, 1.0f, 2.0f}) {
            mesh.positions.emplace_back(x, y, y == 1.0f && i % 2 == 1 ? 1e-7f : 0.0f);
        }
    }
    for (std::uint32_t i = 0; i < kCount; ++i) {
        for (std::uint32_t row = 0; row < 3; ++row) {
            const std::uint32_t a = 4 * i + row;
            mesh.indices.insert(mesh.indices.end(), {a, a + 4, a + 5, a, a + 5, a + 1});
        }
    }
    const Atlas atlas = expectGoodAtlas(mesh);
    EXPECT_EQ(atlas.report.charts, 1);
    EXPECT_LT(atlas.report.areaDistortionMean, 1.02);
}

TEST(Atlas, ThousandsOfTinyParts) {
    const Mesh mesh = makeManyTetrahedra(2500, 3);
    const Atlas atlas = expectGoodAtlas(mesh, AtlasSettings{1024, 4});
    EXPECT_LE(atlas.report.charts, 2.2 * 2500);
    EXPECT_LT(atlas.report.areaDistortionMean, 1.1);
}

TEST(Atlas, MoreChartsThanGuttersCanHoldStillDoNotOverlap) {
    const Mesh mesh = makeSoup(9000, 3000, 4);
    const Mesh* one = &mesh;
    const Atlas atlas = atlasOf(mesh, {64, 4});
    expectWellFormed(std::span(&one, 1), atlas);
    expectNoOverlap(std::span(&one, 1), atlas, 2048);
    EXPECT_LT(atlas.report.gutterTexels, 4);
}

TEST(Atlas, HugeAndTinyCoordinates) {
    for (const float scale : {1e-30f, 1e-6f, 1e6f, 1e37f}) {
        Mesh mesh = makeSphere(24, 12);
        for (glm::vec3& p : mesh.positions) {
            p *= scale;
        }
        EXPECT_LE(expectGoodAtlas(mesh).report.charts, 6) << scale;
    }
    Mesh mixed = makeSphere(24, 12);
    append(mixed, makeSphere(12, 6, {5.0f, 0.0f, 0.0f}, 1e-5f));
    expectGoodAtlas(mixed);
}

TEST(Atlas, SeveralMeshesShareTheSquare) {
    const Mesh sphere = makeSphere(24, 12);
    const Mesh torus = makeTorus(24, 12);
    const Mesh* meshes[] = {&sphere, &torus, &sphere};
    const Atlas atlas = expectGoodAtlas(meshes);
    std::set<std::uint32_t> charts[3];
    for (int m = 0; m < 3; ++m) {
        charts[m].insert(atlas.meshes[m].chartOfTriangle.begin(),
                         atlas.meshes[m].chartOfTriangle.end());
    }
    for (const std::uint32_t chart : charts[2]) {
        EXPECT_FALSE(charts[0].contains(chart) || charts[1].contains(chart));
    }
}

TEST(Atlas, GutterFollowsTheSettings) {
    const Mesh mesh = makeTorus(32, 16);
    for (const AtlasSettings settings :
         {AtlasSettings{256, 2}, AtlasSettings{500, 8}, AtlasSettings{1500, 4},
          AtlasSettings{1024, 16}, AtlasSettings{512, 0}}) {
        expectGoodAtlas(mesh, settings);
    }
}

TEST(Atlas, SameBytesWhateverTheThreads) {
    Mesh mesh = makeTorus(48, 24);
    append(mesh, makeManyTetrahedra(60, 5));
    const Atlas first = atlasOf(mesh);
    EXPECT_TRUE(sameBytes(first, atlasOf(mesh)));
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(sameBytes(first, atlasOf(mesh)));
}

TEST(Atlas, RefusesWhatHasNoSurface) {
    Mesh line;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.indices = {0, 1, 2};
    EXPECT_THROW((void)atlasOf(line), InputError);
    EXPECT_THROW((void)atlasOf(Mesh{}), InputError);
    Mesh broken = makeCube();
    broken.positions[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW((void)atlasOf(broken), InputError);
}

TEST(Atlas, ApplyCarriesAttributesAlong) {
    Mesh mesh = makeCube();
    for (const glm::vec3& p : mesh.positions) {
        mesh.normals.push_back(glm::normalize(p - 0.5f));
        mesh.uvs1.emplace_back(p.x, p.y);
    }
    const Mesh before = mesh;
    const Atlas atlas = atlasOf(mesh);
    applyAtlas(atlas.meshes[0], mesh);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs1.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        EXPECT_EQ(mesh.positions[mesh.indices[i]], before.positions[before.indices[i]]);
        EXPECT_EQ(mesh.normals[mesh.indices[i]], before.normals[before.indices[i]]);
        EXPECT_EQ(mesh.uvs1[mesh.indices[i]], before.uvs1[before.indices[i]]);
    }
}

} // namespace
} // namespace celadon
