#include "subedit/map/material_convert.h"
#include "subedit/radius_map.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace celadon::subedit {
namespace {

double meanAlbedo(const MaterialMap& map) {
    double sum = 0.0;
    const std::vector<float> albedo = albedoMap(map);
    for (const float value : albedo) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(albedo.size());
}

TEST(MaterialConvert, NothingAskedNothingChanged) {
    const MaterialMap map = test::varyingMaterial(6, 4, 12);
    EXPECT_EQ(convertMaterial(map, {}).logProfile, map.logProfile);
    EXPECT_EQ(convertMaterial(map, {6, 4, 12, 20.0}).logProfile, map.logProfile);
}

TEST(MaterialConvert, SmallerMapsKeepTheMeanAlbedo) {
    const MaterialMap map = test::varyingMaterial(30, 21, 16);
    for (const int size : {1, 4, 10}) {
        const MaterialMap out = convertMaterial(map, {size, size, 0, 0.0});
        EXPECT_EQ(out.width, size);
        EXPECT_NEAR(meanAlbedo(out) / meanAlbedo(map), 1.0, 1e-4) << size;
    }
}

TEST(MaterialConvert, LargerMapsInterpolateAsRenderingDoes) {
    const MaterialMap map = test::varyingMaterial(5, 5, 8);
    const MaterialMap out = convertMaterial(map, {15, 15, 0, 0.0});
    // The center texel of each block of three is a texel of the smaller map.
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 5; ++x) {
            for (int k = 0; k <= 8; ++k) {
                EXPECT_NEAR(out.logKnot(3 * x + 1, 3 * y + 1, k).y, map.logKnot(x, y, k).y, 2e-5f);
            }
        }
    }
    EXPECT_NEAR(meanAlbedo(out) / meanAlbedo(map), 1.0, 1e-3);
}

TEST(MaterialConvert, EachProfileKeepsItsAlbedo) {
    const MaterialMap map = test::varyingMaterial(4, 4, 32);
    const std::vector<float> before = albedoMap(map);
    for (const ConvertSettings& settings :
         {ConvertSettings{0, 0, 8, 0.0}, ConvertSettings{0, 0, 64, 0.0},
          ConvertSettings{0, 0, 0, 12.0}, ConvertSettings{0, 0, 24, 35.0}}) {
        const MaterialMap out = convertMaterial(map, settings);
        const std::vector<float> after = albedoMap(out);
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_NEAR(after[i] / before[i], 1.0f, 1e-3f) << settings.segments;
        }
    }
}

TEST(MaterialConvert, ShapeStaysWhereThereIsRoom) {
    // ln P is linear: any number of segments holds it exactly.
    const MaterialMap map = test::exponentialMaterial(16, 20.0f, {1.5f, 1.0f, 0.8f});
    const MaterialMap out = convertMaterial(map, {0, 0, 10, 0.0});
    for (int k = 0; k <= 10; ++k) {
        EXPECT_NEAR(out.logKnot(0, 0, k).x, std::log(0.01f) - 2.0f * static_cast<float>(k) / 1.5f,
                    2e-3f);
    }
}

TEST(MaterialConvert, PlanesAreResizedAsWell) {
    MaterialMap map = test::varyingMaterial(4, 2, 4);
    map.roughness = {0, 0, 1, 1, 0, 0, 1, 1};
    const MaterialMap out = convertMaterial(map, {2, 1, 0, 0.0});
    EXPECT_EQ(out.roughness, (std::vector<float>{0.0f, 1.0f}));
    EXPECT_TRUE(out.specular.empty());
}

} // namespace
} // namespace celadon::subedit
