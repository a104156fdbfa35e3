#include "renderer/scene/builtin.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/number_list.h"
#include "subedit/errors.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace celadon {
namespace {

World worldOf(const char* builtin) {
    return buildWorld(makeBuiltin(builtin), nullptr, {}, std::make_shared<subedit::MaterialMap>(),
                      {});
}

glm::dvec3 project(const CameraView& view, const glm::dvec3& p) {
    const glm::dvec4 clip =
        glm::dmat4(view.projection) * glm::dmat4(view.view) * glm::dvec4(p, 1.0);
    return glm::dvec3(clip) / clip.w;
}

Camera lookingDownZ() {
    Camera camera;
    camera.eye = {0.0, 0.0, 200.0};
    camera.fovYDegrees = 40.0;
    return camera;
}

constexpr BoundingSphere kBall{{0.0, 0.0, 0.0}, 50.0};

TEST(CameraView, PerspectiveDepthIsReversedAndNeverEnds) {
    const CameraView view = makeCameraView(lookingDownZ(), 800, 600);
    double last = 1.0;
    for (const double depth : {0.01, 1.0, 150.0, 151.0, 250.0, 1e4, 1e7}) {
        const double z = project(view, {0.0, 0.0, 200.0 - depth}).z;
        EXPECT_GT(z, 0.0) << depth;
        EXPECT_LT(z, last) << depth;
        last = z;
    }
}

TEST(CameraView, RightIsRightAndUpIsUp) {
    const CameraView view = makeCameraView(lookingDownZ(), 800, 600);
    EXPECT_GT(project(view, {10.0, 0.0, 0.0}).x, 0.0);
    EXPECT_GT(project(view, {0.0, 10.0, 0.0}).y, 0.0);
    const double halfHeight = 200.0 * std::tan(glm::radians(20.0));
    EXPECT_NEAR(project(view, {0.0, halfHeight, 0.0}).y, 1.0, 1e-6);
    EXPECT_NEAR(project(view, {halfHeight * 800.0 / 600.0, 0.0, 0.0}).x, 1.0, 1e-6);
}

TEST(CameraView, PixelWidthIsThatOfTheProjection) {
    for (const bool orthographic : {false, true}) {
        Camera camera = lookingDownZ();
        if (orthographic) {
            camera.orthographicHeight = 120.0;
        }
        const CameraView view = makeCameraView(camera, 800, 600);
        for (const double depth : {160.0, 200.0, 240.0}) {
            const double width = view.pixelWidth.atDepthMm(depth);
            const glm::dvec3 p(3.0, 4.0, 200.0 - depth);
            EXPECT_NEAR((project(view, p + glm::dvec3(width, 0.0, 0.0)).x - project(view, p).x) *
                            400.0,
                        1.0, 1e-5);
            EXPECT_NEAR((project(view, p + glm::dvec3(0.0, width, 0.0)).y - project(view, p).y) *
                            300.0,
                        1.0, 1e-5);
        }
    }
}

TEST(CameraView, JitterMovesEveryDepthByThatManyPixels) {
    for (const bool orthographic : {false, true}) {
        Camera camera = lookingDownZ();
        if (orthographic) {
            camera.orthographicHeight = 120.0;
        }
        const CameraView still = makeCameraView(camera, 800, 600);
        const CameraView moved = makeCameraView(camera, 800, 600, {0.25, -0.5});
        for (const double z : {-40.0, 0.0, 40.0}) {
            const glm::dvec3 d = project(moved, {7.0, 9.0, z}) - project(still, {7.0, 9.0, z});
            EXPECT_NEAR(d.x * 400.0, 0.25, 1e-4);
            EXPECT_NEAR(d.y * 300.0, -0.5, 1e-4);
        }
    }
}

TEST(CameraView, TheNearPlaneIsCloserThanAnyTarget) {
    for (const double z : {0.001, 10.0, 49.0, 50.0, 51.0, 1e7}) {
        Camera camera = lookingDownZ();
        camera.eye.z = z;
        for (const double towards : {-1.0, 1.0}) { // at the ball, and away from it
            camera.at = camera.eye + glm::dvec3(0.0, 0.0, towards * z);
            const CameraView view = makeCameraView(camera, 64, 64);
            const double depth = project(view, camera.at).z;
            EXPECT_GT(depth, 0.0) << z;
            EXPECT_LT(depth, 0.5) << z;
        }
    }
}

TEST(CameraView, SaysWhatIsOutside) {
    const CameraView view = makeCameraView(lookingDownZ(), 800, 600);
    EXPECT_FALSE(isOutsideView(view, kBall));
    EXPECT_FALSE(isOutsideView(view, {{0.0, 0.0, 200.0}, 1.0}));
    EXPECT_TRUE(isOutsideView(view, {{0.0, 0.0, 260.0}, 50.0}));
    EXPECT_TRUE(isOutsideView(view, {{300.0, 0.0, 0.0}, 50.0}));
    EXPECT_TRUE(isOutsideView(view, {{0.0, -300.0, 0.0}, 50.0}));
    EXPECT_FALSE(isOutsideView(view, {{100.0, 0.0, 0.0}, 50.0}));
}

TEST(ValidateCamera, RefusesWhatIsNoView) {
    static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](auto&& change) {
        Camera camera = lookingDownZ();
        change(camera);
        EXPECT_THROW(validateCamera(camera), UsageError);
    };
    EXPECT_NO_THROW(validateCamera(lookingDownZ()));
    refused([](Camera& c) { c.at = c.eye; });
    refused([](Camera& c) { c.up = {0.0, 0.0, 3.0}; });
    refused([](Camera& c) { c.up = glm::dvec3(0.0); });
    refused([](Camera& c) { c.up.x = kNan; });
    refused([](Camera& c) { c.eye.y = kNan; });
    refused([](Camera& c) { c.at.y = std::numeric_limits<double>::infinity(); });
    refused([](Camera& c) { c.fovYDegrees = 0.0; });
    refused([](Camera& c) { c.fovYDegrees = 180.0; });
    refused([](Camera& c) { c.fovYDegrees = kNan; });
    refused([](Camera& c) { c.orthographicHeight = 0.0; });
    refused([](Camera& c) { c.orthographicHeight = kNan; });
}

