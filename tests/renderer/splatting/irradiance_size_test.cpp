// How fine a light view is: as asked for, or as R_P needs it.
#include "renderer/frame_quality.h"
#include "renderer/splatting/splatting_solver.h"

#include <gtest/gtest.h>

namespace celadon {
namespace {

constexpr double kObjectMm = 100.0;

TEST(IrradianceSize, ShortRangesGetAFinerLightView) {
    const SplattingSettings settings = frameSettings(Quality::Default).splatting;
    EXPECT_EQ(refinedIrradianceSize(settings, 10.0, kObjectMm), 512);
    EXPECT_EQ(refinedIrradianceSize(settings, 3.0, kObjectMm), 512);
    EXPECT_EQ(refinedIrradianceSize(settings, 2.5, kObjectMm), 1024);
    EXPECT_EQ(refinedIrradianceSize(settings, 1.0, kObjectMm), 1024);
    EXPECT_EQ(refinedIrradianceSize(settings, 0.5, kObjectMm), 2048);
    // What counts is the range against the object, not its millimeters.
    EXPECT_EQ(refinedIrradianceSize(settings, 10.0, 10.0 * kObjectMm), 1024);
    EXPECT_EQ(refinedIrradianceSize(settings, 0.3, 0.1 * kObjectMm), 512);
}

TEST(IrradianceSize, WhatIsAskedForOrQuickStays) {
    SplattingSettings settings = frameSettings(Quality::Draft).splatting;
    EXPECT_EQ(refinedIrradianceSize(settings, 0.5, kObjectMm), 256);
    settings = frameSettings(Quality::Default).splatting;
    settings.irradianceSize = 300;
    settings.refineShortRanges = false; // as --irradiance-size does
    EXPECT_EQ(refinedIrradianceSize(settings, 0.5, kObjectMm), 300);
}

} // namespace
} // namespace celadon
