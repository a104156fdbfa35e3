#include "renderer/output/image_io.h"
#include "renderer/scene/builtin.h"
#include "renderer/scene/load_scene.h"
#include "subedit/errors.h"
#include "subedit/map/material_convert.h"
#include "subedit/map/material_file.h"
#include "subedit/radius_map.h"
#include "tests/support/materials.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/ball_world.h"
#include "ui/light_rig.h"
#include "ui/opened_scene.h"
#include "ui/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>

namespace celadon::ui {
namespace {

/// Two balls 60 mm apart in x, each of a material of its own that the model names.
World readTwoBalls() {
    Scene scene = makeBuiltin("sphere");
    Scene second = makeBuiltin("sphere");
    scene.meshes.resize(1);
    const double radius = boundingSphere(scene).radius;
    scene.meshes.push_back(std::move(second.meshes.front()));
    for (glm::vec3& position : scene.meshes[1].positions) {
        position.x += static_cast<float>(3.0 * radius);
    }
    scene.materials.assign(2, scene.materials.front());
    scene.meshes[0].material = 0;
    scene.meshes[1].material = 1;
    std::vector<MaterialPointer> named;
    for (const char* name : {"left", "right"}) {
        scene.materials[named.size()].subedit = std::string(name) + ".subedit.exr";
        const NamedProfile plain{name, diffusionProfile(glm::vec3(0.6f), glm::vec3(2.0f))};
        named.push_back(std::make_shared<subedit::MaterialMap>(homogeneousMaterial(plain, 1.3f)));
    }
    return buildWorld(std::move(scene), nullptr, named, nullptr, {20.0 / radius, std::nullopt});
}

/// A ball of one plain profile, 40 mm across.
World readBall(const OpenRequest& request) {
    if (request.model == "two balls") {
        return readTwoBalls();
    }
    if (request.model != "ball") {
        throw InputError("'" + request.model + "'", "cannot be opened");
    }
    return test::readBall(request);
}

nlohmann::json describe(const subedit::MaterialMap& map, const std::string& reference) {
    return {{"name", map.name}, {"extras", {{"subedit", reference}}}};
}

class SessionTest : public testing::Test {
protected:
    SessionTest() : session({readBall, describe, true}) {
        session.dispatcher().observe(
            [this](const Command& command) { recorded.push_back(command); });
        session.execute({"file.open", {{"model", "ball"}}});
    }

    /// Across the side of a ball that faces +z.
    void paintStroke(int material = 0) {
        subedit::StrokePoint point;
        const WorldMesh& ball = session.world().meshes[static_cast<std::size_t>(material)];
        const glm::vec3 center(boundingSphere(std::array{&ball.mesh}).center);
        const auto at = [&](float x) {
            const glm::vec3 n = glm::normalize(glm::vec3(x, 0.1f, 1.0f));
            point.positionMm = center + 20.0f * n;
            point.normal = n;
            return point;
        };
        session.beginStroke(material, at(-0.2f), false);
        for (int i = 1; i <= 8; ++i) {
            session.addStrokePoint(at(-0.2f + 0.05f * static_cast<float>(i)));
        }
        session.endStroke();
    }

    const subedit::MaterialMap& map() { return session.activeDocument()->material(); }

