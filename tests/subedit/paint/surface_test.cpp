#include "subedit/errors.h"
#include "subedit/paint/stroke_mask.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace celadon::subedit {
namespace {

/// A cylinder of radius 10 mm around y, cut open: u goes once around, so that its seam is the left
/// and the right side of the map.
SurfaceAtlas cylinder(int width, int height) {
    SurfaceAtlas atlas{width, height, {}, {}, {}, 0};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float angle =
                6.2831853f * (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
            const glm::vec3 normal(std::cos(angle), 0.0f, std::sin(angle));
            atlas.normal.push_back(normal);
            atlas.positionMm.push_back(normal * 10.0f +
                                       glm::vec3(0.0f, -static_cast<float>(y), 0.0f));
            atlas.chart.push_back(0);
        }
    }
    return atlas;
}

/// Two squares of 20 mm, `gapMm` apart, one facing up and the other `down` or up as well, in the
/// left and right half of the map.
SurfaceAtlas twoSheets(float gapMm, bool isSecondFacingDown) {
    constexpr int kSize = 20;
    SurfaceAtlas atlas{kSize * 2 + 4, kSize, {}, {}, {}, 0};
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < atlas.width; ++x) {
            const bool isSecond = x >= kSize + 4;
            const int column = isSecond ? x - kSize - 4 : x;
            atlas.positionMm.emplace_back(static_cast<float>(column), static_cast<float>(y),
                                          isSecond ? -gapMm : 0.0f);
            atlas.normal.emplace_back(0.0f, 0.0f, isSecond && isSecondFacingDown ? -1.0f : 1.0f);
            atlas.chart.push_back(isSecond ? 1 : (x < kSize ? 0 : -1));
        }
    }
    return atlas;
}

StrokePoint at(const Surface& surface, int x, int y) {
    StrokePoint point;
    const auto texel = static_cast<Surface::Texel>(y * surface.width() + x);
    point.positionMm = surface.positionMm(texel);
    point.normal = surface.normal(texel);
    return point;
}

float weightAt(const StrokeMask& mask, const Surface& surface, int x, int y) {
    return mask.weight(static_cast<Surface::Texel>(y * surface.width() + x));
}

TEST(Surface, RefusesAnAtlasThatCoversNothing) {
    SurfaceAtlas atlas = makeFlatSurface(4, 4, 4.0f);
    std::fill(atlas.chart.begin(), atlas.chart.end(), -1);
    EXPECT_THROW(Surface{atlas}, InputError);
}

TEST(Surface, FindsTheNearestTexelThatFacesTheSameWay) {
    const Surface surface(twoSheets(0.5f, true));
    const auto up = surface.nearest({7.2f, 3.1f, -0.4f}, {0.0f, 0.0f, 1.0f}, 5.0f);
    ASSERT_TRUE(up.has_value());
    EXPECT_EQ(*up, 3u * 44u + 7u);
    const auto down = surface.nearest({7.2f, 3.1f, -0.1f}, {0.0f, 0.0f, -1.0f}, 5.0f);
    ASSERT_TRUE(down.has_value());
    EXPECT_EQ(*down, 3u * 44u + 7u + 24u);
    EXPECT_FALSE(surface.nearest({7.0f, 3.0f, 9.0f}, {0.0f, 0.0f, 1.0f}, 5.0f).has_value());
    EXPECT_TRUE(surface.nearest({1e9f, -1e9f, 0.0f}, glm::vec3(0.0f), 1e10f).has_value());
}

TEST(Surface, GuttersRepeatTheNearestCoveredTexel) {
    const Surface surface(twoSheets(5.0f, false));
    EXPECT_EQ(surface.sourceOf(20), 19u);
    EXPECT_EQ(surface.sourceOf(21), 19u);
    EXPECT_EQ(surface.sourceOf(23), 24u);
    ASSERT_EQ(surface.gutterOf(19).size(), 2u);
    EXPECT_EQ(surface.gutterOf(5).size(), 0u);
}