TEST(ChooseCamera, DefaultViewFitsEveryVertexTightly) {
    for (const char* name : {"sphere", "slab"}) {
        const World world = worldOf(name);
        for (const double aspect : {0.5, 4.0 / 3.0, 3.0}) {
            const Camera camera = chooseCamera(world, {}, aspect);
            const CameraView view = makeCameraView(camera, static_cast<int>(600.0 * aspect), 600);
            glm::dvec2 low(1e9);
            glm::dvec2 high(-1e9);
            for (const glm::vec3& position : world.meshes[0].mesh.positions) {
                const glm::dvec2 p(project(view, position));
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            EXPECT_GT(glm::min(low.x, low.y), -0.95);
            EXPECT_LT(glm::max(high.x, high.y), 0.95);
            EXPECT_GT(glm::max(high.x, high.y), 0.9) << name << " " << aspect;
            EXPECT_NEAR(low.x + high.x, 0.0, 0.01) << name << " " << aspect;
            EXPECT_NEAR(low.y + high.y, 0.0, 0.01);
        }
    }
}

TEST(ChooseCamera, TheFilesCameraComesFirstAndOptionsWin) {
    Scene scene = makeBuiltin("sphere");
    scene.millimetersPerUnit = 10.0;
    Camera camera;
    camera.eye = {0.0, 0.0, 300.0};
    camera.fovYDegrees = 20.0;
    scene.cameras.push_back(camera);
    const World world =
        buildWorld(scene, nullptr, {}, std::make_shared<subedit::MaterialMap>(), {});
    const Camera fromFile = chooseCamera(world, {}, 1.0);
    EXPECT_EQ(fromFile.eye, glm::dvec3(0.0, 0.0, 3000.0));
    EXPECT_EQ(fromFile.fovYDegrees, 20.0);
    ViewRequest wider;
    wider.fovYDegrees = 50.0;
    EXPECT_EQ(chooseCamera(world, wider, 1.0).eye, fromFile.eye);
    EXPECT_EQ(chooseCamera(world, wider, 1.0).fovYDegrees, 50.0);
    ViewRequest placed;
    placed.from = glm::dvec3(100.0, 0.0, 0.0);
    EXPECT_EQ(chooseCamera(world, placed, 1.0).eye, glm::dvec3(1000.0, 0.0, 0.0));
    EXPECT_NEAR(glm::length(chooseCamera(world, placed, 1.0).at), 0.0, 1e-3);
}

TEST(ChooseCamera, LooksStraightDownWithoutAnUpVector) {
    const World world = worldOf("sphere");
    ViewRequest above;
    above.from = glm::dvec3(0.0, 200.0, 0.0);
    above.at = glm::dvec3(0.0);
    EXPECT_NO_THROW((void)chooseCamera(world, above, 1.0));
    above.up = glm::dvec3(0.0, 1.0, 0.0);
    EXPECT_THROW((void)chooseCamera(world, above, 1.0), UsageError);
}

TEST(ParseTriple, NamesTheOption) {
    EXPECT_EQ(parseTriple("1,2,3", "--view-from"), glm::dvec3(1.0, 2.0, 3.0));
    for (const char* text : {"1,2", "1,2,3,4", "", "a,b,c", "nan,0,0"}) {
        try {
            (void)parseTriple(text, "--view-from");
            ADD_FAILURE() << text;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find("--view-from"), std::string::npos);
        }
    }
}

} // namespace
} // namespace celadon
