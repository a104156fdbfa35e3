// Which pressure belongs to which event of the cursor.
#include "ui/pen_track.h"

#include <gtest/gtest.h>

namespace celadon::ui {
namespace {

using Kind = InputEvent::Kind;

InputEvent matched(PenTrack& track, Kind kind, double x, double y) {
    InputEvent event{kind, {x, y}};
    track.match(event);
    return event;
}

TEST(PenTrack, MouseHasFullPressure) {
    PenTrack track;
    EXPECT_EQ(matched(track, Kind::Move, 3, 4).pressure, 1.0f);
    EXPECT_EQ(matched(track, Kind::Press, 3, 4).pressure, 1.0f);
    EXPECT_FALSE(matched(track, Kind::Release, 3, 4).isEraser);
}

TEST(PenTrack, EventsGetWhatThePenHadThere) {
    PenTrack track;
    track.add({{10.5, 20.2}, 0.0f});
    track.add({{11.5, 20.9}, 0.25f});
    track.add({{12.1, 21.0}, 0.5f});
    EXPECT_EQ(matched(track, Kind::Move, 10, 20).pressure, 0.0f);
    EXPECT_EQ(matched(track, Kind::Move, 11, 20).pressure, 0.25f);
    EXPECT_EQ(matched(track, Kind::Move, 12, 21).pressure, 0.5f);
    EXPECT_EQ(matched(track, Kind::Release, 12, 21).pressure, 0.5f);
}

TEST(PenTrack, PressHasThePressureThatGrewInPlace) {
    PenTrack track;
    track.add({{10.5, 20.5}, 0.0f}); // hovers
    track.add({{10.5, 20.5}, 0.1f}); // touches: no event of the cursor
    EXPECT_EQ(matched(track, Kind::Move, 10, 20).pressure, 0.1f);
    EXPECT_EQ(matched(track, Kind::Press, 10, 20).pressure, 0.1f);
    track.add({{10.5, 20.5}, 0.7f});
    EXPECT_EQ(matched(track, Kind::Release, 10, 20).pressure, 0.7f);
}

TEST(PenTrack, EventsThatTheWindowLeftOutArePassedOver) {
    PenTrack track;
    for (int i = 0; i < 8; ++i) {
        track.add({{i + 0.5, 0.5}, 0.1f * static_cast<float>(i)});
    }
    EXPECT_FLOAT_EQ(matched(track, Kind::Move, 6, 0).pressure, 0.6f);
    // What came before is forgotten: that place is a mouse's now.
    EXPECT_EQ(matched(track, Kind::Move, 2, 0).pressure, 1.0f);
    EXPECT_FLOAT_EQ(matched(track, Kind::Move, 7, 0).pressure, 0.7f);
}

TEST(PenTrack, MouseClicksWhereAPenHovers) {
    PenTrack track;
    track.add({{5.5, 5.5}, 0.0f});
    EXPECT_EQ(matched(track, Kind::Move, 5, 5).pressure, 0.0f);
    EXPECT_EQ(matched(track, Kind::Press, 5, 5).pressure, 1.0f);
    EXPECT_EQ(matched(track, Kind::Move, 9, 9).pressure, 1.0f);
}

TEST(PenTrack, EraserIsTold) {
    PenTrack track;
    track.add({{5.5, 5.5}, 0.3f, true});
    track.add({{6.5, 5.5}, 0.3f, false});
    EXPECT_TRUE(matched(track, Kind::Press, 5, 5).isEraser);
    EXPECT_FALSE(matched(track, Kind::Move, 6, 5).isEraser);
}

TEST(PenTrack, KeysAndWheelHaveNone) {
    PenTrack track;
    track.add({{5.5, 5.5}, 0.3f});
    EXPECT_EQ(matched(track, Kind::Key, 5, 5).pressure, 1.0f);
    EXPECT_EQ(matched(track, Kind::Wheel, 5, 5).pressure, 1.0f);
    EXPECT_FLOAT_EQ(matched(track, Kind::Move, 5, 5).pressure, 0.3f);
}

TEST(PenTrack, ReportsThatNobodyAsksForAreBounded) {
    PenTrack track;
    for (int i = 0; i < 100000; ++i) {
        track.add({{i + 0.5, 0.5}, 0.5f});
    }
    EXPECT_EQ(matched(track, Kind::Move, 10, 0).pressure, 1.0f);
    EXPECT_EQ(matched(track, Kind::Move, 99999, 0).pressure, 0.5f);
}

} // namespace
} // namespace celadon::ui
