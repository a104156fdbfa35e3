#include "renderer/raster/triangle_raster.h"
#include "tests/renderer/raster/waves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

namespace celadon {
namespace {

using test::Waves;
using testing::Each;

/// Looks along -z from (0, 0, eye) at 90 degrees; reversed depth of an infinite view.
glm::mat4 perspective(float eye, float nearPlane = 0.01f) {
    glm::mat4 m(0.0f);
    m[0][0] = m[1][1] = 1.0f;
    m[2][3] = -1.0f;
    m[3] = glm::vec4(0.0f, 0.0f, nearPlane, eye);
    return m;
}

RasterMesh meshOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners) {
    RasterMesh mesh;
    mesh.vertices = &positions[0].x;
    mesh.vertexCount = positions.size();
    mesh.corners = corners;
    return mesh;
}

/// By brute force in double precision: the nearest triangle along the ray of a place in pixels.
std::uint32_t nearestByRay(const Waves& waves, const RasterView& view, glm::dvec2 place) {
    const glm::dvec2 ndc = 2.0 * place / glm::dvec2(view.size) - 1.0;
    std::uint32_t best = 0;
    double depth = 0.0;
    for (std::size_t t = 0; t < waves.corners.size() / 3; ++t) {
        std::array<glm::dvec4, 3> c;
        std::array<glm::dvec2, 3> q;
        for (std::size_t i = 0; i < 3; ++i) {
            c[i] = glm::dmat4(view.toClip) *
                   glm::dvec4(glm::dvec3(waves.positions[waves.corners[3 * t + i]]), 1.0);
            q[i] = glm::dvec2(c[i].x, c[i].y) - ndc * c[i].w;
        }
        const auto cross = [&](std::size_t i, std::size_t j) {
            return q[i].x * q[j].y - q[i].y * q[j].x;
        };
        const glm::dvec3 w(cross(1, 2), cross(2, 0), cross(0, 1));
        const double sum = w.x + w.y + w.z;
        if (sum == 0.0 || std::min({w.x / sum, w.y / sum, w.z / sum}) < 0.0) {
            continue;
        }
        const glm::dvec4 hit = (w.x * c[0] + w.y * c[1] + w.z * c[2]) / sum;
        if (hit.w > 0.0 && hit.z <= hit.w && hit.z / hit.w > depth) {
            depth = hit.z / hit.w;
            best = static_cast<std::uint32_t>(t) + 1;
        }
    }
    return best;
}

double fractionThatDiffers(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        differing += a[i] != b[i] ? 1 : 0;
    }
    return static_cast<double>(differing) / static_cast<double>(a.size());
}

TEST(TriangleRasterTest, FindsWhatRaysFind) {
    const Waves waves(24);
    // From far, from close above a wave, and from within the sheet: behind the eye as well.
    for (const float eye : {2.2f, 0.45f, 0.05f}) {
        RasterView view;
        view.size = {97, 61};
        view.toClip = perspective(eye);
        TriangleRaster raster;
        raster.draw(std::array{waves.mesh()}, view);
        int covered = 0;
        for (int i = 0; i < view.size.x * view.size.y; ++i) {
            const std::uint32_t seen = raster.triangles()[static_cast<std::size_t>(i)];
            covered += seen > 0 ? 1 : 0;
            const glm::dvec2 center =
                glm::dvec2(i % view.size.x, i / view.size.x) + glm::dvec2(0.5);
            // Corners are snapped to 1/256 of a pixel: a ray that close by must see the same.
            bool isSeen = nearestByRay(waves, view, center) == seen;
            for (int k = 0; k < 9 && !isSeen; ++k) {
                const glm::dvec2 aside(k % 3 - 1, k / 3 - 1);
                isSeen = nearestByRay(waves, view, center + aside / 200.0) == seen;
            }
            EXPECT_TRUE(isSeen) << "eye " << eye << ", pixel " << i << ", triangle " << seen;
        }
        EXPECT_GT(covered, 1000);
    }
}

TEST(TriangleRasterTest, SharedEdgesLeaveNoGapAndNoOverlap) {
    // A fan about a point of the pixel grid, jittered: every covered sample belongs to exactly one.
    std::mt19937 random(7);
    std::uniform_real_distribution<float> offset(-0.4f, 0.4f);
    for (int attempt = 0; attempt < 50; ++attempt) {
        Waves sheet(8, 0.0f);
        for (glm::vec3& p : sheet.positions) {
            if (std::max(std::abs(p.x), std::abs(p.y)) < 0.99f) {
                p.x += 0.1f * offset(random);
                p.y += 0.1f * offset(random);
            }
        }
        if (attempt == 0) {
            sheet = Waves(8, 0.0f); // corners exactly on pixel centers and borders
        }
        RasterView view;
        view.size = {64, 64};
        view.toClip[2][2] = 0.0f;
        view.toClip[3][2] = 0.5f;
        TriangleRaster raster;
        raster.draw(std::array{sheet.mesh()}, view);
        EXPECT_THAT(std::vector(raster.triangles().begin(), raster.triangles().end()),
                    Each(testing::Gt(0u)));
        std::vector<int> covered(64 * 64, 0);
        for (std::size_t t = 0; t < sheet.corners.size(); t += 3) {
            raster.draw(std::array{meshOf(sheet.positions, std::span(sheet.corners).subspan(t, 3))},
                        view);
            for (std::size_t i = 0; i < covered.size(); ++i) {
                covered[i] += raster.triangles()[i] > 0 ? 1 : 0;
            }
        }
        EXPECT_THAT(covered, Each(1));
    }
}

