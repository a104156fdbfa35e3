#include "renderer/scene/surface_atlas_of_world.h"
#include "subedit/paint/stroke_mask.h"
#include "tests/support/worlds.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace celadon {
namespace {

using subedit::StrokeMask;
using subedit::Surface;

World makePaintedWorld(const std::string& builtin) {
    auto material = std::make_shared<subedit::MaterialMap>();
    material->width = material->height = 1;
    material->segments = 1;
    material->maxRadiusMm = 10.0f;
    material->logProfile.assign(6, -5.0f);
    return test::makeWorld("builtin:" + builtin, material);
}

subedit::SurfaceAtlas atlasOf(const World& world, int size) {
    return makeSurfaceAtlas(world, 0, size, size);
}

TEST(SurfaceAtlas, TexelsOfASphereLieOnIt) {
    const World world = makePaintedWorld("sphere");
    const auto radius = static_cast<float>(world.scatteringSphere.radius);
    const glm::vec3 center(world.scatteringSphere.center);
    const subedit::SurfaceAtlas atlas = atlasOf(world, 128);
    std::size_t covered = 0;
    for (std::size_t i = 0; i < atlas.chart.size(); ++i) {
        if (atlas.chart[i] < 0) {
            continue;
        }
        ++covered;
        const glm::vec3 out = atlas.positionMm[i] - center;
        EXPECT_NEAR(glm::length(out), radius, 0.01f * radius); // facets cut the corners
        EXPECT_GT(glm::dot(glm::normalize(out), atlas.normal[i]), 0.99f);
    }
    EXPECT_GT(covered, atlas.chart.size() / 2);
    EXPECT_EQ(atlas.overlaps, 0u);
}

/// A dab must not show where charts end: all surface within its hard core is painted, wherever it
/// lies on the map.
TEST(SurfaceAtlas, DabsOnBuiltinsCrossSeams) {
    for (const char* name : {"sphere", "slab", "vase"}) {
        const World world = makePaintedWorld(name);
        const Surface surface(atlasOf(world, 256));
        const auto texels = surface.coveredTexels();
        const float radius = 6.0f * surface.texelSizeMm();
        for (std::size_t i = 0; i < texels.size(); i += texels.size() / 40) {
            const glm::vec3& center = surface.positionMm(texels[i]);
            const glm::vec3& normal = surface.normal(texels[i]);
            StrokeMask mask(surface, {.radiusMm = radius, .hardness = 0.9f});
            mask.add({.positionMm = center, .normal = normal});
            surface.forEachWithin(center, 0.8f * radius, [&](Surface::Texel texel) {
                // Nearly the same plane, or it may be another part of the surface.
                const glm::vec3 d = surface.positionMm(texel) - center;
                if (glm::dot(surface.normal(texel), normal) > 0.9f &&
                    std::abs(glm::dot(d, normal)) < 0.3f * radius) {
                    EXPECT_GT(mask.weight(texel), 0.9f) << name << ", dab " << i;
                }
            });
        }
    }
}

TEST(SurfaceAtlas, TakesOnlyTheMeshesThatWearTheMaterial) {
    World world = makePaintedWorld("sphere");
    world.meshes.front().scattering = -1;
    const subedit::SurfaceAtlas atlas = atlasOf(world, 16);
    for (const std::int32_t chart : atlas.chart) {
        EXPECT_EQ(chart, -1);
    }
}

TEST(SurfaceAtlas, RepeatsCoordinatesOutsideTheUnitSquareAndCountsOverlaps) {
    World world = makePaintedWorld("slab");
    const std::size_t covered = Surface(atlasOf(world, 64)).coveredTexels().size();
    for (glm::vec2& uv : world.meshes.front().mesh.uvs) {
        uv += glm::vec2(3.0f, -2.0f);
    }
    EXPECT_EQ(Surface(atlasOf(world, 64)).coveredTexels().size(), covered);
    World twice = world;
    twice.meshes.push_back(world.meshes.front());
    for (glm::vec3& position : twice.meshes.back().mesh.positions) {
        position.x += 500.0f;
    }
    EXPECT_GE(atlasOf(twice, 64).overlaps, covered);
}

} // namespace
} // namespace celadon
