#include "app/argument.h"
#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <clocale>

namespace celadon::app {
namespace {

using test::messageOf;
using testing::AllOf;
using testing::HasSubstr;

TEST(ParseNumber, TakesWhatPeopleWrite) {
    EXPECT_EQ(parseNumber({"--x", "1.5"}), 1.5);
    EXPECT_EQ(parseNumber({"--x", "-2"}), -2.0);
    EXPECT_EQ(parseNumber({"--x", "+3e-2"}), 0.03);
}

TEST(ParseNumber, RefusesWhatIsNoFiniteNumber) {
    for (const char* text : {"", " 1", "1 ", "1,5", "abc", "nan", "inf", "-inf", "1e999", "0x10",
                             "+-1", "+", "--3", "1.5mm"}) {
        EXPECT_THROW(static_cast<void>(parseNumber({"--x", text})), UsageError) << text;
    }
}

TEST(ParseNumber, NamesOptionValueAndRange) {
    const std::string message = messageOf<UsageError>([] {
        static_cast<void>(parseNumber({"--energy", "1.5"}, {0.0, 1.0, true}));
    });
    EXPECT_THAT(message, AllOf(HasSubstr("--energy"), HasSubstr("'1.5'"),
                               HasSubstr("above 0 and at most 1")));
    EXPECT_THROW(static_cast<void>(parseNumber({"--x", "0"}, kPositive)), UsageError);
    EXPECT_EQ(parseNumber({"--x", "0"}, kNotNegative), 0.0);
}

TEST(ParseNumber, DoesNotHearTheLocale) {
    const char* german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
    EXPECT_EQ(parseNumber({"--x", "1.5"}), 1.5);
    if (german != nullptr) {
        std::setlocale(LC_NUMERIC, "C");
    }
}

TEST(ParseInteger, KeepsToItsRange) {
    EXPECT_EQ(parseInteger({"--n", "64"}, 1, 64), 64);
    for (const char* text : {"0", "65", "1.0", "99999999999999999999", "", "x"}) {
        EXPECT_THROW(static_cast<void>(parseInteger({"--n", text}, 1, 64)), UsageError) << text;
    }
}

TEST(ParseVector, HasThreeParts) {
    EXPECT_EQ(parseVector({"--view-from", "-1,2.5,0"}), glm::dvec3(-1.0, 2.5, 0.0));
    for (const char* text : {"1,2", "1,2,3,4", "1,,3", "1,2,nan", "", "1;2;3", "1, 2, 3"}) {
        EXPECT_THROW(static_cast<void>(parseVector({"--view-from", text})), UsageError) << text;
    }
}

TEST(ParseSize, BoundsSidesAndArea) {
    EXPECT_EQ(parseSize({"--size", "800x600"}, 16384, 1 << 26), glm::ivec2(800, 600));
    for (const char* text : {"800", "800x", "x600", "0x600", "-1x5", "800x600x3", "16385x1",
                             "16384x16384", "800X600", "99999999999x1"}) {
        EXPECT_THROW(static_cast<void>(parseSize({"--size", text}, 16384, 1 << 26)), UsageError)
            << text;
    }
}

TEST(ParseFrames, CountsUp) {
    EXPECT_EQ(parseFrames({"--frames", "1:24"}).count(), 24);
    EXPECT_EQ(parseFrames({"--frames", "7"}).first, 7);
    EXPECT_EQ(parseFrames({"--frames", "7"}).last, 7);
    for (const char* text : {"5:1", "-1:3", "a:b", "1:2:3", ":", "", "1:99999999999"}) {
        EXPECT_THROW(static_cast<void>(parseFrames({"--frames", text})), UsageError) << text;
    }
}

TEST(ParseLevels, TakesOneNumberOrTwo) {
    EXPECT_EQ(parseLevels({"--levels", "3"}, 12).irradiance, 3);
    EXPECT_EQ(parseLevels({"--levels", "3"}, 12).splatting, 3);
    EXPECT_EQ(parseLevels({"--levels", "6,5"}, 12).irradiance, 6);
    EXPECT_EQ(parseLevels({"--levels", "6,5"}, 12).splatting, 5);
    for (const char* text : {"0", "13", "3,", ",3", "1,2,3", "3,0", "x"}) {
        EXPECT_THROW(static_cast<void>(parseLevels({"--levels", text}, 12)), UsageError) << text;
    }
}

TEST(ParseChoice, ListsTheChoices) {
    constexpr std::array<std::string_view, 2> choices{"paper", "hierarchical"};
    EXPECT_EQ(parseChoice({"--scheme", "hierarchical"}, choices), 1u);
    EXPECT_THAT(messageOf<UsageError>([&] {
                    static_cast<void>(parseChoice({"--scheme", "best"}, choices));
                }),
                AllOf(HasSubstr("--scheme 'best'"), HasSubstr("paper, hierarchical")));
}

TEST(ParseText, NoticesAMissingValue) {
    EXPECT_EQ(parseText({"--stats", "a.json"}), "a.json");
    EXPECT_THROW(static_cast<void>(parseText({"--stats", ""})), UsageError);
    EXPECT_THROW(static_cast<void>(parseText({"--stats", "--aov"})), UsageError);
}

} // namespace
} // namespace celadon::app