TEST(StrokeMask, ADabCrossesTheSeamOfACylinderUnseen) {
    const Surface surface(cylinder(64, 40));
    StrokeMask mask(surface, {.radiusMm = 5.0f, .hardness = 0.3f});
    mask.add(at(surface, 0, 20)); // at the left side of the map
    // The same distance to the left and to the right of the dab, one across the seam.
    for (int d = 1; d < 6; ++d) {
        EXPECT_NEAR(weightAt(mask, surface, 64 - d, 20), weightAt(mask, surface, d, 20), 1e-5f);
    }
    EXPECT_GT(weightAt(mask, surface, 63, 20), 0.5f);
    EXPECT_EQ(weightAt(mask, surface, 32, 20), 0.0f); // the far side
}

TEST(StrokeMask, PaintDoesNotGoThroughThinParts) {
    const Surface thin(twoSheets(0.3f, true));
    StrokeMask mask(thin, {.radiusMm = 5.0f});
    mask.add(at(thin, 10, 10));
    EXPECT_EQ(weightAt(mask, thin, 10, 10), 1.0f);
    EXPECT_EQ(weightAt(mask, thin, 34, 10), 0.0f);
}

TEST(StrokeMask, PaintDoesNotJumpToASurfaceBehindThatFacesTheSameWay) {
    const Surface layers(twoSheets(2.0f, false));
    StrokeMask mask(layers, {.radiusMm = 5.0f});
    mask.add(at(layers, 10, 10));
    EXPECT_EQ(weightAt(mask, layers, 10, 10), 1.0f);
    EXPECT_EQ(weightAt(mask, layers, 34, 10), 0.0f);
}

TEST(StrokeMask, ADabIsRoundWithTheFalloffAsked) {
    const Surface surface(makeFlatSurface(64, 64, 64.0f));
    StrokeMask mask(surface, {.radiusMm = 20.0f, .hardness = 0.5f, .flow = 0.8f});
    mask.add(at(surface, 32, 32));
    EXPECT_FLOAT_EQ(weightAt(mask, surface, 40, 32), 0.8f);    // within the hard core
    EXPECT_NEAR(weightAt(mask, surface, 47, 32), 0.4f, 1e-5f); // halfway
    EXPECT_NEAR(weightAt(mask, surface, 32, 17), 0.4f, 1e-5f); // and the same all around
    EXPECT_NEAR(weightAt(mask, surface, 41, 44), 0.4f, 1e-5f); // 9, 12: a distance of 15
    EXPECT_EQ(weightAt(mask, surface, 52, 32), 0.0f);
}

TEST(StrokeMask, DabsAreSpacedAlongThePathHoweverItIsGiven) {
    const Surface surface(makeFlatSurface(96, 32, 96.0f));
    const Brush brush{.radiusMm = 4.0f, .hardness = 0.2f, .flow = 0.3f, .spacing = 0.5f};
    StrokeMask coarse(surface, brush);
    StrokeMask fine(surface, brush);
    StrokePoint point = at(surface, 10, 16);
    coarse.add(point);
    fine.add(point);
    for (int i = 1; i <= 30; ++i) {
        point.positionMm.x += 2.0f;
        fine.add(point);
    }
    coarse.add(point);
    for (int x = 0; x < 96; ++x) {
        EXPECT_NEAR(weightAt(coarse, surface, x, 16), weightAt(fine, surface, x, 16), 1e-4f) << x;
    }
    EXPECT_GT(weightAt(coarse, surface, 40, 16), 0.5f); // dabs add up
}

TEST(StrokeMask, ABrushNarrowerThanATexelPaintsALineWithoutGaps) {
    const Surface surface(makeFlatSurface(40, 40, 40.0f)); // texels of 1 mm
    for (const int down : {0, 11, 28}) {
        StrokeMask mask(surface, {.radiusMm = 0.1f, .hardness = 0.5f});
        StrokePoint first = at(surface, 2, 5);
        StrokePoint last = at(surface, 30, 5 + down);
        for (StrokePoint* const point : {&first, &last}) { // where four texels meet
            point->positionMm += glm::vec3(0.5f, 0.5f, 0.0f);
            mask.add(*point);
        }
        for (int column = 3; column < 29; ++column) {
            float most = 0.0f;
            for (int row = 0; row < 40; ++row) {
                most = std::max(most, weightAt(mask, surface, column, row));
            }
            EXPECT_GT(most, 0.5f) << column << ", down " << down;
        }
    }
}

