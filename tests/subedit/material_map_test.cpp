#include "subedit/map/material_map.h"

#include <gtest/gtest.h>

namespace celadon::subedit {
namespace {

MaterialMap twoTexels() {
    MaterialMap map;
    map.width = 2;
    map.height = 1;
    map.segments = 1;
    map.maxRadiusMm = 1.0f;
    map.logProfile = {-1, -2, -3, -4, -5, -6, -3, -4, -5, -8, -9, -10};
    return map;
}

TEST(MaterialMap, ReturnsTheTexelAtItsCenter) {
    const MaterialMap map = twoTexels();
    float out[6];
    map.sampleLogProfile({0.75f, 0.5f}, out);
    EXPECT_FLOAT_EQ(out[0], -3.0f);
    EXPECT_FLOAT_EQ(out[5], -10.0f);
}

TEST(MaterialMap, InterpolatesTheLogarithmAndRepeats) {
    const MaterialMap map = twoTexels();
    float inside[6];
    float wrapped[6];
    map.sampleLogProfile({0.5f, 0.2f}, inside);
    map.sampleLogProfile({1.0f, -3.0f}, wrapped);
    EXPECT_FLOAT_EQ(inside[0], -2.0f);
    EXPECT_FLOAT_EQ(wrapped[3], -6.0f);
}

} // namespace
} // namespace celadon::subedit