    /// The first light's direction as the camera has it.
    glm::dvec3 lightSeen() {
        const CameraFrame frame = cameraFrame(session.camera);
        const glm::dvec3 d = session.rig.lights.front().light.direction;
        return glm::dvec3(glm::dot(d, frame.right), glm::dot(d, frame.up),
                          glm::dot(d, frame.forward));
    }

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

TEST_F(SessionTest, StrokeWithGapsIsOneStepAndReplaysToTheByte) {
    session.execute({"brush.change", {{"radius", 2.0}, {"opacity", 0.5}}});
    session.execute({"operator.change", {{"name", "scale-albedo"}}}); // r_s need not grow
    const std::vector<float> before = map().logProfile;
    const glm::vec3 center(session.world().scatteringSphere.center);
    const auto at = [&](float x) {
        subedit::StrokePoint point;
        point.normal = glm::normalize(glm::vec3(x, 0.0f, 1.0f));
        point.positionMm = center + 20.0f * point.normal;
        return point;
    };
    session.beginStroke(0, at(-1.0f), false);
    session.addStrokePoint(at(-0.9f));
    subedit::StrokePoint lifted = at(0.9f);
    lifted.isLifted = true;
    session.addStrokePoint(lifted);
    session.addStrokePoint(at(1.0f));
    session.endStroke();
    EXPECT_EQ(session.activeDocument()->commandCount(), 1u);
    const std::vector<float> painted = map().logProfile;
    const subedit::Surface& surface = session.activeDocument()->surface();
    const auto isPainted = [&](float x) {
        const auto texel = surface.nearest(at(x).positionMm, at(x).normal, 2.0f);
        const std::size_t first = *texel * static_cast<std::size_t>(map().knots()) * 3;
        return painted[first] != before[first];
    };
    EXPECT_TRUE(isPainted(-0.95f));
    EXPECT_FALSE(isPainted(0.0f));
    EXPECT_TRUE(isPainted(0.95f));
    const Command stroke = parseCommand(formatCommand(recorded.back()));
    session.execute({"edit.undo"});
    EXPECT_EQ(map().logProfile, before);
    session.execute(stroke);
    EXPECT_EQ(map().logProfile, painted);
}

TEST_F(SessionTest, SelectingNeedsNothingThatTheOperatorLacks) {
    for (const char* op : {"gradient", "clone", "pattern"}) {
        session.execute({"tool.choose", {{"name", "paint"}}});
        session.execute({"operator.change", {{"name", op}}});
        EXPECT_THROW(paintStroke(), UsageError) << op;
        session.execute({"tool.choose", {{"name", "select"}}});
        paintStroke();
        EXPECT_EQ(session.undoTitle(), "select stroke");
    }
    EXPECT_FALSE(session.isModified());
}

TEST_F(SessionTest, PaintingOutsideOfTheSelectionIsSaid) {
    const auto lastNotice = [this] {
        return session.notices.empty() ? std::string() : session.notices.back().text;
    };
    session.execute({"select.change", {{"what", "none"}}});
    session.execute({"tool.choose", {{"name", "select"}}});
    session.execute({"brush.change", {{"radius", 6.0}}});
    paintStroke(); // selects the side that faces +z
    session.execute({"select.change", {{"what", "invert"}}});
    session.execute({"tool.choose", {{"name", "paint"}}});
    session.execute({"brush.change", {{"radius", 1.0}}});
    session.notices.clear();
    const std::vector<float> before = map().logProfile;
    paintStroke();
    EXPECT_EQ(map().logProfile, before);
    EXPECT_NE(lastNotice().find("outside of what is selected"), std::string::npos);
    session.notices.clear();
    session.execute({"select.change", {{"what", "all"}}});
    paintStroke();
    EXPECT_NE(map().logProfile, before);
    EXPECT_EQ(lastNotice().find("selected"), std::string::npos);
}

TEST_F(SessionTest, StepsAreCalledAsTheOperatorsAreOnScreen) {
    paintStroke();
    EXPECT_EQ(session.undoTitle(), "Profile stroke");
    for (const std::string_view edit : subedit::kOperatorNames) {
        EXPECT_NE(std::ranges::find(paintOperators(), edit, &PaintOperatorName::edit),
                  paintOperators().end())
            << edit;
    }
}

TEST_F(SessionTest, NoticesGoAfterAWhileButForErrors) {
    using namespace std::chrono_literals;
    session.notify(Notice::Kind::Info, "saved");
    EXPECT_FALSE(session.perform({"brush.change", {{"radius", -1.0}}}));
    EXPECT_FALSE(session.perform({"file.open", {{"model", "absent"}}}));
    ASSERT_EQ(session.notices.size(), 3u);
    EXPECT_EQ(session.notices[1].kind, Notice::Kind::Warning); // nothing failed
    EXPECT_EQ(session.notices[2].kind, Notice::Kind::Error);
    const auto now = std::chrono::steady_clock::now();
    EXPECT_FALSE(session.dropOldNotices(now));
    EXPECT_TRUE(session.dropOldNotices(now + 10s));
    EXPECT_EQ(session.notices.size(), 2u);
    EXPECT_TRUE(session.dropOldNotices(now + 30s));
    ASSERT_EQ(session.notices.size(), 1u);
    EXPECT_EQ(session.notices[0].kind, Notice::Kind::Error);
}

TEST_F(SessionTest, TwoMaterialsAreUndoneInOrderAndSavedEachForItself) {
    session.execute({"file.open", {{"model", "two balls"}}});
    ASSERT_EQ(session.materialCount(), 2);
    EXPECT_EQ(session.materialFile(0), "left.subedit.exr");
    EXPECT_EQ(session.materialFile(1), "right.subedit.exr");
    recorded.clear();
    const auto bytes = [this](int i) { return session.document(i)->material().logProfile; };
    const std::vector<float> left = bytes(0);
    const std::vector<float> right = bytes(1);
    paintStroke(0);
    const std::vector<float> leftPainted = bytes(0);
    EXPECT_TRUE(session.isModified(0));
    EXPECT_FALSE(session.isModified(1));
    paintStroke(1);
    EXPECT_NE(leftPainted, left);
    EXPECT_NE(bytes(1), right);
    EXPECT_EQ(bytes(0), leftPainted);
    // The latest edit goes first, whichever material is active.
    session.execute({"material.activate", {{"material", 0}}});
    session.execute({"edit.undo"});
    EXPECT_EQ(bytes(1), right);
    EXPECT_EQ(bytes(0), leftPainted);
    EXPECT_FALSE(session.isModified(1));
    session.execute({"edit.undo"});
    EXPECT_EQ(bytes(0), left);
    EXPECT_FALSE(session.isModified());
    session.execute({"edit.redo"});
    EXPECT_EQ(bytes(0), leftPainted);
    paintStroke(0);
    session.execute({"edit.redo"}); // the right one's is gone with the new stroke
    EXPECT_EQ(bytes(1), right);
    paintStroke(1);
    // A save clears what it saved.
    const test::TemporaryFolder folder;
    const auto save = [&](Session& of, int material, const std::string& name) {
        of.execute({"file.save", {{"file", (folder / name).string()}, {"material", material}}});
    };
    save(session, 1, "b.subedit.exr");
    EXPECT_FALSE(session.isModified(1));
    EXPECT_TRUE(session.isModified(0));
    EXPECT_EQ(session.materialFile(0), "left.subedit.exr");
    save(session, 0, "a.subedit.exr");
    EXPECT_FALSE(session.isModified());
    // And a replay does the same to the same.
    Session replayed({readBall, describe, true});
    replayed.execute({"file.open", {{"model", "two balls"}}});
    for (const Command& command : recorded) {
        if (command.name != "file.save") {
            replayed.execute(command);
        }
    }
    save(replayed, 0, "a2.subedit.exr");
    save(replayed, 1, "b2.subedit.exr");
    EXPECT_EQ(test::readText(folder / "a2.subedit.exr"), test::readText(folder / "a.subedit.exr"));
    EXPECT_EQ(test::readText(folder / "b2.subedit.exr"), test::readText(folder / "b.subedit.exr"));
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

    Session other({readBall, describe, true});
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

TEST_F(SessionTest, LongEditsWaitForTheEndOfTheFrameAndCanBeGivenUp) {
    const std::vector<float> before = session.activeDocument()->material().logProfile;
    const std::size_t recordedBefore = recorded.size();
    bool isGivenUp = true;
    int told = 0;
    session.onProgress = [&](const std::string& title, float) {
        ++told;
        if (isGivenUp) {
            throw GivenUp(title);
        }
    };
    EXPECT_TRUE(session.perform({"edit.fill"}));
    EXPECT_EQ(told, 0); // it waits
    session.performWaiting();
    EXPECT_GT(told, 0);
    EXPECT_EQ(session.activeDocument()->material().logProfile, before);
    EXPECT_FALSE(session.undoTitle());
    EXPECT_FALSE(session.isModified());
    EXPECT_EQ(recorded.size(), recordedBefore);
    ASSERT_FALSE(session.notices.empty());
    EXPECT_EQ(session.notices.back().kind, Notice::Kind::Info);

    isGivenUp = false;
    session.perform({"edit.fill"});
    session.perform({"edit.undo"}); // comes after what waits
    EXPECT_FALSE(session.undoTitle());
    session.performWaiting();
    EXPECT_EQ(session.activeDocument()->material().logProfile, before);
    EXPECT_TRUE(session.redoTitle());
    EXPECT_EQ(recorded.size(), recordedBefore + 2);
}

TEST_F(SessionTest, StrokesThatAreWorkedOutAtTheirEndWaitForTheEndOfTheFrame) {
    session.execute({"operator.change", {{"name", "enhance"}}});
    paintStroke();
    ASSERT_EQ(recorded.back().name, "paint.edit");
    const Command direct = recorded.back();
    session.execute({"edit.undo"});

    int told = 0;
    session.onProgress = [&told](const std::string&, float) { ++told; };
    const std::size_t recordedBefore = recorded.size();
    paintStroke();
    EXPECT_FALSE(session.isStrokeOpen());
    EXPECT_EQ(recorded.size(), recordedBefore);
    session.performWaiting();
    EXPECT_EQ(recorded.size(), recordedBefore + 1);
    EXPECT_EQ(recorded.back().arguments, direct.arguments);

    // The first of two selections replaces all, the second adds, though both end within a frame.
    session.execute({"tool.choose", {{"name", "select"}}});
    paintStroke();
    paintStroke();
    session.performWaiting();
    EXPECT_EQ(recorded[recorded.size() - 2].arguments.at("edit").value("mode", "replace"),
              "replace");
    EXPECT_EQ(recorded.back().arguments.at("edit").value("mode", "replace"), "add");

    // A stroke that the material follows comes after what waits.
    paintStroke();
    session.execute({"tool.choose", {{"name", "paint"}}});
    session.execute({"operator.change", {{"name", "scale-albedo"}}});
    const std::size_t strokes = session.activeDocument()->commandCount();
    paintStroke();
    EXPECT_EQ(session.activeDocument()->commandCount(), strokes + 2);
    EXPECT_GT(told, 0);
    EXPECT_EQ(session.notices.size(), 0u);
}

TEST_F(SessionTest, WhatIsRecoveredWaitsForNothing) {
    const std::vector<float> before = map().logProfile;
    paintStroke();
    const Command stroke = recorded.back();
    session.execute({"edit.undo"});
    session.onProgress = [](const std::string&, float) {};
    EXPECT_TRUE(session.performNow(stroke));
    EXPECT_NE(map().logProfile, before);
    EXPECT_TRUE(session.performNow({"edit.undo"}));
    EXPECT_EQ(map().logProfile, before);
    EXPECT_FALSE(session.hasWaiting());
    EXPECT_FALSE(session.performNow({"edit.sing"}));
    // By hand it waits, and all that comes after it.
    EXPECT_TRUE(session.perform({"edit.redo"}));
    EXPECT_TRUE(session.perform({"tool.choose", {{"name", "pick"}}}));
    EXPECT_EQ(map().logProfile, before);
    EXPECT_EQ(session.paint.tool, Tool::Paint);
    session.performWaiting();
    EXPECT_NE(map().logProfile, before);
    EXPECT_EQ(session.paint.tool, Tool::Pick);
    EXPECT_EQ(recorded.back().name, "tool.choose");
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
    // So is a radius that is too short for the knots to hold the light of.
    session.execute({"profile.change", {{"albedo", {0.999, 0.9, 0.9}}}});
    session.execute({"profile.change", {{"radius", {0.001, 1.0, 1.0}}}});
    EXPECT_LE(subedit::diffuseAlbedo(session.paint.primary.profile.view()).r, 1.0);
}

/// At a place of the ball, as a click sends it.
nlohmann::json placeAt(const Session& session, const glm::vec3& direction) {
    const glm::dvec3 n(glm::normalize(direction));
    return {{"position", toJson(session.world().scatteringSphere.center + 20.0 * n)},
            {"normal", toJson(n)}};
}

/// A picture of which the left half is white.
std::filesystem::path writeHalfWhite(const std::filesystem::path& file) {
    FloatImage image{8, 8, {"R", "G", "B"}, {}};
    for (int i = 0; i < 64; ++i) {
        image.pixels.insert(image.pixels.end(), 3, i % 8 < 4 ? 1.0f : 0.0f);
    }
    writeDisplayImage(file, image);
    return file;
}

TEST_F(SessionTest, StampFollowsItsPictureAndReachesNoFarther) {
    const test::TemporaryFolder folder;
    session.execute({"stamp.open", {{"file", writeHalfWhite(folder / "half.png").string()}}});
    EXPECT_EQ(session.paint.tool, Tool::Stamp);
    session.execute({"brush.change", {{"radius", 4.0}}});
    session.execute({"operator.change", {{"name", "scale-albedo"}}});
    const std::vector<float> before = map().logProfile;
    session.execute({"stamp.place", placeAt(session, {0.0f, 0.0f, 1.0f})});
    const subedit::Surface& surface = session.activeDocument()->surface();
    const std::size_t values = static_cast<std::size_t>(map().knots()) * 3;
    const glm::vec3 center(session.world().scatteringSphere.center);
    std::size_t left = 0;
    for (const subedit::Surface::Texel texel : surface.coveredTexels()) {
        const bool isChanged =
            std::memcmp(&before[texel * values], &map().logProfile[texel * values],
                        values * sizeof(float)) != 0;
        const glm::vec3 p = surface.positionMm(texel) - center;
        // Seen from +z with +y up, the left half is x < 0; bilinear filtering reaches half a pixel.
        const bool isInside = p.z > 0.0f && p.x < 0.51f && p.x > -4.51f && std::abs(p.y) < 4.51f;
        EXPECT_FALSE(isChanged && !isInside) << p.x << ' ' << p.y << ' ' << p.z;
        left += isChanged ? 1 : 0;
    }
    EXPECT_GT(left, 200u);
    session.execute({"edit.undo"});
    EXPECT_EQ(map().logProfile, before);
}

TEST_F(SessionTest, MirroredStampIsTheMirrorImage) {
    const test::TemporaryFolder folder;
    session.execute({"stamp.open", {{"file", writeHalfWhite(folder / "half.png").string()}}});
    session.execute({"brush.change", {{"radius", 4.0}}});
    session.execute({"brush.mirror", {{"x", true}}});
    session.execute({"operator.change", {{"name", "scale-albedo"}}});
    const std::vector<float> before = map().logProfile;
    const glm::vec3 n(0.6f, 0.0f, 0.8f);
    session.execute({"stamp.place", placeAt(session, n)});
    const subedit::Surface& surface = session.activeDocument()->surface();
    const std::size_t values = static_cast<std::size_t>(map().knots()) * 3;
    const glm::vec3 center(session.world().scatteringSphere.center);
    const glm::vec3 right(0.8f, 0.0f, -0.6f); // seen from outside
    std::array<std::size_t, 2> count{};
    for (const subedit::Surface::Texel texel : surface.coveredTexels()) {
        if (std::memcmp(&before[texel * values], &map().logProfile[texel * values],
                        values * sizeof(float)) == 0) {
            continue;
        }
        const glm::vec3 p = surface.positionMm(texel) - center;
        const float along = glm::dot(glm::vec3(std::abs(p.x), p.y, p.z) - 20.0f * n, right);
        EXPECT_LT(along, 0.51f) << "the left half, on both sides";
        EXPECT_GT(along, -4.51f);
        ++count[p.x < 0.0f ? 1 : 0];
    }
    EXPECT_GT(count[0], 200u);
    EXPECT_NEAR(static_cast<double>(count[1]) / static_cast<double>(count[0]), 1.0, 0.1);
    session.execute({"edit.undo"});
    EXPECT_EQ(map().logProfile, before) << "one step";
}

TEST_F(SessionTest, ScribblesSpreadToWhatResemblesThem) {
    // Half of the ball becomes another profile; a scribble there must leave the rest alone.
    session.execute({"brush.change", {{"radius", 14.0}, {"hardness", 1.0}}});
    session.execute({"operator.change", {{"name", "profile"}}});
    subedit::StrokePoint point;
    point.normal = {0.0f, 0.0f, 1.0f};
    point.positionMm = glm::vec3(session.world().scatteringSphere.center) + 20.0f * point.normal;
    session.beginStroke(0, point, false);
    session.endStroke();
    const std::vector<float> before = map().logProfile;
    session.execute({"brush.change", {{"radius", 3.0}}});
    session.execute({"operator.change", {{"name", "scale-albedo"}, {"albedoFactor", 0.5}}});
    const nlohmann::json place = placeAt(session, {0.0f, 0.0f, 1.0f});
    std::vector<double> path = place["position"];
    for (const double n : place["normal"]) {
        path.push_back(n);
    }
    EXPECT_FALSE(session.perform({"scribble.apply"})); // there is none yet
    session.execute({"scribble.add", {{"path", path}, {"strength", 1.0}}});
    session.execute({"scribble.change", {{"similarity", 0.05}, {"distance", 0.0}}});
    session.execute({"scribble.apply", {{"select", false}}});
    const subedit::Surface& surface = session.activeDocument()->surface();
    const std::size_t values = static_cast<std::size_t>(map().knots()) * 3;
    std::size_t changedNear = 0, near = 0, changedFar = 0;
    for (const subedit::Surface::Texel texel : surface.coveredTexels()) {
        const glm::vec3 p = surface.positionMm(texel) - point.positionMm;
        const bool isChanged = map().logProfile[texel * values] != before[texel * values];
        if (glm::length(p) < 12.0f) {
            ++near;
            changedNear += isChanged ? 1 : 0;
        } else if (glm::length(p) > 16.0f) {
            changedFar += isChanged ? 1 : 0;
        }
    }
    EXPECT_GT(near, 1000u);
    EXPECT_EQ(changedNear, near);
    EXPECT_EQ(changedFar, 0u);
}

TEST_F(SessionTest, ScribblesLeaveOutTheirGaps) {
    const auto add = [this](const nlohmann::json& lifted) {
        Command command{"scribble.add",
                        {{"path", {20, 0, 0, 1, 0, 0, 0, 0, 20, 0, 0, 1, 0, 20, 0, 0, 1, 0}},
                         {"strength", 1.0}}};
        if (!lifted.is_null()) {
            command.arguments["lifted"] = lifted;
        }
        session.execute(command);
    };
    add({1});
    add(nullptr);
    const auto& scribbles = session.paint.propagation.scribbles;
    ASSERT_EQ(scribbles.size(), 2u);
    EXPECT_TRUE(scribbles[0].path[1].isLifted);
    EXPECT_FALSE(scribbles[0].path[2].isLifted);
    EXPECT_FALSE(scribbles[1].path[1].isLifted);
    EXPECT_THROW(add({3}), UsageError);
    EXPECT_THROW(add({-1}), UsageError);
    EXPECT_EQ(scribbles.size(), 2u);
}

TEST_F(SessionTest, GradientNeedsItsLineAndRunsAlongIt) {
    session.execute({"operator.change", {{"name", "gradient"}}});
    EXPECT_FALSE(session.perform({"edit.fill"}));
    EXPECT_FALSE(session.isModified());
    const glm::dvec3 center = session.world().scatteringSphere.center;
    session.execute({"gradient.line",
                     {{"from", toJson(center - glm::dvec3(15.0, 0.0, 0.0))},
                      {"to", toJson(center + glm::dvec3(15.0, 0.0, 0.0))}}});
    session.execute({"edit.fill"});
    const subedit::Surface& surface = session.activeDocument()->surface();
    const glm::dvec3 first = subedit::diffuseAlbedo(session.paint.primary.profile.view());
    const glm::dvec3 last = subedit::diffuseAlbedo(session.paint.secondary.profile.view());
    for (const subedit::Surface::Texel texel : surface.coveredTexels()) {
        const double x = static_cast<double>(surface.positionMm(texel).x) - center.x;
        if (std::abs(x) > 16.0) {
            const auto width = static_cast<std::size_t>(map().width);
            const glm::dvec3 albedo = subedit::diffuseAlbedo(
                storedProfile(map(), int(texel % width), int(texel / width)).view());
            EXPECT_LT(glm::distance(albedo, x < 0.0 ? first : last), 0.02);
        }
    }
}

TEST_F(SessionTest, ExportCanBeOpenedAgainWithTheSameMaterial) {
    paintStroke();
    session.execute({"deform.add", {{"type", "lattice"}}});
    session.execute({"deform.point", {{"deformer", 0}, {"point", {1, 2, 1}}, {"by", {0, 10, 0}}}});
    const test::TemporaryFolder folder;
    const auto file = folder / "ball.gltf";
    session.execute({"file.export", {{"file", file.string()}}});
    const Scene scene = loadScene(file.string());
    ASSERT_TRUE(scene.materials.front().subedit);
    const auto saved = folder / "saved.subedit.exr";
    session.execute({"file.save", {{"file", saved.string()}}});
    EXPECT_EQ(test::readText(*scene.materials.front().subedit), test::readText(saved));
    EXPECT_EQ(scene.meshes.front().indices, session.world().meshes.front().mesh.indices);
    ASSERT_TRUE(scene.rig && scene.rig->deformers); // 0.4 mm per unit there, meters here
    const glm::dvec3 by = scene.rig->deformers->front().moves.front().by.vector(0.0);
    EXPECT_NEAR(by.y, 0.4 * 10.0 / 1000.0, 1e-9);
    EXPECT_FALSE(session.perform({"file.export", {{"file", "/nowhere/ball.gltf"}}}));
}

TEST_F(SessionTest, ExportKeepsTheLights) {
    EXPECT_FALSE(session.areLightsModified());
    session.execute({"light.preset", {{"name", "studio"}}});
    session.execute({"light.add", {{"kind", "spot"}}});
    session.execute({"light.add", {{"kind", "point"}}});
    session.execute({"light.change", {{"light", 0}, {"on", false}}});
    EXPECT_TRUE(session.areLightsModified());
    EXPECT_TRUE(session.isAnythingModified());
    EXPECT_FALSE(session.isModified());
    const test::TemporaryFolder folder;
    for (const char* const name : {"ball.gltf", "ball.glb"}) {
        session.execute({"file.export", {{"file", (folder / name).string()}}});
        EXPECT_FALSE(session.areLightsModified());
        const Scene scene = loadScene((folder / name).string());
        ASSERT_EQ(scene.lights.size() + 1, session.rig.lights.size()); // those that are on
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            const Light& kept = scene.lights[i];
            const Light& light = session.rig.lights[i + 1].light;
            EXPECT_EQ(kept.kind, light.kind);
            EXPECT_LT(glm::distance(kept.color, light.color), 1e-5 * glm::length(light.color));
            if (kept.kind != Light::Kind::Directional) { // in meters there
                EXPECT_LT(glm::distance(1000.0 * kept.position, light.position), 1e-6);
            }
            if (kept.kind != Light::Kind::Point) {
                EXPECT_LT(glm::distance(kept.direction, light.direction), 1e-6);
            }
        }
    }
    session.undo();
    EXPECT_TRUE(session.areLightsModified());
}

TEST_F(SessionTest, LookingAroundIsNoChangeOfLights) {
    session.execute({"camera.turntable", {{"degrees", 77.0}}});
    EXPECT_FALSE(session.areLightsModified());
    EXPECT_FALSE(session.areLightsOther());
}

TEST_F(SessionTest, NewLightsStandBesideOthers) {
    for (int i = 0; i < 3; ++i) {
        session.execute({"light.add", {{"kind", i == 1 ? "spot" : "point"}}});
    }
    const auto& lights = session.rig.lights;
    for (std::size_t i = lights.size() - 3; i < lights.size(); ++i) {
        for (std::size_t j = i + 1; j < lights.size(); ++j) {
            EXPECT_GT(glm::distance(lights[i].light.position, lights[j].light.position),
                      0.1 * session.world().scatteringSphere.radius);
        }
    }
}

TEST_F(SessionTest, SelectingWhatIsSelectedIsNoStep) {
    paintStroke();
    session.undo();
    session.execute({"select.change", {{"what", "all"}}});
    EXPECT_EQ(session.undo(), Session::Undone::Nothing);
    EXPECT_NE(session.redo(), Session::Undone::Nothing);
    session.undo();
    session.execute({"select.change", {{"what", "none"}}});
    EXPECT_EQ(session.redo(), Session::Undone::Nothing);
    EXPECT_NE(session.undo(), Session::Undone::Nothing);
}

TEST_F(SessionTest, ExposureFitsTheLightsThatAModelBrings) {
    BoundingSphere object;
    object.radius = 500.0;
    Light light;
    light.color = glm::dvec3(5.0);
    EXPECT_EQ(fittingExposureEv({}, object), 0.0f);
    EXPECT_EQ(fittingExposureEv(std::array{light}, object), 0.0f);
    light.color = glm::dvec3(40.0);
    EXPECT_EQ(fittingExposureEv(std::array{light}, object), -3.0f);
    light.kind = Light::Kind::Point; // at 2 m, a quarter
    light.color = glm::dvec3(48.0);
    light.position = {0, 0, 2000.0};
    EXPECT_EQ(fittingExposureEv(std::array{light}, object), -1.0f);
    light.color = glm::dvec3(1.25);
    EXPECT_EQ(fittingExposureEv(std::array{light}, object), 4.0f);
    light.position = {0, 0, 1.0}; // within: no nearer than the surface
    EXPECT_EQ(fittingExposureEv(std::array{light}, object), 0.0f);
}

TEST_F(SessionTest, TurntableTurnsLightsWithTheCamera) {
    const glm::dvec3 before = lightSeen();
    const glm::dvec3 eye = session.camera.eye;
    session.execute({"camera.turntable", {{"degrees", 77.0}}});
    EXPECT_LT(glm::distance(before, lightSeen()), 1e-9);
    EXPECT_GT(glm::distance(eye, session.camera.eye), 1.0);
    session.execute({"camera.turntable", {{"degrees", -77.0}}});
    EXPECT_LT(glm::distance(eye, session.camera.eye), 1e-9);
}

TEST_F(SessionTest, LightsProfilesAndStrokesAreUndoneInOneRow) {
    const auto red = [this] { return session.rig.lights.front().light.color.x; };
    const auto knot = [this] { return session.paint.primary.profile.logProfile[3 * 4]; };
    const auto paint = [&](const char* which, float value, bool continues) {
        session.execute({"profile.knot",
                         {{"which", which},
                          {"channel", 0},
                          {"knot", 4},
                          {"log", value},
                          {"continues", continues}}});
    };
    const std::vector<float> plain = map().logProfile;
    const double redBefore = red();
    const float knotBefore = knot();
    const auto light = [&](double strength, bool continues) {
        session.execute(
            {"light.change",
             {{"light", 0}, {"color", {strength, 1.0, 1.0}}, {"continues", continues}}});
    };
    light(7.0, false);
    light(8.0, true); // the slider goes on: one step
    paintStroke();
    const std::vector<float> painted = map().logProfile;
    paint("primary", knotBefore - 1.0f, false);
    EXPECT_EQ(session.undoTitle(), "move knot");
    session.execute({"edit.undo"});
    EXPECT_EQ(knot(), knotBefore);
    EXPECT_EQ(map().logProfile, painted);
    session.execute({"edit.undo"});
    EXPECT_EQ(map().logProfile, plain);
    EXPECT_EQ(red(), 8.0);
    EXPECT_EQ(session.undoTitle(), "change light");
    session.execute({"edit.undo"});
    EXPECT_EQ(red(), redBefore);
    EXPECT_FALSE(session.undoTitle());
    for (int i = 0; i < 3; ++i) {
        session.execute({"edit.redo"});
    }
    EXPECT_FALSE(session.redoTitle());
    EXPECT_EQ(red(), 8.0);
    EXPECT_EQ(map().logProfile, painted);
    EXPECT_EQ(knot(), knotBefore - 1.0f);
    // What took back a setting is told from what took back work.
    std::vector<bool> settings;
    for (const Command& command : recorded) {
        if (command.name == "edit.undo") {
            settings.push_back(command.arguments.value("setting", false));
        }
    }
    EXPECT_EQ(settings, (std::vector<bool>{true, false, true}));
}

TEST_F(SessionTest, UndoShowsTheLightThatItChanges) {
    session.execute({"light.preset", {{"name", "studio"}}});
    ASSERT_GE(session.rig.lights.size(), 2u);
    const std::size_t last = session.rig.lights.size() - 1;
    session.execute({"light.change", {{"light", last}, {"color", {3.0, 2.0, 1.0}}}});
    session.execute({"light.select", {{"light", 0}}});
    session.execute({"edit.undo"});
    EXPECT_EQ(session.selectedLight, static_cast<int>(last));
    session.execute({"light.remove", {{"light", last}}});
    EXPECT_LT(session.selectedLight, static_cast<int>(last));
    session.execute({"edit.undo"}); // it comes back
    EXPECT_EQ(session.selectedLight, static_cast<int>(last));
    session.execute({"edit.redo"});
    EXPECT_EQ(session.selectedLight, static_cast<int>(last) - 1);
}

TEST_F(SessionTest, UndoFollowsProfilesAndLightsThatWentOn) {
    const auto knot = [](const NamedProfile& profile) { return profile.profile.logProfile[3 * 4]; };
    const float before = knot(session.paint.primary);
    const float other = knot(session.paint.secondary);
    session.execute({"profile.knot",
                     {{"which", "primary"}, {"channel", 0}, {"knot", 4}, {"log", before - 1.0f}}});
    session.execute({"profile.swap"}); // no step itself
    session.execute({"edit.undo"});
    EXPECT_EQ(knot(session.paint.secondary), before);
    EXPECT_EQ(knot(session.paint.primary), other);

    session.execute({"light.preset", {{"name", "studio"}}});
    const glm::dvec3 lit = lightSeen();
    session.execute({"light.remove", {{"light", 0}}});
    session.selectedLight = 1;
    session.execute({"camera.turntable", {{"degrees", 77.0}}});
    session.execute({"edit.undo"});
    EXPECT_LT(glm::distance(lit, lightSeen()), 1e-9);
    session.execute({"edit.undo"}); // the preset: one light again
    EXPECT_LT(session.selectedLight, static_cast<int>(session.rig.lights.size()));
    session.execute({"light.remove", {{"light", 0}}});
    EXPECT_FALSE(session.redoTitle()); // what was taken back is gone
}

TEST_F(SessionTest, ANewStepOfAnyKindEndsRedoing) {
    const auto setLight = [this] {
        session.execute({"light.change", {{"light", 0}, {"color", {7, 1, 1}}}});
    };
    setLight();
    session.execute({"edit.undo"});
    paintStroke(); // the light's step is gone
    session.execute({"edit.undo"});
    EXPECT_NE(session.redoTitle(), "change light");
    ASSERT_TRUE(session.redoTitle());
    setLight(); // and now the stroke
    EXPECT_FALSE(session.redoTitle());
    EXPECT_EQ(session.undoTitle(), "change light");
    session.execute({"edit.undo"});
    EXPECT_EQ(session.redoTitle(), "change light");
    EXPECT_FALSE(session.undoTitle());
}

TEST_F(SessionTest, SizeTakesSelectionsAndDeformersAlong) {
    session.execute({"deform.add", {{"type", "inflate"}}});
    session.execute({"deform.change", {{"deformer", 0}, {"amount", 2.0}}});
    session.execute({"select.change", {{"what", "none"}}});
    const Camera camera = session.camera;
    session.execute({"scene.size", {{"diameter", 20.0}}});
    EXPECT_TRUE(session.activeDocument()->selection().isZero());
    EXPECT_NEAR(session.motion.now.deformers.front().amount.number(0.0), 1.0, 1e-6);
    EXPECT_TRUE(session.undoTitle() == std::nullopt);
    session.execute({"light.change", {{"light", 0}, {"color", {7, 1, 1}}}});
    session.execute({"scene.size", {{"diameter", 20.0}}}); // as large as it is: nothing is lost
    EXPECT_EQ(session.undoTitle(), "change light");
    // The same model read again at another size: all that stands about it goes along.
    session.execute({"file.open", {{"model", "ball"}}});
    EXPECT_NEAR(session.world().scatteringSphere.radius, 20.0, 1e-3);
    EXPECT_LT(glm::distance(session.camera.eye, camera.eye), 1e-3);
    EXPECT_NEAR(session.motion.now.deformers.front().amount.number(0.0), 2.0, 1e-6);
}

TEST_F(SessionTest, SizeChangesMillimetersAndNothingElse) {
    session.execute({"light.add", {{"kind", "point"}}});
    paintStroke();
    const std::vector<float> painted = map().logProfile;
    const std::vector<glm::vec2> uvs = session.world().meshes.front().mesh.uvs;
    const double distance = glm::distance(session.camera.eye, session.camera.at);
    const RigLight light = session.rig.lights.back();
    const float brush = session.paint.brush.radiusMm;
    session.execute({"scene.size", {{"diameter", 400.0}}});
    EXPECT_NEAR(session.world().scatteringSphere.radius, 200.0, 1e-3);
    EXPECT_EQ(map().logProfile, painted); // in mm as before, of a model ten times as large
    EXPECT_EQ(session.world().meshes.front().mesh.uvs, uvs);
    EXPECT_TRUE(session.isModified());
    EXPECT_FALSE(session.undoTitle());
    EXPECT_NEAR(glm::distance(session.camera.eye, session.camera.at), 10.0 * distance, 1e-3);
    const RigLight& moved = session.rig.lights.back();
    EXPECT_LT(glm::distance(moved.light.position, 10.0 * light.light.position), 1e-3);
    EXPECT_NEAR(moved.light.color.x / light.light.color.x, 100.0, 1e-3); // as bright there
    EXPECT_FLOAT_EQ(session.paint.brush.radiusMm, 10.0f * brush);
    EXPECT_EQ(session.opened().diameterMm, 400.0);
    // Strokes lie on the model as it is now.
    const glm::vec3 center(session.world().scatteringSphere.center);
    const subedit::Surface& surface = session.activeDocument()->surface();
    EXPECT_NEAR(glm::distance(surface.positionMm(surface.coveredTexels().front()), center), 200.0f,
                1.0f);
    EXPECT_THROW(session.execute({"scene.size", {{"diameter", -1.0}}}), UsageError);
    // The same again from what was recorded.
    Session again({readBall, describe, true});
    for (const Command& command : recorded) {
        again.execute(parseCommand(formatCommand(command)));
    }
    EXPECT_EQ(again.activeDocument()->material().logProfile, painted);
    EXPECT_NEAR(again.world().scatteringSphere.radius, 200.0, 1e-3);
    // What is saved is not modified by a size.
    const test::TemporaryFolder folder;
    session.execute({"file.save", {{"file", (folder.path() / "a.subedit.exr").string()}}});
    EXPECT_FALSE(session.isModified());
    session.execute({"scene.size", {{"diameter", 40.0}}});
    EXPECT_FALSE(session.isModified());
    EXPECT_EQ(session.materialFile(0), folder.path() / "a.subedit.exr");
}

TEST_F(SessionTest, EveryCommandHasASummary) {
    for (const auto& [name, entry] : session.dispatcher().entries()) {
        EXPECT_FALSE(entry.summary.empty()) << name;
        EXPECT_NE(name.find('.'), std::string::npos) << name;
    }
}

TEST(OpenedScene, AModelTooLargeForItsMaterialIsSaid) {
    World world;
    world.materials = {test::materialNamed("medium")};
    const glm::dvec3 R_P =
        subedit::effectiveRadiusMm(subedit::profileAt(*world.materials[0], 0, 0));
    const double shortestMm = std::min({R_P.r, R_P.g, R_P.b});
    world.scatteringSphere.radius = 50.0 * shortestMm;
    EXPECT_TRUE(prepareScene(world, false).world.warnings.empty());
    world.scatteringSphere.radius = 5000.0 * shortestMm;
    const std::vector<std::string> warnings = prepareScene(world, false).world.warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("--diameter"), std::string::npos);
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
