#include "renderer/scene/builtin.h"
#include "subedit/errors.h"
#include "subedit/map/material_convert.h"
#include "subedit/map/material_file.h"
#include "tests/support/temporary_folder.h"
#include "ui/session.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

namespace celadon::ui {
namespace {

/// A ball of one plain profile, 40 mm across.
World readBall(const OpenRequest& request) {
    if (request.model != "ball") {
        throw InputError("'" + request.model + "'", "cannot be opened");
    }
    const NamedProfile plain{"plain", diffusionProfile(glm::vec3(0.6f), glm::vec3(2.0f))};
    auto material = std::make_shared<subedit::MaterialMap>(homogeneousMaterial(plain, 1.3f));
    Scene scene = makeBuiltin("sphere");
    const std::size_t materials = scene.materials.size();
    return buildWorld(std::move(scene), material, std::vector<MaterialPointer>(materials), nullptr,
                      {std::nullopt, 40.0});
}

class SessionTest : public testing::Test {
protected:
    SessionTest() : session({readBall, true}) {
        session.dispatcher().observe(
            [this](const Command& command) { recorded.push_back(command); });
        session.execute({"file.open", {{"model", "ball"}}});
    }

    /// Across the side of the ball that faces +z.
    void paintStroke() {
        subedit::StrokePoint point;
        const glm::vec3 center(session.world().scatteringSphere.center);
        const auto at = [&](float x) {
            const glm::vec3 n = glm::normalize(glm::vec3(x, 0.1f, 1.0f));
            point.positionMm = center + 20.0f * n;
            point.normal = n;
            return point;
        };
        session.beginStroke(0, at(-0.2f), false);
        for (int i = 1; i <= 8; ++i) {
            session.addStrokePoint(at(-0.2f + 0.05f * static_cast<float>(i)));
        }
        session.endStroke();
    }

    const subedit::MaterialMap& map() { return session.activeDocument()->material(); }

