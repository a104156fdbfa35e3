#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/motion.h"
#include "tests/renderer/scene/load_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace celadon {
namespace {

using loadtest::GltfBuilder;
using testing::HasSubstr;

KeyedNumbers keyed(Interpolation interpolation, std::vector<double> times,
                   std::vector<double> values) {
    KeyedNumbers keys;
    keys.interpolation = interpolation;
    keys.times = std::move(times);
    keys.values = std::move(values);
    return keys;
}

TEST(KeyedNumbers, HoldTheirEndsAndStepOrRunStraightOrSmoothBetween) {
    EXPECT_EQ(KeyedNumbers::of(7.0).number(99.0), 7.0);
    const auto step = keyed(Interpolation::Step, {1, 2, 4}, {10, 20, 30});
    EXPECT_EQ(step.number(0.0), 10);
    EXPECT_EQ(step.number(1.999), 10);
    EXPECT_EQ(step.number(2.0), 20);
    const auto linear = keyed(Interpolation::Linear, {1, 2, 4}, {10, 20, 30});
    EXPECT_DOUBLE_EQ(linear.number(2.5), 22.5);
    EXPECT_EQ(linear.number(9.0), 30);
    // Through the points of a parabola the spline is that parabola, between inner keys.
    const auto p = [](double t) { return 3.0 - t + 2.0 * t * t; };
    const auto cubic =
        keyed(Interpolation::CubicSpline, {0, 1, 3, 4}, {p(0), p(1), p(3), p(4)});
    for (double t = 1.0; t <= 3.0; t += 0.25) {
        EXPECT_NEAR(cubic.number(t), p(t), 1e-12);
    }
    EXPECT_EQ(cubic.number(0.0), p(0));
    const double before = cubic.number(3.0 - 1e-6);
    const double after = cubic.number(3.0 + 1e-6);
    EXPECT_NEAR((p(3) - before) / 1e-6, (after - p(3)) / 1e-6, 1e-3); // no kink
}

TEST(KeyedNumbers, KeysAreSetMovedAndTakenAway) {
    KeyedNumbers keys = KeyedNumbers::of(5.0);
    const auto set = [&](double seconds, double value) { keys.setKey(seconds, std::span(&value, 1)); };
    set(2.0, 20.0);
    EXPECT_EQ(keys.number(0.0), 20.0); // the constant is gone
    set(1.0, 10.0);
    set(3.0, 30.0);
    set(2.0, 25.0);
    EXPECT_EQ(keys.times, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(keys.values, (std::vector<double>{10, 25, 30}));
    keys.removeKey(1);
    keys.removeKey(0);
    keys.removeKey(0);
    EXPECT_FALSE(keys.isKeyed());
    EXPECT_EQ(keys.number(0.0), 30.0);
}

/// One of each, with keys.
constexpr const char* kStack = R"({"deformers": [
  {"type": "twist", "axis": "y", "range": [0.25, 1],
   "angleDegrees": {"times": [0, 2], "values": [0, 90], "interpolation": "cubic"}},
  {"type": "wave", "axis": "x", "amplitudeMm": 3, "wavelengthMm": 40, "on": false},
  {"type": "inflate", "distanceMm": 0.5},
  {"type": "lattice", "size": [3, 2, 4],
   "moves": [{"point": [1, 0, 3], "by": [0.1, 0, -0.2]},
             {"point": [2, 1, 0],
              "by": {"times": [1, 3], "values": [[0, 0, 0], [0, 1, 0]]}}]},
  {"type": "handles",
   "handles": [{"at": [0, -1, 0], "radius": 0.2},
               {"at": [0, 1, 0], "move": [0.5, 0, 0], "turnDegrees": [0, 0, 90]}]}
]})";

class DeformerFile : public testing::Test {
protected:
    DeformerStack read(const std::string& text) {
        return loaders::readDeformers(mFolder.write("stack.json", text));
    }

    void expectRefusal(const std::string& deformer, const char* says) {
        try {
            static_cast<void>(read(R"({"deformers": [)" + deformer + "]}"));
            ADD_FAILURE() << deformer << " was read";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(says));
            EXPECT_THAT(error.what(), HasSubstr("deformer 0"));
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("export")));
        }
    }

    loadtest::TemporaryFolder mFolder;
};

