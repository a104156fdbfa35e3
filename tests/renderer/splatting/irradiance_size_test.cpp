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

TEST(IrradianceSize, DraftsRefineWhatWouldShowAsALatticeOnly) {
    const SplattingSettings draft = frameSettings(Quality::Draft).splatting;
    EXPECT_EQ(refinedIrradianceSize(draft, 2.0, kObjectMm), 256);
    EXPECT_EQ(refinedIrradianceSize(draft, 0.5, kObjectMm), 1024);
    const SplattingSettings sketch = frameSettings(Quality::Sketch).splatting;
    EXPECT_EQ(refinedIrradianceSize(sketch, 2.0, kObjectMm), 128);
    EXPECT_EQ(refinedIrradianceSize(sketch, 0.5, kObjectMm), 512);
}

TEST(IrradianceSize, PatchesSpreadWhereRangesDoNot) {
    SplattingSettings settings = frameSettings(Quality::Default).splatting;
    settings.irradianceSize = 2048;
    EXPECT_EQ(refinedPatchVariance(settings, 0.2, kObjectMm), 1.0);
    EXPECT_EQ(refinedPatchVariance(settings, 0.05, kObjectMm), 3.0);
    const double between = refinedPatchVariance(settings, 0.14, kObjectMm);
    EXPECT_GT(between, 1.0);
    EXPECT_LT(between, 3.0);
    settings.scheme = Scheme::Paper; // has no patches
    EXPECT_EQ(refinedPatchVariance(settings, 0.05, kObjectMm), 1.0);
}

TEST(IrradianceSize, WhatIsAskedForStays) {
    SplattingSettings settings = frameSettings(Quality::Default).splatting;
    settings.fixIrradianceSize(300); // as --irradiance-size does
    EXPECT_EQ(refinedIrradianceSize(settings, 0.5, kObjectMm), 300);
}

} // namespace
} // namespace celadon
