// The shape that is shown, made on another thread: always that of the moment that is asked for.
#include "tests/ui/ball_world.h"
#include "ui/shown_shape.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

namespace celadon::ui {
namespace {

class ShownShapeTest : public testing::Test {
protected:
    ShownShapeTest() : session({test::readBall, {}, false}), shapes(session) {}
    void open() { session.execute({"file.open", {{"model", "ball"}}}); }
    void inflate(double amount) {
        session.execute({"deform.change", {{"deformer", 0}, {"amount", amount}}});
    }
    /// Half the shape's width along x, where a ray from outside meets it.
    double reach() {
        const ShownShape* const shape = shapes.current();
        const auto hit = shape->rays->nearest({100.0, 0.0, 0.0}, {-1.0, 0.0, 0.0});
        return hit ? 100.0 - hit->distanceMm : 0.0;
    }

    Session session;
    ShownShapes shapes;
};

TEST_F(ShownShapeTest, IsNoneWithoutAModel) {
    EXPECT_EQ(shapes.current(), nullptr);
    EXPECT_FALSE(shapes.isCurrent());
    EXPECT_EQ(shapes.latest(), nullptr);
    EXPECT_FALSE(shapes.takeArrived());
}

TEST_F(ShownShapeTest, FollowsWhatMovesIt) {
    open();
    const double atRest = reach();
    EXPECT_NEAR(atRest, 20.0, 0.1);
    EXPECT_EQ(shapes.current()->world, session.sharedWorld());
    session.execute({"deform.add", {{"type", "inflate"}}});
    for (const double amount : {1.0, 5.0, 3.0}) {
        inflate(amount); // mm
        EXPECT_NEAR(reach(), atRest + amount, 0.02);
        EXPECT_NE(shapes.current()->world, session.sharedWorld());
        EXPECT_EQ(shapes.current()->rest, session.sharedWorld());
    }
    session.execute({"edit.undo"});
    EXPECT_NEAR(reach(), atRest + 5.0, 0.02);
}

/// However often it changes while one is being made, the one that is called current is of now.
TEST_F(ShownShapeTest, NeverCallsAnotherMomentCurrent) {
    open();
    const double atRest = reach();
    session.execute({"deform.add", {{"type", "inflate"}}});
    int times = 0;
    for (int i = 1; i <= 40; ++i) {
        inflate(0.1 * i);
        if (i % 8 == 0) { // now it is given time
            EXPECT_NE(shapes.current(), nullptr);
        }
        if (shapes.isCurrent()) {
            ++times;
            EXPECT_NEAR(reach(), atRest + 0.1 * i, 0.01);
        }
    }
    EXPECT_NEAR(reach(), atRest + 4.0, 0.01);
    EXPECT_TRUE(shapes.takeArrived());
    EXPECT_FALSE(shapes.takeArrived());
    EXPECT_GE(times, 5);
}

TEST_F(ShownShapeTest, IsOfTheModelThatIsOpen) {
    open();
    const auto first = session.sharedWorld();
    ASSERT_EQ(shapes.current()->rest, first);
    open(); // while nothing is asked of it
    EXPECT_NE(session.sharedWorld(), first);
    EXPECT_EQ(shapes.current()->rest, session.sharedWorld());
}

} // namespace
} // namespace celadon::ui
