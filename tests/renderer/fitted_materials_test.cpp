#include "renderer/fitted_materials.h"
#include "subedit/map/material_resize.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace celadon {
namespace {

MaterialPointer material(int width, int height) {
    return std::make_shared<subedit::MaterialMap>(subedit::test::varyingMaterial(width, height, 6));
}

/// Room for so many texels in all.
FittedMaterials::HasRoom roomFor(int texels) {
    return [texels](std::span<const glm::ivec3> sizes) {
        int sum = 0;
        for (const glm::ivec3& size : sizes) {
            sum += size.x * size.y;
        }
        return sum <= texels;
    };
}

TEST(FittedMaterials, WhatHasRoomIsTheWorlds) {
    const std::vector<MaterialPointer> all{material(8, 4), material(3, 3)};
    FittedMaterials fitted(all, roomFor(41));
    EXPECT_TRUE(std::ranges::equal(fitted.maps(), all));
    EXPECT_TRUE(fitted.warnings().empty());
    const MaterialChange change = fitted.update(0, *all[0], {2, 1, 3, 2});
    EXPECT_EQ(change.rect, (subedit::TexelRect{2, 1, 3, 2}));
}

TEST(FittedMaterials, TheLargestIsHalvedUntilAllHaveRoom) {
    const std::vector<MaterialPointer> all{material(6, 5), material(16, 8), material(1, 1)};
    const FittedMaterials fitted(all, roomFor(63));
    EXPECT_EQ(fitted.maps()[0], all[0]);
    EXPECT_EQ(fitted.maps()[1]->width, 8);
    EXPECT_EQ(fitted.maps()[1]->height, 4);
    EXPECT_EQ(fitted.maps()[1]->logProfile, subedit::resizeMaterial(*all[1], 8, 4).logProfile);
    EXPECT_EQ(fitted.maps()[2], all[2]);
    ASSERT_EQ(fitted.warnings().size(), 1u);
    EXPECT_NE(fitted.warnings()[0].find("16x8"), std::string::npos) << fitted.warnings()[0];
    EXPECT_NE(fitted.warnings()[0].find("8x4"), std::string::npos) << fitted.warnings()[0];
}

TEST(FittedMaterials, WhereNoSizeHelpsNothingIsChanged) {
    const std::vector<MaterialPointer> all{material(4, 2)};
    const FittedMaterials fitted(all, roomFor(0));
    EXPECT_EQ(fitted.maps()[0], all[0]);
    EXPECT_TRUE(fitted.warnings().empty());
}

TEST(FittedMaterials, EditsReachTheSmallerMap) {
    for (const glm::ivec2 size : {glm::ivec2(16, 12), glm::ivec2(13, 9)}) { // halves, and odd sizes
        const auto edited = std::make_shared<subedit::MaterialMap>(
            subedit::test::varyingMaterial(size.x, size.y, 6));
        const MaterialPointer map = edited;
        FittedMaterials fitted(std::span(&map, 1), roomFor(80));
        const subedit::MaterialMap before = *fitted.maps()[0];
        ASSERT_LT(before.width, size.x);

        const subedit::TexelRect rect{5, 3, 4, 2};
        for (int y = rect.y; y < rect.bottom(); ++y) {
            for (int x = rect.x; x < rect.right(); ++x) {
                for (int i = 0; i < 3 * edited->knots(); ++i) {
                    edited->logProfile[edited->index(x, y, 0) + static_cast<std::size_t>(i)] -=
                        0.7f;
                }
            }
        }
        const MaterialChange change = fitted.update(0, *edited, rect);

        const subedit::MaterialMap& after = *fitted.maps()[0];
        EXPECT_EQ(after.logProfile,
                  subedit::resizeMaterial(*edited, after.width, after.height).logProfile);
        float largest = subedit::kLogProfileFloor;
        for (int y = 0; y < after.height; ++y) {
            for (int x = 0; x < after.width; ++x) {
                const bool isInside = x >= change.rect.x && x < change.rect.right() &&
                                      y >= change.rect.y && y < change.rect.bottom();
                if (isInside) {
                    largest = std::max(largest, after.logKnot(x, y, 0).x);
                } else {
                    EXPECT_EQ(after.logKnot(x, y, 2), before.logKnot(x, y, 2)) << x << ", " << y;
                }
            }
        }
        EXPECT_GE(change.largestLogP, largest);
        EXPECT_LT(change.rect.texels(), 16u); // what the rectangle touches, not the map
    }
}

} // namespace
} // namespace celadon
