#include "ui/quality_ladder.h"

#include <gtest/gtest.h>

namespace celadon::ui {
namespace {

constexpr glm::ivec2 kSize{960, 670};

/// A machine on which a rung takes `msPerMegapixel` and its light view as much again.
double machineMs(const Rung& rung, double speed) {
    const double pixels = kSize.x * kSize.y / 1e6 / (rung.divisor * rung.divisor);
    const double light = frameSettings(rung.quality).splatting.irradianceSize / 512.0;
    return speed * (pixels + light * light) + 2.0;
}

/// The rung that is used after a while of movement.
int settledMovingRung(QualityLadder& ladder, double speed) {
    int rung = 0;
    for (int frame = 0; frame < 60; ++frame) {
        rung = ladder.movingRung(kSize);
        ladder.measured(rung, kSize,
                        machineMs(ladder.rungs()[static_cast<std::size_t>(rung)], speed));
    }
    return rung;
}

TEST(QualityLadder, FastMachinesMoveFinerAndAllHoldTheBudget) {
    int last = 100;
    for (const double speed : {5.0, 50.0, 400.0, 1500.0}) {
        QualityLadder ladder(100.0);
        const int rung = settledMovingRung(ladder, speed);
        EXPECT_LE(rung, last) << speed;
        last = rung;
        if (rung > 0) {
            EXPECT_LE(machineMs(ladder.rungs()[static_cast<std::size_t>(rung)], speed), 130.0);
        }
    }
    QualityLadder fast(100.0);
    EXPECT_GE(settledMovingRung(fast, 5.0), 6);
}

TEST(QualityLadder, RestReachesTheLastRungAndEnds) {
    for (const double speed : {1.0, 300.0, 5000.0}) {
        QualityLadder ladder;
        int shown = -1;
        int steps = 0;
        while (const auto next = ladder.nextRung(shown, kSize)) {
            EXPECT_GT(*next, shown);
            shown = *next;
            ladder.measured(shown, kSize,
                            machineMs(ladder.rungs()[static_cast<std::size_t>(shown)], speed));
            ASSERT_LT(++steps, 20);
        }
        EXPECT_EQ(shown, static_cast<int>(ladder.rungs().size()) - 1);
    }
}

// A stroke has ended on a coarse picture: where the default comes within seconds, it comes at once,
// not after others that would only delay it.
TEST(QualityLadder, RestGoesStraightToTheDefaultWhereItIsNear) {
    const auto isDefault = [](const QualityLadder& ladder, std::optional<int> rung) {
        return rung && ladder.rungs()[static_cast<std::size_t>(*rung)].quality == Quality::Default;
    };
    QualityLadder ladder;
    ladder.measuredFirst(7, kSize, 4500.0); // as when a model is opened
    ladder.measured(0, kSize, 50.0);
    ladder.measured(1, kSize, 60.0);
    EXPECT_TRUE(isDefault(ladder, ladder.nextRung(1, kSize)));
    QualityLadder slow;
    slow.measured(7, kSize, 9000.0);
    EXPECT_FALSE(isDefault(slow, slow.nextRung(1, kSize)));
}

TEST(QualityLadder, RungsGrowFiner) {
    const QualityLadder ladder;
    for (std::size_t i = 1; i < ladder.rungs().size(); ++i) {
        EXPECT_GT(ladder.expectedMs(static_cast<int>(i), kSize),
                  ladder.expectedMs(static_cast<int>(i) - 1, kSize));
    }
    EXPECT_EQ(ladder.rungs().back().divisor, 1);
    EXPECT_EQ(ladder.rungs().back().quality, Quality::Final);
}

} // namespace
} // namespace celadon::ui