    Session session;
    std::vector<Command> recorded;
};

TEST_F(SessionTest, StrokeChangesTexelsNearItAndNoOthers) {
    const std::vector<float> before = map().logProfile;
    session.execute({"brush.change", {{"radius", 3.0}}});
    session.execute({"operator.change", {{"name", "scale-albedo"}}}); // r_s need not grow
    paintStroke();
    const subedit::Surface& surface = session.activeDocument()->surface();
    const std::size_t values = static_cast<std::size_t>(map().knots()) * 3;
    const glm::vec3 center(session.world().scatteringSphere.center);
    std::size_t changed = 0;
    for (const subedit::Surface::Texel texel : surface.coveredTexels()) {
        const bool isChanged =
            std::memcmp(&before[texel * values], &map().logProfile[texel * values],
                        values * sizeof(float)) != 0;
        const glm::vec3 n = glm::normalize(surface.positionMm(texel) - center);
        // The path lies within x/z of +-0.2 at y/z = 0.1; the brush reaches 3 mm of 20.
        const bool isFar = n.z < 0.9f;
        EXPECT_FALSE(isChanged && isFar);
        changed += isChanged ? 1 : 0;
    }
    EXPECT_GT(changed, 100u);
    EXPECT_TRUE(session.isModified());
}

TEST_F(SessionTest, UndoGivesTheBytesBackAndRedoTheStroke) {
    const std::vector<float> before = map().logProfile;
    paintStroke();
    const std::vector<float> painted = map().logProfile;
    EXPECT_NE(before, painted);
    session.execute({"edit.undo"});
    EXPECT_EQ(map().logProfile, before);
    session.execute({"edit.redo"});
    EXPECT_EQ(map().logProfile, painted);
}

TEST_F(SessionTest, ReplayWritesTheSameFileByteForByte) {
    session.execute({"operator.change", {{"name", "tint"}, {"color", {0.9, 0.2, 0.1}}}});
    paintStroke();
    session.execute({"profile.swap"});
    session.execute({"operator.change", {{"name", "profile"}, {"amount", 0.5}}});
    paintStroke();
    session.execute({"edit.undo"});
    session.execute({"edit.redo"});
    session.execute({"select.change", {{"what", "invert"}}});
    session.execute({"edit.fill"});
    const test::TemporaryFolder folder;
    const auto first = (folder / "first.subedit.exr").string();
    session.execute({"file.save", {{"file", first}}});
    EXPECT_FALSE(session.isModified());

    Session other({readBall, true});
    const auto second = (folder / "second.subedit.exr").string();
    for (Command command : recorded) {
        command = parseCommand(formatCommand(command));
        if (command.name == "file.save") {
            command.arguments["file"] = second;
        }
        other.execute(command);
    }
    EXPECT_EQ(other.activeDocument()->material().logProfile, map().logProfile);
    EXPECT_EQ(test::readText(first), test::readText(second));
}

TEST_F(SessionTest, CancelledStrokeLeavesNothing) {
    const std::vector<float> before = map().logProfile;
    const std::size_t commands = recorded.size();
    subedit::StrokePoint point;
    point.positionMm = glm::vec3(session.world().scatteringSphere.center) + glm::vec3(0, 0, 20);
    session.beginStroke(0, point, false);
    EXPECT_THROW(session.execute({"edit.undo"}), UsageError); // not in the middle of a stroke
    session.cancelStroke();
    EXPECT_EQ(map().logProfile, before);
    EXPECT_EQ(recorded.size(), commands);
}

TEST_F(SessionTest, RefusedCommandsChangeNothingAndBecomeNotices) {
    const Camera camera = session.camera;
    const float radius = session.paint.brush.radiusMm;
    for (const Command& command :
         {Command{"brush.change", {{"radius", -1.0}}}, Command{"brush.change", {{"radius", "a"}}},
          Command{"camera.zoom", {{"factor", 0.0}, {"point", {0, 0, 0}}}},
          Command{"camera.place", {{"eye", {0, 0, 0}}, {"at", {0, 0, 0}}}},
          Command{"light.change", {{"light", 99}}}, Command{"file.open", {{"model", "absent"}}},
          Command{"paint.edit", {{"material", 0}, {"edit", {{"op", "nonsense"}}}}},
          Command{"file.save", {{"file", "/nowhere/at/all.subedit.exr"}}},
          Command{"no.such.command"}}) {
        session.notices.clear();
        EXPECT_FALSE(session.perform(command)) << command.name;
        EXPECT_EQ(session.notices.size(), 1u) << command.name;
    }
    EXPECT_EQ(session.camera.eye, camera.eye);
    EXPECT_EQ(session.paint.brush.radiusMm, radius);
    EXPECT_EQ(session.opened().model, "ball");
    EXPECT_FALSE(session.isModified());
}

TEST_F(SessionTest, ProfileKeepsItsRangeWhenItsAlbedoChanges) {
    const auto before = subedit::effectiveRadiusMm(session.paint.primary.profile.view());
    session.execute({"profile.change", {{"albedo", {0.2, 0.3, 0.4}}}});
    const subedit::ProfileView view = session.paint.primary.profile.view();
    const glm::dvec3 albedo = subedit::diffuseAlbedo(view);
    const glm::dvec3 radius = subedit::effectiveRadiusMm(view);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(albedo[c], 0.2 + 0.1 * c, 1e-4);
        EXPECT_NEAR(radius[c], before[c], 1e-3 * before[c]);
    }
    // A knot that would send back more light than came in is held at albedo 1.
    session.execute({"profile.knot", {{"channel", 0}, {"knot", 3}, {"log", 5.0}}});
    EXPECT_LE(subedit::diffuseAlbedo(session.paint.primary.profile.view()).r, 1.0);
}

TEST_F(SessionTest, EveryCommandHasASummary) {
    for (const auto& [name, entry] : session.dispatcher().entries()) {
        EXPECT_FALSE(entry.summary.empty()) << name;
        EXPECT_NE(name.find('.'), std::string::npos) << name;
    }
}

TEST(OpenedScene, EnlargingKeepsTheMaterialAtTheCentersOfItsTexels) {
    subedit::MaterialMap map;
    map.width = 2;
    map.height = 2;
    map.segments = 1;
    map.maxRadiusMm = 3.0f;
    for (int i = 0; i < 4 * 2 * 3; ++i) {
        map.logProfile.push_back(-static_cast<float>(i));
    }
    const subedit::MaterialMap large = // centers coincide at odd factors
        subedit::convertMaterial(map, {.width = 6, .height = 6});
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            for (int k = 0; k < 2; ++k) {
                const glm::vec3 expected = map.logKnot(x, y, k);
                const glm::vec3 found = large.logKnot(3 * x + 1, 3 * y + 1, k);
                EXPECT_NEAR(glm::distance(expected, found), 0.0f, 1e-4f);
            }
        }
    }
}

} // namespace
} // namespace celadon::ui