TEST(StrokeMask, RefusesMoreDabsThanAnyHandMakes) {
    const Surface surface(makeFlatSurface(2000, 2, 2000.0f)); // texels of 1 mm
    StrokeMask mask(surface, {.radiusMm = 0.001f, .spacing = 0.02f});
    mask.add(at(surface, 0, 0));
    EXPECT_THROW(mask.add(at(surface, 1999, 0)), InputError);
}

TEST(StrokeMask, FlowDoesNotGrowWhereBrushesAreNarrow) {
    const Surface surface(makeFlatSurface(40, 40, 40.0f)); // texels of 1 mm
    const auto along = [&](float radiusMm) {
        StrokeMask mask(surface, {.radiusMm = radiusMm, .flow = 0.05f});
        mask.add(at(surface, 2, 5));
        mask.add(at(surface, 30, 5));
        return weightAt(mask, surface, 15, 5);
    };
    EXPECT_GT(along(0.1f), 0.0f);
    EXPECT_EQ(along(0.1f), along(0.6f));
    EXPECT_NEAR(along(0.1f), along(1.0f), 0.1f);
}

TEST(StrokeMask, OpacityBoundsWhatManyDabsReach) {
    const Surface surface(makeFlatSurface(32, 32, 32.0f));
    StrokeMask mask(surface, {.radiusMm = 6.0f, .flow = 0.5f, .opacity = 0.6f});
    for (int i = 0; i < 40; ++i) {
        mask.add(at(surface, 10 + i % 3, 16));
    }
    EXPECT_LE(weightAt(mask, surface, 11, 16), 0.6f);
    EXPECT_GT(weightAt(mask, surface, 11, 16), 0.58f);
}

TEST(StrokeMask, NothingIsPaintedOnTheWayToALiftedPoint) {
    const Surface surface(makeFlatSurface(96, 32, 96.0f));
    StrokeMask mask(surface, {.radiusMm = 4.0f, .opacity = 0.6f});
    mask.add(at(surface, 10, 16));
    StrokePoint lifted = at(surface, 60, 16);
    lifted.isLifted = true;
    mask.add(lifted);
    EXPECT_EQ(weightAt(mask, surface, 35, 16), 0.0f);
    EXPECT_FLOAT_EQ(weightAt(mask, surface, 60, 16), 0.6f);
    mask.add(at(surface, 80, 16)); // from there it goes on
    EXPECT_FLOAT_EQ(weightAt(mask, surface, 70, 16), 0.6f);
    lifted = at(surface, 10, 16);
    lifted.isLifted = true;
    mask.add(lifted); // back where it was: the opacity bounds the whole stroke
    EXPECT_FLOAT_EQ(weightAt(mask, surface, 10, 16), 0.6f);
}

TEST(StrokeMask, MirrorsAcrossPlanes) {
    const Surface surface(makeFlatSurface(64, 64, 64.0f));
    Mirror mirror;
    mirror.axes = {true, true, false};
    mirror.centerMm = {32.0f, -32.0f, 0.0f};
    StrokeMask mask(surface, {.radiusMm = 5.0f}, mirror);
    mask.add(at(surface, 10, 20));
    for (const auto& [x, y] : {std::pair{10, 20}, {53, 20}, {10, 43}, {53, 43}}) {
        EXPECT_EQ(weightAt(mask, surface, x, y), 1.0f);
    }
    EXPECT_EQ(weightAt(mask, surface, 32, 32), 0.0f);
}

TEST(StrokeMask, ReportsEachChangedTexelOnce) {
    const Surface surface(makeFlatSurface(32, 32, 32.0f));
    StrokeMask mask(surface, {.radiusMm = 4.0f, .flow = 0.3f});
    mask.add(at(surface, 16, 16));
    mask.add(at(surface, 18, 16));
    std::vector<Surface::Texel> changed = mask.takeChanged();
    std::sort(changed.begin(), changed.end());
    EXPECT_EQ(std::adjacent_find(changed.begin(), changed.end()), changed.end());
    std::size_t painted = 0;
    for (Surface::Texel t = 0; t < 32 * 32; ++t) {
        painted += mask.weight(t) > 0.0f ? 1 : 0;
    }
    EXPECT_EQ(changed.size(), painted);
    EXPECT_TRUE(mask.takeChanged().empty());
}

} // namespace
} // namespace celadon::subedit
