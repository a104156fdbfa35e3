#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/ball_world.h"
#include "ui/deform_controls.h"
#include "ui/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace celadon::ui {
namespace {

class MotionCommands : public testing::Test {
protected:
    MotionCommands() : session({test::readBall, {}, false}) {
        session.dispatcher().observe(
            [this](const Command& command) { recorded.push_back(command); });
        session.execute({"file.open", {{"model", "ball"}}});
    }

    const AnimatedDeformer& first() const { return session.motion.now.deformers.front(); }
    void at(double seconds) { session.execute({"motion.time", {{"seconds", seconds}}}); }

    Session session;
    std::vector<Command> recorded;
};

TEST_F(MotionCommands, DeformersAreAddedChangedOrderedAndRemoved) {
    session.execute({"deform.add", {{"type", "twist"}}});
    session.execute({"deform.add", {{"type", "inflate"}}});
    const std::uint64_t before = session.pictureRevision();
    session.execute(
        {"deform.change", {{"deformer", 0}, {"amount", 90.0}, {"axis", 2}, {"range", {0.2, 0.7}}}});
    EXPECT_GT(session.pictureRevision(), before);
    EXPECT_EQ(first().amount.number(0.0), 90.0);
    EXPECT_EQ(first().axis, 2);
    EXPECT_EQ(first().range, glm::dvec2(0.2, 0.7));
    session.execute({"deform.order", {{"deformer", 1}, {"to", 0}}});
    EXPECT_EQ(first().kind, Deformer::Kind::Inflate);
    EXPECT_TRUE(session.mover().moves());
    session.execute({"deform.remove", {{"deformer", 0}}});
    session.execute({"deform.remove", {{"deformer", 0}}});
    EXPECT_FALSE(session.mover().moves());
    EXPECT_THROW(session.execute({"deform.remove", {{"deformer", 0}}}), UsageError);
    EXPECT_THROW(session.execute({"deform.add", {{"type", "spin"}}}), UsageError);
}

TEST_F(MotionCommands, ValuesGoIntoTheKeyOfTheMomentWhereThereAreKeys) {
    session.execute({"deform.add", {{"type", "bend"}}});
    const auto amount = [&](double value) {
        session.execute({"deform.change", {{"deformer", 0}, {"amount", value}}});
    };
    amount(10.0);
    session.execute({"deform.key", {{"deformer", 0}, {"control", -1}}});
    at(2.0);
    EXPECT_EQ(first().amount.number(2.0), 10.0);
    amount(50.0);
    EXPECT_EQ(first().amount.times, (std::vector<double>{0.0, 2.0}));
    EXPECT_EQ(first().amount.number(1.0), 30.0);
    EXPECT_EQ(session.mover().durationSeconds(), 2.0);
    session.execute({"deform.interpolation", {{"deformer", 0}, {"control", -1}, {"name", "step"}}});
    EXPECT_EQ(first().amount.number(1.0), 10.0);
    session.execute({"deform.key", {{"deformer", 0}, {"control", -1}, {"on", false}}});
    EXPECT_EQ(first().amount.times, (std::vector<double>{0.0}));
    session.advanceTime(0.25); // nothing beyond zero seconds: it stands still
    EXPECT_EQ(session.motion.now.seconds, 2.0);
}

TEST_F(MotionCommands, ControlPointsAndHandlesFollowTheHandThroughWhatComesAfter) {
    session.execute({"deform.add", {{"type", "lattice"}}});
    session.execute({"deform.change", {{"deformer", 0}, {"size", {2, 3, 4}}}});
    session.execute({"deform.add", {{"type", "bend"}}});
    session.execute({"deform.select", {{"deformer", 0}}});
    ASSERT_EQ(shownControls(session).size(), 24u);
    EXPECT_EQ(controlLines(session).size(), 1u * 3 * 4 + 2u * 2 * 4 + 2u * 3 * 3);
    const auto expectFollows = [&](int index) {
        const glm::dvec3 delta(0.02, -0.01, 0.015); // small: the bend is nearly a line there
        const glm::dvec3 before = shownControls(session)[std::size_t(index)].shownMm;
        session.execute(dragControl(session, index, delta));
        const glm::dvec3 after = shownControls(session)[std::size_t(index)].shownMm;
        EXPECT_LT(glm::length(after - before - delta), 1e-3) << index;
    };
    expectFollows(0);
    expectFollows(23);
    expectFollows(23);
    session.execute({"deform.handle.add", {{"at", {0, 50, 0}}, {"radius", 10}}});
    session.execute({"deform.handle.add", {{"at", {0, -50, 0}}, {"radius", 10}}});
    EXPECT_EQ(session.motion.selected, 2);
    EXPECT_EQ(session.motion.control, 1);
    expectFollows(1);
    session.motion.areControlsShown = false;
    EXPECT_TRUE(shownControls(session).empty());
    EXPECT_THROW(session.execute(
                     {"deform.point", {{"deformer", 0}, {"point", {2, 0, 0}}, {"by", {0, 0, 0}}}}),
                 UsageError);
}

TEST_F(MotionCommands, UndoTakesStepsBackAndRedoRepeatsThem) {
    session.execute({"deform.add", {{"type", "twist"}}});
    const MotionSetting added = session.motion.now;
    const auto amount = [&](double value, bool continues) {
        session.execute(
            {"deform.change", {{"deformer", 0}, {"amount", value}, {"continues", continues}}});
    };
    amount(10.0, false); // a slider in the hand: one step
    amount(20.0, true);
    amount(30.0, true);
    const MotionSetting slid = session.motion.now;
    amount(40.0, false);
    at(0.5); // time is no step
    EXPECT_EQ(session.undoTitle(), "twist");
    session.execute({"edit.undo"});
    EXPECT_EQ(session.motion.now.deformers, slid.deformers);
    EXPECT_EQ(session.motion.now.seconds, 0.5);
    session.execute({"edit.undo"});
    EXPECT_EQ(session.motion.now.deformers, added.deformers);
    session.execute({"edit.redo"});
    EXPECT_EQ(session.motion.now.deformers, slid.deformers);
    EXPECT_EQ(session.mover().deformers(), slid.deformers);
    session.execute({"edit.undo"});
    session.execute({"edit.undo"});
    EXPECT_TRUE(session.motion.now.deformers.empty());
    EXPECT_FALSE(session.undoTitle());
    EXPECT_FALSE(session.areDeformersModified());
    session.execute({"deform.add", {{"type", "bend"}}}); // what was taken back is gone
    EXPECT_FALSE(session.redoTitle());
    EXPECT_TRUE(session.areDeformersModified());
}

TEST(SettingHistory, StandsInOneRowWithWhatWasPainted) {
    SettingHistory history;
    MotionPart now;
    const auto change = [&](double amount, std::size_t edits) {
        const MotionPart before = now;
        now.deformers.assign(1, AnimatedDeformer());
        now.deformers.front().amount = KeyedNumbers::of(amount);
        history.add(before, "twist", edits, false);
    };
    change(1.0, 0);
    change(2.0, 3);                           // after three strokes
    EXPECT_EQ(history.undoTitle(4), nullptr); // painted since: the stroke comes first
    ASSERT_NE(history.undoTitle(3), nullptr);
    const MotionPart before = now;
    now = std::get<MotionPart>(history.undone());
    history.confirmUndo(before);
    EXPECT_EQ(now.deformers.front().amount.number(0.0), 1.0);
    EXPECT_EQ(history.undoTitle(3), nullptr); // the strokes come first
    EXPECT_NE(history.undoTitle(0), nullptr);
    EXPECT_EQ(history.redoTitle(2), nullptr);
    EXPECT_NE(history.redoTitle(3), nullptr);
    EXPECT_EQ(std::get<MotionPart>(history.redone()).deformers, before.deformers);
}

TEST_F(MotionCommands, TimeGoesOnLoopsAndStops) {
    session.execute({"deform.add", {{"type", "bend"}}});
    EXPECT_FALSE(session.advanceTime(1.0)); // no keys: nothing changes over time
    session.execute({"deform.key", {{"deformer", 0}, {"seconds", 0.0}}});
    session.execute({"deform.key", {{"deformer", 0}, {"seconds", 2.0}}});
    session.execute({"motion.playback", {{"speed", 0.5}}});
    EXPECT_TRUE(session.advanceTime(3.0));
    EXPECT_DOUBLE_EQ(session.motion.now.seconds, 1.5);
    EXPECT_TRUE(session.advanceTime(2.0));
    EXPECT_DOUBLE_EQ(session.motion.now.seconds, 0.5);
    session.execute({"motion.playback", {{"loop", false}}});
    EXPECT_FALSE(session.advanceTime(10.0));
    EXPECT_EQ(session.motion.now.seconds, 2.0);
    EXPECT_THROW(session.execute({"motion.playback", {{"speed", 0.0}}}), UsageError);
    EXPECT_THROW(session.execute({"motion.time", {{"seconds", -1.0}}}), UsageError);
}

TEST_F(MotionCommands, AChangeThatCannotBeMadeChangesNothing) {
    session.execute({"deform.handle.add", {{"at", {0, 50, 0}}, {"radius", 10}}});
    const MotionSetting before = session.motion.now;
    // A second handle where the first one holds everything around.
    EXPECT_THROW(session.execute({"deform.handle.add", {{"at", {0, 50, 0}}, {"radius", 1}}}),
                 Error);
    EXPECT_EQ(session.motion.now, before);
    EXPECT_TRUE(session.mover().moves());
}

TEST_F(MotionCommands, ARecordGivesTheSameMotionAgain) {
    session.execute({"deform.add", {{"type", "lattice"}}});
    session.execute({"deform.point", {{"deformer", 0}, {"point", {1, 2, 1}}, {"by", {5, 10, 0}}}});
    session.execute({"deform.key", {{"deformer", 0}, {"control", -1}}});
    at(1.5);
    session.execute({"deform.point", {{"deformer", 0}, {"point", {1, 2, 1}}, {"by", {0, 0, 9}}}});
    session.execute({"motion.play", {{"on", true}}});
    session.advanceTime(0.7);
    session.execute({"motion.play", {{"on", false}, {"seconds", session.motion.now.seconds}}});
    session.execute({"edit.undo"});
    Session other({test::readBall, {}, false});
    for (const Command& command : recorded) {
        other.execute(parseCommand(formatCommand(command)));
    }
    EXPECT_EQ(other.motion.now, session.motion.now);
}

TEST_F(MotionCommands, DeformersAreSavedAndTakenFromAFile) {
    const test::TemporaryFolder folder;
    session.execute({"deform.add", {{"type", "wave"}}});
    session.execute({"deform.add", {{"type", "taper"}}});
    const DeformerStack before = session.motion.now.deformers;
    const std::string file = (folder / "stack.json").string();
    session.execute({"deform.save", {{"file", file}}});
    const auto written = nlohmann::json::parse(test::readText(file));
    session.execute({"deform.remove", {{"deformer", 0}}});
    session.execute({"deform.stack", written});
    EXPECT_EQ(session.motion.now.deformers, before);
    EXPECT_THROW(session.execute({"deform.save", {{"file", (folder / "stack.glb").string()}}}),
                 UsageError);
}

TEST_F(MotionCommands, TheSameModelReadAgainKeepsDeformersAndTime) {
    session.execute({"deform.add", {{"type", "twist"}}});
    at(1.25);
    const Camera camera = session.camera;
    const MotionSetting before = session.motion.now;
    session.execute({"file.open", {{"model", "ball"}}});
    EXPECT_EQ(session.motion.now, before);
    EXPECT_EQ(session.camera.eye, camera.eye);
    session.execute({"file.open", {{"model", "another"}}});
    EXPECT_TRUE(session.motion.now.deformers.empty());
}

/// The ball with a camera and a lamp on one node, which an animation carries along x by 2 units in
/// a second.
World readCarriedCamera(const OpenRequest& request) {
    World world = test::readBall(request);
    auto rig = std::make_shared<Rig>();
    rig->nodes.resize(1);
    rig->parentsFirst = {0};
    rig->cameraNodes = {0};
    rig->lightNodes = {0};
    AnimationChannel channel;
    channel.times = {0.0, 1.0};
    channel.values = {0.0, 0.0, 300.0, 2.0, 0.0, 300.0};
    channel.components = 3;
    rig->animations.push_back({"pass by", {channel}, 1.0});
    world.rig = rig;
    Camera camera;
    camera.eye = {0.0, 0.0, 300.0 * world.millimetersPerUnit};
    camera.at = {};
    world.cameras = {camera};
    Light lamp;
    lamp.kind = Light::Kind::Point;
    lamp.color = glm::dvec3(5.0);
    world.lights = {lamp};
    return world;
}

TEST(AnimatedCamera, IsFollowedAsLongAsNobodyTakesIt) {
    Session session({readCarriedCamera, {}, false});
    session.execute({"file.open", {{"model", "ball"}}});
    const double unit = session.world().millimetersPerUnit;
    const auto at = [&](double seconds) {
        session.execute({"motion.time", {{"seconds", seconds}}});
    };
    at(0.5);
    EXPECT_NEAR(session.camera.eye.x, 1.0 * unit, 1e-9);
    EXPECT_NEAR(session.rig.lights.at(0).light.position.x, 1.0 * unit, 1e-9);
    session.execute({"light.change", {{"light", 0}, {"color", {9, 9, 9}}}});
    session.advanceTime(0.25);
    EXPECT_NEAR(session.camera.eye.x, 1.5 * unit, 1e-9);
    EXPECT_NEAR(session.rig.lights[0].light.position.x, 1.5 * unit, 1e-9);
    EXPECT_EQ(session.rig.lights[0].light.color, glm::dvec3(9.0)) << "its strength is the user's";

    session.execute({"light.move", {{"light", 0}, {"position", {7, 8, 9}}}});
    session.camera.eye.y += 10.0;
    const Camera taken = session.camera;
    at(1.0);
    EXPECT_EQ(session.rig.lights[0].light.position, glm::dvec3(7, 8, 9));
    EXPECT_EQ(session.camera.eye, taken.eye);
    ASSERT_TRUE(session.fileCamera);
    EXPECT_NEAR(session.fileCamera->eye.x, 2.0 * unit, 1e-9) << "where the model's view is by now";
    session.execute({"camera.view", {{"name", "initial"}}});
    at(0.0);
    EXPECT_NEAR(session.camera.eye.x, 0.0, 1e-9) << "followed again";
}

} // namespace
} // namespace celadon::ui
