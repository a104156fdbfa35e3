#include "app/progress.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace celadon::app {
namespace {

using test::readText;
using test::TemporaryFolder;

TEST(Progress, TellsWhatIsDoneAndLeft) {
    EXPECT_EQ(progressText("frames", 0, 10, 0.0), "frames 0/10");
    EXPECT_EQ(progressText("frames", 5, 10, 6.0), "frames 5/10, 6 s left");
    EXPECT_EQ(progressText("frames", 1, 10, 60.0), "frames 1/10, 9 min left");
    EXPECT_EQ(progressText("frames", 9, 10, 0.9), "frames 9/10");
    EXPECT_EQ(progressText("frames", 10, 10, 6.0), "frames 10/10");
    EXPECT_EQ(progressText("rays", 12, 0, 6.0), "rays 12");
}

std::string drawn(bool isTerminal) {
    const TemporaryFolder folder;
    const std::string file = (folder / "stream").string();
    std::FILE* stream = std::fopen(file.c_str(), "w");
    {
        Progress progress("frames", 3, stream, isTerminal);
        progress.update(1);
        progress.update(2); // too soon to be redrawn
    }
    std::fclose(stream);
    return readText(file);
}

TEST(Progress, IsSilentWhereThereIsNoTerminal) {
    EXPECT_EQ(drawn(false), "");
}

TEST(Progress, WipesItsLineInTheEnd) {
    const std::string text = drawn(true);
    EXPECT_THAT(text, testing::HasSubstr("frames 1/3"));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("frames 2/3")));
    EXPECT_THAT(text, testing::EndsWith("\r\x1b[K"));
}

} // namespace
} // namespace celadon::app