TEST(TriangleRasterTest, DepthIsThatOfThePlane) {
    const std::array positions{glm::vec3(-40, -40, -60), glm::vec3(40, -40, -2),
                               glm::vec3(0, 50, -20)};
    const std::array<std::uint32_t, 3> corners{0, 1, 2};
    const glm::dvec3 normal = glm::cross(glm::dvec3(positions[1] - positions[0]),
                                         glm::dvec3(positions[2] - positions[0]));
    RasterView view;
    view.size = {200, 150};
    view.toClip = perspective(0.0f, 0.5f);
    TriangleRaster raster;
    raster.draw(std::array{meshOf(positions, corners)}, view);
    int seen = 0;
    for (int row = 0; row < view.size.y; ++row) {
        for (int column = 0; column < view.size.x; ++column) {
            const std::size_t i = static_cast<std::size_t>(row * view.size.x + column);
            if (raster.triangles()[i] == 0) {
                EXPECT_EQ(raster.depths()[i], 0.0f);
                continue;
            }
            ++seen;
            const glm::dvec2 ndc =
                2.0 * (glm::dvec2(column, row) + 0.5) / glm::dvec2(view.size) - 1.0;
            const glm::dvec3 ray(ndc, -1.0);
            const double distance =
                glm::dot(glm::dvec3(positions[0]), normal) / glm::dot(ray, normal);
            EXPECT_NEAR(static_cast<double>(raster.depths()[i]), 0.5 / distance,
                        2e-3 * 0.5 / distance);
        }
    }
    EXPECT_GT(seen, 5000);
}

TEST(TriangleRasterTest, PlacesAreSamplesAndCenterDepthsThePlanes) {
    const Waves waves(12);
    const std::array places{glm::vec2(-0.125f, -0.375f), glm::vec2(0.375f, -0.125f)};
    RasterView view;
    view.size = {50, 40};
    view.toClip = perspective(1.5f);
    view.places = places;
    TriangleRaster samples;
    samples.draw(std::array{waves.mesh()}, view);
    const std::size_t pixels = 50 * 40;
    for (std::size_t p = 0; p < places.size(); ++p) {
        // The same as a picture that is moved the other way.
        RasterView moved = view;
        moved.places = {};
        glm::mat4 shift(1.0f);
        shift[3][0] = -2.0f * places[p].x / 50.0f;
        shift[3][1] = -2.0f * places[p].y / 40.0f;
        moved.toClip = shift * view.toClip;
        TriangleRaster expected;
        expected.draw(std::array{waves.mesh()}, moved);
        EXPECT_LT(fractionThatDiffers(samples.triangles().subspan(p * pixels, pixels),
                                      expected.triangles()),
                  0.01);
    }
    // Where a sample's triangle is the one that the center sees, so is its depth.
    view.places = {};
    TriangleRaster centers;
    centers.draw(std::array{waves.mesh()}, view);
    int alike = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (samples.triangles()[i] == centers.triangles()[i] && centers.triangles()[i] > 0) {
            ++alike;
            EXPECT_EQ(samples.centerDepths()[i], centers.depths()[i]);
        }
    }
    EXPECT_GT(alike, 500);
}

// As those of a light and of a camera do, whose bands of rows hold as many samples here.
TEST(TriangleRasterTest, PicturesOfSeveralSizesTakeTurns) {
    const Waves waves(12);
    const std::array places{glm::vec2(-0.125f, -0.375f), glm::vec2(0.375f, -0.125f)};
    RasterView light;
    light.size = {400, 40};
    light.toClip = perspective(1.5f);
    RasterView camera;
    camera.size = {50, 40};
    camera.toClip = perspective(1.5f);
    camera.places = places;
    TriangleRaster shared;
    for (const RasterView& view : {light, camera, light, camera}) {
        TriangleRaster own;
        own.draw(std::array{waves.mesh()}, view);
        shared.draw(std::array{waves.mesh()}, view);
        EXPECT_TRUE(std::ranges::equal(shared.triangles(), own.triangles()));
        EXPECT_TRUE(std::ranges::equal(shared.depths(), own.depths()));
        for (std::size_t i = 0; i < own.centerDepths().size(); ++i) {
            if (own.triangles()[i] > 0) {
                ASSERT_EQ(shared.centerDepths()[i], own.centerDepths()[i]);
            }
        }
    }
}

