#include "app/frame_pattern.h"
#include "subedit/errors.h"

#include <gtest/gtest.h>

namespace celadon::app {
namespace {

TEST(FramePattern, PadsNumbers) {
    const FramePattern pattern("--output", "out/f_%04d.png");
    EXPECT_EQ(pattern.name(7), "out/f_0007.png");
    EXPECT_EQ(pattern.name(0), "out/f_0000.png");
    EXPECT_EQ(pattern.name(123456), "out/f_123456.png");
    EXPECT_EQ(FramePattern("--output", "%d").name(12), "12");
    EXPECT_EQ(FramePattern("--output", "{}%02d{0}").name(3), "{}03{0}");
}

TEST(FramePattern, RefusesWhatPrintfWouldDoWithIt) {
    for (const char* text : {"a.png", "%s.png", "%n%04d", "%04d_%04d.png", "%04d%%.png", "%", "%*d",
                             "%99d", "%0999999999d", "%04ld", "%-4d", "%4d", "%00d", "%0d"}) {
        EXPECT_THROW(static_cast<void>(FramePattern("--output", text)), UsageError) << text;
    }
}

TEST(FramePattern, TellsWhetherThereIsAField) {
    EXPECT_TRUE(hasFrameField("a%04d.png"));
    EXPECT_TRUE(hasFrameField("100%_%d"));
    EXPECT_FALSE(hasFrameField("100%.png"));
    EXPECT_FALSE(hasFrameField("a.png"));
    EXPECT_FALSE(hasFrameField("%"));
}

} // namespace
} // namespace celadon::app
