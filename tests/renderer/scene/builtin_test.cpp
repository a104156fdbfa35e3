#include "renderer/scene/builtin.h"
#include "subedit/errors.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace celadon {
namespace {

/// Vertices at equal positions as one.
std::vector<std::uint32_t> weld(const Mesh& mesh) {
    std::map<std::tuple<float, float, float>, std::uint32_t> seen;
    std::vector<std::uint32_t> welded;
    for (const glm::vec3& p : mesh.positions) {
        const auto next = static_cast<std::uint32_t>(seen.size());
        welded.push_back(seen.try_emplace({p.x, p.y, p.z}, next).first->second);
    }
    return welded;
}

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Made once for all tests of it.
const Scene& builtin(const std::string& name) {
    static std::map<std::string, Scene> made;
    const auto found = made.find(name);
    return found != made.end() ? found->second
                               : made.emplace(name, makeBuiltin(name)).first->second;
}

class EveryBuiltin : public testing::TestWithParam<std::string> {
protected:
    EveryBuiltin() : scene(builtin(GetParam())), mesh(scene.meshes.at(0)) {}

    [[nodiscard]] glm::dvec3 corner(std::size_t i) const {
        return glm::dvec3(mesh.positions[mesh.indices[i]]);
    }
    [[nodiscard]] double area(std::size_t t) const {
        return 0.5 * glm::length(glm::cross(corner(t + 1) - corner(t), corner(t + 2) - corner(t)));
    }
    /// Signed; positive where the texture is not mirrored, v being down.
    [[nodiscard]] double uvArea(std::size_t t) const {
        const glm::dvec2 a(mesh.uvs[mesh.indices[t]]);
        const glm::dvec2 b(mesh.uvs[mesh.indices[t + 1]]);
        const glm::dvec2 c(mesh.uvs[mesh.indices[t + 2]]);
        return -0.5 * cross(b - a, c - a);
    }

    const Scene& scene;
    const Mesh& mesh;
};

TEST_P(EveryBuiltin, IsAWholeScene) {
    EXPECT_EQ(scene.name, "builtin:" + GetParam());
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_FALSE(scene.materials.empty());
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
    EXPECT_EQ(scene.millimetersPerUnit, 1.0);
    EXPECT_LE(mesh.triangleCount(), 220000u);
    for (const std::uint32_t index : mesh.indices) {
        ASSERT_LT(index, mesh.positions.size());
    }
    const BoundingSphere sphere = boundingSphere(scene);
    EXPECT_GT(sphere.radius, 45.0);
    EXPECT_LT(sphere.radius, 75.0);
}

TEST_P(EveryBuiltin, IsWatertightAndOriented) {
    const std::vector<std::uint32_t> welded = weld(mesh);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(mesh.indices.size());
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            edges.emplace_back(welded[mesh.indices[t + i]], welded[mesh.indices[t + (i + 1) % 3]]);
        }
    }
    std::sort(edges.begin(), edges.end());
    // Each directed edge once, and its reverse once: two triangles an edge, facing the same way.
    EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
    std::size_t open = 0;
    for (const auto& [a, b] : edges) {
        open += !std::binary_search(edges.begin(), edges.end(), std::pair{b, a});
    }
    EXPECT_EQ(open, 0u);
    double volume = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        volume += glm::dot(corner(t), glm::cross(corner(t + 1), corner(t + 2))) / 6.0;
    }
    EXPECT_GT(volume, 1000.0);
}

TEST_P(EveryBuiltin, NormalsAreUnitAndFollowTheTriangles) {
    for (const glm::vec3& normal : mesh.normals) {
        ASSERT_NEAR(glm::length(normal), 1.0f, 1e-5f);
    }
    double agreeing = 0.0;
    double total = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::dvec3 face = glm::cross(corner(t + 1) - corner(t), corner(t + 2) - corner(t));
        ASSERT_GT(glm::length(face), 0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 normal(mesh.normals[mesh.indices[t + i]]);
            agreeing += glm::dot(normal, face);
            total += glm::length(face);
        }
    }
    EXPECT_GT(agreeing / total, 0.97);
}