TEST(TriangleRasterTest, NearPlaneAndDepthClamp) {
    // A sheet that passes by the eye: with depth clamp what is before the near plane is seen, too.
    const std::array positions{glm::vec3(-1, -0.2, 1), glm::vec3(1, -0.2, 1),
                               glm::vec3(1, -0.2, -9), glm::vec3(-1, -0.2, -9)};
    const std::array<std::uint32_t, 6> corners{0, 1, 2, 0, 2, 3};
    RasterView view;
    view.size = {64, 64};
    view.toClip = perspective(0.0f, 0.4f);
    TriangleRaster raster;
    const auto lowestRow = [&](bool clamps) {
        view.clampsDepth = clamps;
        raster.draw(std::array{meshOf(positions, corners)}, view);
        const auto first = std::ranges::find_if(raster.triangles(), [](auto t) { return t > 0; });
        return (first - raster.triangles().begin()) / 64;
    };
    // At the near plane y / z is -0.5: a quarter of the picture from below.
    EXPECT_EQ(lowestRow(false), 16);
    EXPECT_EQ(lowestRow(true), 0);
    EXPECT_THAT(std::vector(raster.depths().begin(), raster.depths().end()),
                Each(testing::AllOf(testing::Ge(0.0f), testing::Le(1.0f))));
}

TEST(TriangleRasterTest, HolesLetSeeWhatIsBehind) {
    const std::array positions{glm::vec3(-1, -1, 0.2), glm::vec3(1, -1, 0.2), glm::vec3(1, 1, 0.2),
                               glm::vec3(-1, -1, 0),   glm::vec3(1, -1, 0),   glm::vec3(1, 1, 0)};
    const std::array<std::uint32_t, 3> front{0, 1, 2};
    const std::array<std::uint32_t, 3> back{3, 4, 5};
    RasterView view;
    view.size = {32, 32};
    view.toClip = perspective(1.0f);
    RasterMesh holed = meshOf(positions, front);
    holed.isHole = [](std::uint32_t, double u, double v) { return u + v < 0.5; };
    TriangleRaster raster;
    raster.draw(std::array{holed, meshOf(positions, back)}, view);
    const auto count = [&](std::uint32_t number) {
        return std::ranges::count(raster.triangles(), number);
    };
    EXPECT_GT(count(1), 0);
    EXPECT_GT(count(2), 0);
    // Half of the way along the edges: a quarter of the triangle is hole.
    const auto all = count(1);
    holed.isHole = {};
    raster.draw(std::array{holed, meshOf(positions, back)}, view);
    EXPECT_NEAR(static_cast<double>(all) / static_cast<double>(count(1)), 0.75, 0.05);
    EXPECT_EQ(raster.boundsOfMeshes()[0], glm::ivec4(0, 0, 32, 32));
}

TEST(TriangleRasterTest, CountsThroughAllMeshesAndTheFirstOfEqualsWins) {
    const Waves sheet(1, 0.0f);
    RasterView view;
    view.size = {16, 16};
    view.toClip = perspective(1.0f);
    TriangleRaster raster;
    raster.draw(std::array{sheet.mesh(), sheet.mesh()}, view);
    EXPECT_THAT(std::vector(raster.triangles().begin(), raster.triangles().end()),
                Each(testing::AnyOf(1u, 2u)));
    EXPECT_EQ(raster.boundsOfMeshes()[1], glm::ivec4(0));
    // The nearer one, although it comes second.
    std::vector<glm::vec3> nearer = sheet.positions;
    for (glm::vec3& p : nearer) {
        p = glm::vec3(0.25f * p.x, 0.25f * p.y, 0.1f);
    }
    raster.draw(std::array{sheet.mesh(), meshOf(nearer, sheet.corners)}, view);
    EXPECT_THAT(std::vector(raster.triangles().begin(), raster.triangles().end()),
                testing::Contains(testing::AnyOf(3u, 4u)));
    EXPECT_GT(raster.boundsOfMeshes()[1].z, 0);
}

TEST(TriangleRasterTest, WhatIsNotFiniteIsLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const std::array positions{glm::vec3(nan, 0, 0), glm::vec3(1, infinite, 0), glm::vec3(1, 1, 0),
                               glm::vec3(-1, -1, 0), glm::vec3(1e30f, 0, 0),    glm::vec3(0, 1, 0)};
    const std::array<std::uint32_t, 12> corners{0, 2, 3, 1, 2, 3, 3, 3, 5, 3, 4, 5};
    RasterView view;
    view.size = {16, 16};
    view.toClip = perspective(1.0f);
    TriangleRaster raster;
    raster.draw(std::array{meshOf(positions, corners)}, view);
    EXPECT_THAT(std::vector(raster.triangles().begin(), raster.triangles().end()),
                Each(testing::AnyOf(0u, 4u))); // only the one that is merely huge
    EXPECT_GT(std::ranges::count(raster.triangles(), 4u), 0);
}

} // namespace
} // namespace celadon
