// Gathering what an edit changed gives what gathering all again gives.
#include "renderer/gather/tile_gather.h"
#include "tests/renderer/gather/light_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace celadon {
namespace {

/// Pixels over a part of the sheet at the border of what is edited: tiles as small as balls grow.
struct View {
    static constexpr int kSide = 48;
    std::vector<float> positions, surfaces;

    View() {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const float px = 8.0f + 6.0f * (static_cast<float>(x) + 0.5f) / kSide;
                const float py = 8.0f + 6.0f * (static_cast<float>(y) + 0.5f) / kSide;
                positions.insert(positions.end(), {px, py, test::sheetHeight(px), 60.0f});
                surfaces.insert(surfaces.end(),
                                {0.025f * px, 0.025f * py, static_cast<float>(x / 8 % 2), 3.0f});
            }
        }
    }
    [[nodiscard]] ViewTexels texels(std::vector<float>& exitance) const {
        exitance.resize(positions.size());
        return {{kSide, kSide}, positions.data(), surfaces.data(), exitance.data()};
    }
};

TEST(TileGather, WhatAnEditChangedIsWhatGatheringAllAgainFinds) {
    const View view;
    // So that what is painted makes nodes need a ball that needed none, and the other way around.
    for (const auto& [fineSpread, times] : {std::pair{0.06f, 1.3f},
                                            {0.3f, 2.0f},
                                            {0.6f, 2.0f},
                                            {0.6f, 0.6f},
                                            {0.9f, 2.0f},
                                            {0.9f, 0.6f}}) {
        SCOPED_TRACE(testing::Message() << fineSpread << " " << times);
        test::Materials materials = test::twoMaterials();
        const GatherMaterials gatherMaterials = test::gathered(materials);
        const test::LightSheet light;
        TreeSettings treeSettings;
        treeSettings.fineSpread = fineSpread;
        SampleTree before;
        SampleTree after;
        before.build(light.texels(), gatherMaterials, treeSettings);
        const TexelChange change{1, {4, 5, 9, 8}};
        std::vector<float> expected, got;
        const PixelTiles tiles(view.texels(expected), 2); // a block for each tile
        GatherSettings settings;
        settings.pixelOffset = 0.25f;
        constexpr int kLevels = 3;
        for (int level = 0; level < kLevels; ++level) {
            gatherLevel(before, gatherMaterials, view.texels(got), tiles, level, kLevels, settings);
            const std::vector<float> old = got;
            // Painted: steeper profiles, and their radii.
            const test::Materials unpainted = test::twoMaterials();
            test::edit(*materials[1], change.rect, times);
            const ChangedTexels changed(gatherMaterials, std::vector<TexelChange>{change});
            after.build(light.texels(), gatherMaterials, treeSettings);
            const TreeChange difference(before, after);
            ASSERT_FALSE(difference.isEverything());
            const GatherChange since{difference, changed};
            gatherLevel(after, gatherMaterials, view.texels(got), tiles, level, kLevels, settings,
                        &since);
            gatherLevel(after, gatherMaterials, view.texels(expected), tiles, level, kLevels,
                        settings);
            materials[1]->logProfile = unpainted[1]->logProfile;
            const float brightest = *std::ranges::max_element(expected);
            float worst = 0.0f;
            float moved = 0.0f;
            for (std::size_t i = 0; i < got.size(); ++i) {
                if (i % 4 != 3) { // which counts pairs
                    worst = std::max(worst, std::abs(got[i] - expected[i]));
                    moved = std::max(moved, std::abs(old[i] - expected[i]));
                }
            }
            EXPECT_LT(worst, 2e-5f * brightest) << "level " << level;
            EXPECT_GT(moved, 1e-4f * brightest) << "level " << level;
        }
    }
}

} // namespace
} // namespace celadon