TEST_P(EveryBuiltin, TexelsAreSpreadEvenly) {
    double area3d = 0.0;
    double area2d = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        area3d += area(t);
        area2d += std::abs(uvArea(t));
    }
    double mean = 0.0;
    double far = 0.0;
    double mirrored = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const double density = (uvArea(t) / area2d) / (area(t) / area3d);
        mean += area(t) / area3d * std::max(std::abs(density), 1.0 / std::abs(density));
        far += std::abs(density) < 0.25 || std::abs(density) > 4.0 ? area(t) / area3d : 0.0;
        mirrored += density <= 0.0 ? area(t) / area3d : 0.0;
    }
    EXPECT_LT(mean, 1.6);
    EXPECT_LT(far, 0.03);
    EXPECT_EQ(mirrored, 0.0);
    EXPECT_GT(area2d, 0.3); // of the unit square
    RecordProperty("distortion", std::to_string(mean));
}

/// At the centers of a raster no two triangles cover the same texel; and all is inside the square.
TEST_P(EveryBuiltin, ChartsDoNotOverlap) {
    constexpr int kSize = 1024;
    std::vector<std::uint8_t> covered(kSize * kSize, 0);
    int twice = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        std::array<glm::dvec2, 3> p;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec2 uv = mesh.uvs[mesh.indices[t + i]];
            ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
            // An offset no chart is aligned with, so that no center lies on an edge.
            p[i] = glm::dvec2(uv) * static_cast<double>(kSize) - glm::dvec2(0.5137, 0.4871);
        }
        const glm::dvec2 low = glm::ceil(glm::min(p[0], glm::min(p[1], p[2])));
        const glm::dvec2 high = glm::floor(glm::max(p[0], glm::max(p[1], p[2])));
        const double sign = cross(p[1] - p[0], p[2] - p[0]) < 0.0 ? -1.0 : 1.0;
        for (int y = std::max(0, static_cast<int>(low.y)); y <= std::min(kSize - 1.0, high.y);
             ++y) {
            for (int x = std::max(0, static_cast<int>(low.x)); x <= std::min(kSize - 1.0, high.x);
                 ++x) {
                const glm::dvec2 c(x, y);
                if (sign * cross(p[1] - p[0], c - p[0]) > 1e-9 &&
                    sign * cross(p[2] - p[1], c - p[1]) > 1e-9 &&
                    sign * cross(p[0] - p[2], c - p[2]) > 1e-9) {
                    std::uint8_t& count = covered[static_cast<std::size_t>(y * kSize + x)];
                    twice += count > 0;
                    count = 1;
                }
            }
        }
    }
    EXPECT_EQ(twice, 0);
}

TEST_P(EveryBuiltin, IsMadeTheSameEachTime) {
    const Scene again = makeBuiltin(GetParam());
    EXPECT_EQ(again.meshes[0].positions, mesh.positions);
    EXPECT_EQ(again.meshes[0].uvs, mesh.uvs);
    EXPECT_EQ(again.meshes[0].indices, mesh.indices);
}

INSTANTIATE_TEST_SUITE_P(Builtins, EveryBuiltin, testing::ValuesIn(builtinNames()),
                         [](const auto& name) { return name.param; });

TEST(Builtins, UnknownNamesListTheKnown) {
    for (const char* name : {"", "teapot", "Sphere", "builtin:sphere"}) {
        try {
            (void)makeBuiltin(name);
            ADD_FAILURE() << name;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find("slab"), std::string::npos);
        }
    }
}

TEST(Builtins, SphereAndSlabHaveTheirSizes) {
    const Scene& sphere = builtin("sphere");
    for (const glm::vec3& p : sphere.meshes[0].positions) {
        ASSERT_NEAR(glm::length(p), 50.0f, 1e-4f);
    }
    const Scene& slab = builtin("slab");
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (const glm::vec3& p : slab.meshes[0].positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_EQ(low, glm::vec3(-50.0f, -10.0f, -50.0f));
    EXPECT_EQ(high, glm::vec3(50.0f, 10.0f, 50.0f));
}

} // namespace
} // namespace celadon
