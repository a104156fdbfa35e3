#include "ui/file_names.h"

#include <gtest/gtest.h>

#include <vector>

namespace celadon::ui {
namespace {

const std::vector<std::string> kMaterial{".subedit.exr"};
const std::vector<std::string> kPicture{".png", ".jpg"};

TEST(FileNames, GetTheFirstSuffixWhereTheyHaveNone) {
    EXPECT_EQ(completedName("skin", kMaterial), "skin.subedit.exr");
    EXPECT_EQ(completedName("skin.v2", kMaterial), "skin.v2.subedit.exr");
    EXPECT_EQ(completedName("/a.b/turn", kPicture), "/a.b/turn.png");
}

TEST(FileNames, KeepASuffixThatFits) {
    EXPECT_EQ(completedName("skin.subedit.exr", kMaterial), "skin.subedit.exr");
    EXPECT_EQ(completedName("turn.jpg", kPicture), "turn.jpg");
    EXPECT_EQ(completedName("TURN.JPG", kPicture), "TURN.JPG");
    EXPECT_EQ(completedName("anything.obj", {}), "anything.obj");
}

TEST(FileNames, DoNotHaveASuffixTwice) {
    EXPECT_EQ(completedName("skin.exr", kMaterial), "skin.subedit.exr");
    EXPECT_EQ(completedName("skin.EXR", kMaterial), "skin.subedit.exr");
}

TEST(FileNames, OfOtherKindsAreRefused) {
    EXPECT_FALSE(completedName("picture.exr", kPicture));
    EXPECT_FALSE(completedName("model.glb", kMaterial));
}

} // namespace
} // namespace celadon::ui
