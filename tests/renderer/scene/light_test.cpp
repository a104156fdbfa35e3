#include "renderer/scene/camera.h"
#include "renderer/scene/light.h"
#include "renderer/scene/number_list.h"
#include "subedit/errors.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace celadon {
namespace {

TEST(ParseNumbers, TakesWholeFiniteFieldsOnly) {
    EXPECT_EQ(parseNumbers("1,-2.5,3e2"), (std::vector<double>{1.0, -2.5, 300.0}));
    EXPECT_EQ(parseNumbers(" +1 , .5"), (std::vector<double>{1.0, 0.5}));
    for (const char* text : {"", ",", "1,", "1,,2", "1;2", "0x10", "nan", "inf", "-inf", "1e999",
                             "1 2", "+-1", "--1", "1,2z", "\xff"}) {
        EXPECT_FALSE(parseNumbers(text)) << text;
    }
}

TEST(ParseLight, Directional) {
    const Light light = parseLight("directional:0,-3,4:1,2,3");
    EXPECT_EQ(light.kind, Light::Kind::Directional);
    EXPECT_NEAR(glm::distance(light.direction, glm::dvec3(0.0, -0.6, 0.8)), 0.0, 1e-15);
    EXPECT_EQ(light.color, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(parseLight("directional:0,0,1").color, glm::dvec3(1.0));
    EXPECT_NEAR(glm::length(parseLight("directional:1e-200,1e-200,0").direction), 1.0, 1e-15);
    EXPECT_NEAR(glm::length(parseLight("directional:1e200,1e200,0").direction), 1.0, 1e-15);
}

TEST(ParseLight, Point) {
    const Light light = parseLight("point:1,2,-3:4,5,6");
    EXPECT_EQ(light.kind, Light::Kind::Point);
    EXPECT_EQ(light.position, glm::dvec3(1.0, 2.0, -3.0));
    EXPECT_EQ(light.color, glm::dvec3(4.0, 5.0, 6.0));
}

TEST(ParseLight, Spot) {
    const Light light = parseLight("spot:1,2,3:0,0,-2:10,30:7,8,9");
    EXPECT_EQ(light.kind, Light::Kind::Spot);
    EXPECT_EQ(light.position, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(light.direction, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_DOUBLE_EQ(light.innerConeRadians, glm::radians(10.0));
    EXPECT_DOUBLE_EQ(light.outerConeRadians, glm::radians(30.0));
    EXPECT_EQ(light.color, glm::dvec3(7.0, 8.0, 9.0));
}

TEST(ParseLight, RefusalsNameTheArgument) {
    for (const std::string text : {"",
                                   "sun:0,1,0",
                                   "Directional:0,1,0",
                                   "directional",
                                   "directional:",
                                   "directional:0,0,0",
                                   "directional:0,nan,0",
                                   "directional:0,1",
                                   "directional:0,1,0,0",
                                   "directional:0,1,0:1,1,-1",
                                   "directional:0,1,0:1,1,inf",
                                   "directional:0,1,0:",
                                   "directional:0,1,0:1,1,1:2",
                                   "point:1,2",
                                   "point:1,2,3:1",
                                   "spot:0,0,0:0,0,-1",
                                   "spot:0,0,0:0,0,0:10,20",
                                   "spot:0,0,0:0,0,-1:20,10",
                                   "spot:0,0,0:0,0,-1:20,20",
                                   "spot:0,0,0:0,0,-1:10,91",
                                   "spot:0,0,0:0,0,-1:-1,20",
                                   "spot:0,0,0:0,0,-1:nan,20",
                                   "spot:0,0,0:0,0,-1:10",
                                   "spot:0,0,0:0,0,-1:10,20:1,1,1:"}) {
        try {
            (void)parseLight(text);
            ADD_FAILURE() << text;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find("--light '" + text + "'"), std::string::npos)
                << error.what();
        }
    }
}

TEST(SpotFactor, OneInsideZeroOutsideSmoothBetween) {
    const Light spot = parseLight("spot:0,0,0:0,0,-1:10,30");
    EXPECT_DOUBLE_EQ(spotFactor(spot, 1.0), 1.0);
    EXPECT_NEAR(spotFactor(spot, std::cos(glm::radians(10.0))), 1.0, 1e-12);
    EXPECT_NEAR(spotFactor(spot, std::cos(glm::radians(30.0))), 0.0, 1e-12);
    EXPECT_EQ(spotFactor(spot, -1.0), 0.0);
    double previous = 1.0;
    for (double angle = 10.0; angle <= 30.0; angle += 0.5) {
        const double factor = spotFactor(spot, std::cos(glm::radians(angle)));
        EXPECT_LE(factor, previous + 1e-12);
        previous = factor;
    }
    // KHR_lights_punctual: the square of the ramp, whose middle is a quarter.
    const double middle = 0.5 * (std::cos(glm::radians(10.0)) + std::cos(glm::radians(30.0)));
    EXPECT_NEAR(spotFactor(spot, middle), 0.25, 1e-12);
}

TEST(SpotFactor, NarrowConesKeepTheirIntensity) {
    EXPECT_DOUBLE_EQ(spotFactor(parseLight("spot:0,0,0:0,0,-1:0,1"), 1.0), 1.0);
    EXPECT_DOUBLE_EQ(spotFactor(parseLight("spot:0,0,0:0,0,-1:0,90"), 0.0), 0.0);
    EXPECT_DOUBLE_EQ(spotFactor(parseLight("point:0,0,0"), -1.0), 1.0);
}

TEST(DefaultLight, ComesFromAboveAndBehindTheObject) {
    Camera camera;
    camera.eye = {3.0, 2.0, 5.0};
    const Light light = defaultLight(camera, World());
    const CameraFrame frame = cameraFrame(camera);
    EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
    EXPECT_LT(glm::dot(light.direction, frame.forward), 0.0); // towards the viewer
    EXPECT_LT(glm::dot(light.direction, frame.up), 0.0);
    EXPECT_GT(light.color.x, 0.0);
}

/// A triangle that faces +z.
World makeSheet() {
    World world;
    WorldMesh& part = world.meshes.emplace_back();
    part.scattering = 0;
    part.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    part.mesh.indices = {0, 1, 2};
    world.looks.emplace_back();
    return world;
}

TEST(DefaultLight, ComesFromTheCameraToASheetThatItWouldNotReach) {
    Camera camera;
    camera.eye = {3.0, 2.0, 5.0};
    EXPECT_EQ(defaultLight(camera, makeSheet()).direction, cameraFrame(camera).forward);
}

TEST(DefaultLight, StaysBehindWhatItReaches) {
    Camera camera;
    camera.eye = {3.0, 2.0, 5.0};
    const glm::dvec3 usual = defaultLight(camera, World()).direction;
    World doubleSided = makeSheet();
    doubleSided.looks[0].doubleSided = true;
    EXPECT_EQ(defaultLight(camera, doubleSided).direction, usual);
    World closed = makeSheet();
    closed.meshes[0].mesh.indices = {0, 1, 2, 0, 2, 1};
    EXPECT_EQ(defaultLight(camera, closed).direction, usual);
    World opaque = makeSheet();
    opaque.meshes[0].scattering = -1;
    EXPECT_EQ(defaultLight(camera, opaque).direction, usual);
}

} // namespace
} // namespace celadon