TEST_F(DeformerFile, SaysWhatEveryDeformerDoesAtATime) {
    const DeformerStack stack = read(kStack);
    ASSERT_EQ(stack.size(), 5u);
    EXPECT_EQ(stack[0].at(1.0, 1.0).amount, 45.0);
    EXPECT_EQ(stack[0].range, glm::dvec2(0.25, 1.0));
    EXPECT_FALSE(stack[1].isOn);
    EXPECT_EQ(stack[1].at(0.0, 1000.0).amount, 3.0); // millimeters are not the model's
    const Deformer lattice = stack[3].at(2.0, 1000.0);
    EXPECT_EQ(lattice.lattice.offsets[lattice.lattice.index({1, 0, 3})], glm::dvec3(100, 0, -200));
    EXPECT_EQ(lattice.lattice.offsets[lattice.lattice.index({2, 1, 0})], glm::dvec3(0, 500, 0));
    const std::vector<PlacedHandle> handles = stack[4].handlesAt(0.0, 10.0);
    EXPECT_EQ(handles[0].to, glm::dvec3(0, -10, 0));
    EXPECT_EQ(handles[0].radiusMm, 2.0);
    EXPECT_EQ(handles[1].to, glm::dvec3(5, 10, 0));
    EXPECT_NEAR(glm::length(handles[1].turn * glm::dvec3(1, 0, 0) - glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    EXPECT_EQ(stack[3].lastSeconds(), 3.0);
}

TEST_F(DeformerFile, IsWrittenSuchThatItReadsBackTheSame) {
    const DeformerStack stack = read(kStack);
    EXPECT_EQ(read(loaders::deformersJson(stack).dump()), stack);
}

TEST_F(DeformerFile, WhatIsWrongIsRefusedWithItsPlace) {
    expectRefusal(R"({"type": "spin"})", "none of twist");
    expectRefusal(R"({"type": "twist", "axis": "y"})", "'angleDegrees' is missing");
    expectRefusal(R"({"type": "twist", "axis": "w", "angleDegrees": 3})", "'axis'");
    expectRefusal(R"({"type": "twist", "axis": "y", "angleDegrees": "3"})", "finite numbers");
    expectRefusal(R"({"type": "twist", "axis": "y", "angleDegrees": 3, "range": [1, 0]})", "'range'");
    expectRefusal(R"({"type": "taper", "axis": "y", "scale": -1})", "inside out");
    expectRefusal(R"({"type": "wave", "axis": "y", "amplitudeMm": 1, "wavelengthMm": 0})",
                  "not positive");
    expectRefusal(R"({"type": "inflate", "distanceMm": {"times": [1, 0], "values": [1, 2]}})",
                  "keys 0 and 1 are out of order");
    expectRefusal(R"({"type": "inflate", "distanceMm": {"times": [0, 1], "values": [1]}})",
                  "not an array of 2 values");
    expectRefusal(R"({"type": "inflate", "distanceMm": {"times": [0], "values": [null]}})",
                  "finite numbers");
    expectRefusal(
        R"({"type": "inflate", "distanceMm": {"times": [0], "values": [1], "interpolation": "sine"}})",
        "none of step, linear, cubic");
    expectRefusal(R"({"type": "lattice", "size": [3, 1, 3]})", "from 2 to 8");
    expectRefusal(R"({"type": "lattice", "size": [3, 3, 9]})", "from 2 to 8");
    expectRefusal(
        R"({"type": "lattice", "size": [2, 2, 2], "moves": [{"point": [0, 0, 2], "by": [0, 0, 0]}]})",
        "from 0 to 1");
    expectRefusal(
        R"({"type": "lattice", "size": [2, 2, 2], "moves": [{"point": [0, 0, 1], "by": [0, 0]}]})",
        "3 numbers");
    expectRefusal(R"({"type": "handles", "handles": []})", "no handles");
    expectRefusal(R"({"type": "handles", "handles": [{"at": [0, 0, 0], "radius": -1}]})",
                  "negative");
    EXPECT_THROW((void)read("{"), InputError);
    EXPECT_THROW((void)read(R"({"deformer": []})"), InputError);
    const std::string handles = R"({"type": "handles", "handles": [{"at": [0, 0, 0]}]})";
    EXPECT_THROW((void)read(R"({"deformers": [)" + handles + "," + handles + "]}"), InputError);
}

TEST_F(DeformerFile, LiesInTheSceneOfAGltfAndMovesTheModel) {
    GltfBuilder gltf;
    gltf.addTriangle();
    gltf.primitive()["attributes"]["TEXCOORD_0"] = gltf.addFloats({0, 0, 1, 0, 0, 1}, "VEC2");
    const DeformerStack stack = read(
        R"({"deformers": [{"type": "taper", "axis": "y",
                           "scale": {"times": [0, 1], "values": [1, 3]}}]})");
    for (const bool isBinary : {false, true}) {
        nlohmann::json whole = gltf.finished();
        whole["buffers"][0]["uri"] = "data.bin";
        mFolder.write("data.bin", gltf.binary);
        const auto plain =
            mFolder.write(isBinary ? "a.glb" : "a.gltf", isBinary ? gltf.glb() : whole.dump());
        EXPECT_EQ(loadScene(plain).rig, nullptr);
        std::ifstream stream(plain, std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(stream), {}};
        const auto stored = mFolder.write(isBinary ? "b.glb" : "b.gltf",
                                          loaders::gltfWithDeformers(plain, content, stack));
        Scene scene = loadScene(stored);
        ASSERT_NE(scene.rig, nullptr);
        ASSERT_NE(scene.rig->deformers, nullptr);
        EXPECT_EQ(*scene.rig->deformers, stack);
        const World world = buildWorld(std::move(scene), std::make_shared<subedit::MaterialMap>(),
                                       {}, nullptr, {1.0, std::nullopt});
        Motion motion(world);
        EXPECT_TRUE(motion.moves());
        EXPECT_EQ(motion.durationSeconds(), 1.0);
        const auto topAt = [&](double seconds) {
            return deformedMesh(world, 0, motion.at(seconds)).positions[2];
        };
        EXPECT_EQ(topAt(0.0), glm::dvec3(0, 1, 0));
        EXPECT_EQ(topAt(0.5), glm::dvec3(-0.5, 1, 0)); // from the center line, at x = 0.5
        EXPECT_EQ(topAt(7.0), glm::dvec3(-1, 1, 0));
    }
    // What is there is checked, and what is somebody else's is left alone.
    gltf.json["scenes"][0]["extras"]["celadon"]["deformers"] = {{{"type", "spin"}}};
    EXPECT_THAT(loadtest::refusal(mFolder.write("bad.glb", gltf.glb())), HasSubstr("deformer 0"));
    gltf.json["scenes"][0]["extras"] = "a remark";
    EXPECT_EQ(loadScene(mFolder.write("remark.glb", gltf.glb())).rig, nullptr);
}

} // namespace
} // namespace celadon
