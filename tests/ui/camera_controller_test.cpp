#include "subedit/errors.h"
#include "ui/camera_controller.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace celadon::ui {
namespace {

constexpr double kClose = 1e-9;

Camera someCamera() {
    Camera camera;
    camera.eye = {40.0, 30.0, 120.0};
    camera.at = {3.0, -2.0, 5.0};
    camera.fovYDegrees = 40.0;
    return camera;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = kClose) {
    EXPECT_NEAR(glm::distance(a, b), 0.0, tolerance * (1.0 + glm::length(b)));
}

TEST(CameraController, OrbitKeepsTargetAndDistance) {
    const Camera camera = someCamera();
    const Camera turned = orbited(camera, 37.0, -12.0);
    expectNear(turned.at, camera.at);
    EXPECT_NEAR(glm::distance(turned.eye, turned.at), glm::distance(camera.eye, camera.at), kClose);
    expectNear(orbited(turned, -37.0, 12.0).eye, camera.eye);
    EXPECT_GT(glm::distance(turned.eye, camera.eye), 1.0);
}

TEST(CameraController, OrbitApproachesThePolesAndStaysValid) {
    const Camera above = orbited(someCamera(), 0.0, 500.0);
    EXPECT_NO_THROW(validateCamera(above));
    EXPECT_GT(above.eye.y, above.at.y);
    EXPECT_NO_THROW(validateCamera(standardView(someCamera(), "top")));
    EXPECT_NO_THROW(validateCamera(standardView(someCamera(), "bottom")));
    EXPECT_THROW(static_cast<void>(standardView(someCamera(), "inside")), UsageError);
}

TEST(CameraController, ZoomKeepsThePlaceOfItsPivot) {
    for (const bool orthographic : {false, true}) {
        const Camera camera = withProjection(someCamera(), orthographic);
        const glm::dvec3 pivot(12.0, 9.0, -4.0);
        const double aspect = 1.5;
        const glm::dvec3 before = projected(camera, pivot, aspect);
        const glm::dvec3 after = projected(zoomed(camera, 0.7, pivot), pivot, aspect);
        EXPECT_NEAR(before.x, after.x, kClose);
        EXPECT_NEAR(before.y, after.y, kClose);
    }
    EXPECT_NO_THROW(validateCamera(zoomed(someCamera(), 0.0, someCamera().at)));
}

TEST(CameraController, RaysPassThroughWhatTheyAreProjectedFrom) {
    for (const bool orthographic : {false, true}) {
        const Camera camera = withProjection(someCamera(), orthographic);
        const glm::dvec3 point(-7.0, 11.0, 20.0);
        const glm::dvec3 place = projected(camera, point, 1.3);
        const Ray ray = rayThrough(camera, glm::dvec2(place), 1.3);
        const glm::dvec3 toPoint = point - ray.origin;
        EXPECT_NEAR(glm::length(glm::cross(ray.direction, toPoint)), 0.0, 1e-6);
        EXPECT_GT(glm::dot(ray.direction, toPoint), 0.0);
    }
}

TEST(CameraController, PanMovesThePictureByThatMuch) {
    const Camera camera = someCamera();
    const double height = pictureHeightMm(camera, camera.at);
    const Camera moved = panned(camera, 0.25 * height, 0.0);
    EXPECT_NEAR(projected(moved, camera.at, 1.0).x, 0.25, 1e-9);
    EXPECT_NEAR(projected(moved, camera.at, 1.0).y, 0.5, 1e-9);
}

TEST(CameraController, ProjectionsShowTheTargetEquallyLarge) {
    const Camera camera = someCamera();
    const Camera flat = withProjection(camera, true);
    EXPECT_NEAR(pictureHeightMm(flat, camera.at), pictureHeightMm(camera, camera.at), kClose);
    expectNear(withProjection(flat, false).eye, camera.eye);
}

} // namespace
} // namespace celadon::ui
