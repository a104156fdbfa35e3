#include "ui/length_text.h"

#include <gtest/gtest.h>

namespace celadon::ui {
namespace {

TEST(LengthText, IsReadAsItIsTyped) {
    EXPECT_EQ(parseLengthMm("40"), 40.0);
    EXPECT_EQ(parseLengthMm(" 113.6 mm "), 113.6);
    EXPECT_EQ(parseLengthMm("0,5"), 0.5);
    EXPECT_EQ(parseLengthMm("3cm"), 30.0);
    EXPECT_EQ(parseLengthMm("1.25 m"), 1250.0);
    EXPECT_EQ(parseLengthMm("2 in"), 50.8);
    EXPECT_EQ(parseLengthMm("1e3"), 1000.0);
}

TEST(LengthText, WhatIsNoLengthIsNone) {
    for (const char* const text : {"", " ", "abc", "2*5", "1.000,5", "-5", "0", "nan", "inf",
                                   "5 km", "5 mm 3", "1,2,3", "mm"}) {
        EXPECT_FALSE(parseLengthMm(text)) << text;
    }
}

TEST(LengthText, ReadsBack) {
    EXPECT_EQ(lengthText(100.0000076), "100 mm");
    EXPECT_EQ(parseLengthMm(lengthText(113.576)), 113.576);
}

} // namespace
} // namespace celadon::ui
