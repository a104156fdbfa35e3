#include "renderer/scene/animation.h"
#include "renderer/scene/motion.h"
#include "tests/renderer/scene/load_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace celadon {
namespace {

using loadtest::GltfBuilder;
using testing::HasSubstr;

AnimationChannel scalarChannel(Interpolation interpolation, std::vector<double> times,
                               std::vector<double> values) {
    AnimationChannel channel;
    channel.value = AnimatedValue::Weights;
    channel.interpolation = interpolation;
    channel.times = std::move(times);
    channel.values = std::move(values);
    channel.components = 1;
    return channel;
}

double sample(const AnimationChannel& channel, double seconds) {
    double value = 0.0;
    sampleChannel(channel, seconds, std::span(&value, 1));
    return value;
}

TEST(SampleChannel, HoldsItsEndsAndStepsOrRunsStraightBetween) {
    const auto step = scalarChannel(Interpolation::Step, {1, 2, 4}, {10, 20, 30});
    EXPECT_EQ(sample(step, 0.0), 10);
    EXPECT_EQ(sample(step, 1.999), 10);
    EXPECT_EQ(sample(step, 2.0), 20);
    EXPECT_EQ(sample(step, 9.0), 30);
    const auto linear = scalarChannel(Interpolation::Linear, {1, 2, 4}, {10, 20, 30});
    EXPECT_EQ(sample(linear, 0.0), 10);
    EXPECT_DOUBLE_EQ(sample(linear, 2.5), 22.5);
    EXPECT_EQ(sample(linear, 5.0), 30);
}

TEST(SampleChannel, TheLastOfSeveralKeysAtOneTimeCounts) {
    const auto channel = scalarChannel(Interpolation::Linear, {0, 1, 1, 2}, {0, 5, 7, 9});
    EXPECT_EQ(sample(channel, 1.0), 7);
    EXPECT_DOUBLE_EQ(sample(channel, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(sample(channel, 1.5), 8);
}

TEST(SampleChannel, CubicSplinesReproduceCubics) {
    const auto p = [](double t) { return 2.0 - t + 0.5 * t * t - 0.75 * t * t * t; };
    const auto slope = [](double t) { return -1.0 + t - 2.25 * t * t; };
    std::vector<double> values;
    const std::vector<double> times{0.5, 1.25, 3.0};
    for (const double t : times) {
        values.insert(values.end(), {slope(t), p(t), slope(t)});
    }
    const auto channel = scalarChannel(Interpolation::CubicSpline, times, values);
    for (double t = 0.5; t <= 3.0; t += 0.125) {
        EXPECT_NEAR(sample(channel, t), p(t), 1e-12) << t;
    }
    EXPECT_EQ(sample(channel, 0.0), p(0.5));
    EXPECT_EQ(sample(channel, 4.0), p(3.0));
}

TEST(SampleChannel, RotationsTurnTheShortWayAtConstantSpeed) {
    AnimationChannel channel;
    channel.value = AnimatedValue::Rotation;
    channel.components = 4;
    channel.times = {0, 1};
    const double angle = std::numbers::pi / 2.0;
    channel.values = {0, 0, 0, 1, 0, 0, -std::sin(angle / 2), -std::cos(angle / 2)}; // -q, not q
    double q[4];
    for (const double t : {0.25, 0.5, 0.75}) {
        sampleChannel(channel, t, q);
        EXPECT_NEAR(2.0 * std::atan2(std::abs(q[2]), std::abs(q[3])), t * angle, 1e-12);
    }
}

/// A triangle that an animation moves; damage the JSON at will.
class AnimatedGltf : public testing::Test {
protected:
    AnimatedGltf() {
        mGltf.addTriangle();
        mGltf.primitive()["attributes"]["TEXCOORD_0"] =
            mGltf.addFloats({0, 0, 1, 0, 0, 1}, "VEC2"); // an atlas takes its time
        mTimes = mGltf.addFloats({0, 1, 2}, "SCALAR");
        mValues = mGltf.addFloats({0, 0, 0, 1, 0, 0, 1, 5, 0}, "VEC3");
        mGltf.json["animations"] = {
            {{"name", "slide"},
             {"samplers", {{{"input", mTimes}, {"output", mValues}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    }

    Scene load() { return loadScene(mFolder.write("a.glb", mGltf.glb())); }
    std::string refusal() { return loadtest::refusal(mFolder.write("a.glb", mGltf.glb())); }
    nlohmann::json& animation() { return mGltf.json["animations"][0]; }

    World world() {
        return buildWorld(load(), std::make_shared<subedit::MaterialMap>(), {}, nullptr,
                          {1.0, std::nullopt});
    }

    loadtest::TemporaryFolder mFolder;
    GltfBuilder mGltf;
    int mTimes = 0;
    int mValues = 0;
};

TEST_F(AnimatedGltf, NodesMoveAndTheAnimationStartsOver) {
    const World rest = world();
    Motion motion(rest);
    ASSERT_EQ(motion.animations().size(), 1u);
    EXPECT_EQ(motion.animations()[0].name, "slide");
    EXPECT_EQ(motion.animations()[0].durationSeconds, 2.0);
    EXPECT_FALSE(motion.moves());
    motion.selectAnimation(findAnimation(rest.rig.get(), "slide"));
    const auto originAt = [&](double seconds) {
        const DeformedMesh mesh = deformedMesh(rest, 0, motion.at(seconds));
        return mesh.positions[0];
    };
    EXPECT_EQ(originAt(0.5), glm::dvec3(0.5, 0, 0));
    EXPECT_EQ(originAt(1.5), glm::dvec3(1, 2.5, 0));
    EXPECT_EQ(originAt(2.0), glm::dvec3(1, 5, 0)); // the end itself is shown
    EXPECT_EQ(originAt(2.5), glm::dvec3(0.5, 0, 0));
}

TEST_F(AnimatedGltf, MirroringTurnsTrianglesOver) {
    const int scales = mGltf.addFloats({1, 1, 1, -1, 1, 1, -1, 1, 1}, "VEC3");
    animation()["samplers"][0]["output"] = scales;
    animation()["samplers"][0]["interpolation"] = "STEP";
    animation()["channels"][0]["target"]["path"] = "scale";
    const World rest = world();
    Motion motion(rest);
    motion.selectAnimation(0);
    const World mirrored = posedWorld(rest, motion.at(1.0));
    const Mesh& mesh = mirrored.meshes[0].mesh;
    const glm::vec3 a = mesh.positions[mesh.indices[0]];
    const glm::vec3 face =
        glm::cross(mesh.positions[mesh.indices[1]] - a, mesh.positions[mesh.indices[2]] - a);
    EXPECT_GT(face.z, 0.0f);
    EXPECT_GT(mesh.normals[0].z, 0.0f);
}

TEST_F(AnimatedGltf, MorphWeightsAreAnimatedAndSparseTargetsMoveTheirVerticesOnly) {
    const int indices = mGltf.addView(loadtest::bytesOf(std::vector<std::uint16_t>{1}));
    const int values = mGltf.addView(loadtest::bytesOf(std::vector<float>{0, 0, 4}));
    nlohmann::json change{{"type", "VEC3"}, {"componentType", 5126}, {"count", 3}};
    change["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                        {"values", {{"bufferView", values}}}};
    mGltf.json["accessors"].push_back(change);
    mGltf.primitive()["targets"] = {{{"POSITION", mGltf.json["accessors"].size() - 1}}};
    animation()["samplers"][0]["output"] = mGltf.addFloats({0, 1, 0.5f}, "SCALAR");
    animation()["channels"][0]["target"]["path"] = "weights";
    const World rest = world();
    Motion motion(rest);
    motion.selectAnimation(0);
    const DeformedMesh mesh = deformedMesh(rest, 0, motion.at(0.5));
    EXPECT_EQ(mesh.positions[0], glm::dvec3(0, 0, 0));
    EXPECT_EQ(mesh.positions[1], glm::dvec3(1, 0, 2));
    EXPECT_EQ(mesh.positions[2], glm::dvec3(0, 1, 0));
}

TEST_F(AnimatedGltf, AnimationsAreFoundByNameOrNumber) {
    const Scene scene = load();
    EXPECT_EQ(findAnimation(scene.rig.get(), "0"), 0u);
    EXPECT_EQ(findAnimation(scene.rig.get(), "slide"), 0u);
    EXPECT_THROW((void)findAnimation(scene.rig.get(), "1"), UsageError);
    EXPECT_THROW((void)findAnimation(scene.rig.get(), "run"), UsageError);
    EXPECT_THROW((void)findAnimation(nullptr, "0"), UsageError);
}

TEST_F(AnimatedGltf, BadKeysAreRefusedWithTheirPlace) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    animation()["samplers"][0]["input"] = mGltf.addFloats({0, nan, 2}, "SCALAR");
    EXPECT_THAT(refusal(), HasSubstr("the time of key 1 is not finite"));
    animation()["samplers"][0]["input"] = mGltf.addFloats({0, 2, 1}, "SCALAR");
    const std::string message = refusal();
    EXPECT_THAT(message, HasSubstr("animation 0 'slide', channel 0"));
    EXPECT_THAT(message, HasSubstr("keys 1 and 2 are out of order"));
    animation()["samplers"][0]["input"] = mGltf.addFloats({0, 1}, "SCALAR");
    EXPECT_THAT(refusal(), HasSubstr("2 keys need 3 numbers each"));
    animation()["samplers"][0]["input"] = mTimes;
    animation()["samplers"][0]["output"] = mGltf.addFloats({0, 0, 0, nan, 0, 0, 0, 0, 0}, "VEC3");
    EXPECT_THAT(refusal(), HasSubstr("is not finite"));
    animation()["samplers"][0]["output"] = mTimes;
    EXPECT_THAT(refusal(), HasSubstr("another type"));
}

TEST_F(AnimatedGltf, BadChannelsAreRefused) {
    const nlohmann::json good = animation();
    animation()["samplers"][0]["interpolation"] = "SINE";
    EXPECT_THAT(refusal(), HasSubstr("'SINE' is unknown"));
    animation() = good;
    animation()["channels"][0]["sampler"] = 1;
    EXPECT_THAT(refusal(), HasSubstr("sampler"));
    animation() = good;
    animation()["channels"][0]["target"]["node"] = 7;
    EXPECT_THAT(refusal(), HasSubstr("node"));
    animation() = good;
    animation()["channels"].push_back(good["channels"][0]);
    EXPECT_THAT(refusal(), HasSubstr("animated twice"));
    animation() = good;
    mGltf.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_THAT(refusal(), HasSubstr("has a matrix"));
}

TEST_F(AnimatedGltf, WeightsThatDoNotSumToOneAreScaledWithAWarning) {
    mGltf.primitive()["attributes"]["JOINTS_0"] = mGltf.addAccessor(
        mGltf.addView(loadtest::bytesOf(std::vector<std::uint8_t>(12, 0))), "VEC4", 5121, 3);
    mGltf.primitive()["attributes"]["WEIGHTS_0"] =
        mGltf.addFloats({2, 0, 0, 0, 0.5f, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    mGltf.json["skins"] = {{{"joints", {0}}}};
    mGltf.json["nodes"][0]["skin"] = 0;
    const Scene scene = load();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("the joint weights of 2 vert"));
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, 0, 0));
}

TEST_F(AnimatedGltf, SkinsWithMissingJointsAreRefused) {
    const auto joints = [&](std::uint8_t last) {
        std::vector<std::uint8_t> indices(12, 0);
        indices[8] = last;
        return mGltf.addAccessor(mGltf.addView(loadtest::bytesOf(indices)), "VEC4", 5121, 3);
    };
    mGltf.primitive()["attributes"]["WEIGHTS_0"] =
        mGltf.addFloats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    mGltf.primitive()["attributes"]["JOINTS_0"] = joints(2);
    mGltf.json["nodes"][0]["skin"] = 0;
    EXPECT_THAT(refusal(), HasSubstr("'skin' is 0")); // there is none at all
    mGltf.json["skins"] = {{{"joints", {0, 9}}}};
    EXPECT_THAT(refusal(), HasSubstr("'joints' holds 9"));
    mGltf.json["skins"] = {{{"joints", {0}}}};
    EXPECT_THAT(refusal(), HasSubstr("joint 2 of vertex 2 is past"));
    mGltf.primitive()["attributes"]["JOINTS_0"] = joints(0);
    EXPECT_NO_THROW((void)load());
}

// Two sets of four influences; the second one holds what counts.
TEST_F(AnimatedGltf, EightInfluencesAreBlended) {
    const int joints = mGltf.addAccessor(
        mGltf.addView(loadtest::bytesOf(std::vector<std::uint8_t>(12, 0))), "VEC4", 5121, 3);
    mGltf.json["nodes"].push_back({{"translation", {0, 0, 8}}});
    mGltf.json["scenes"][0]["nodes"].push_back(1);
    const int others = mGltf.addAccessor(
        mGltf.addView(loadtest::bytesOf(std::vector<std::uint8_t>(12, 1))), "VEC4", 5121, 3);
    nlohmann::json& attributes = mGltf.primitive()["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["JOINTS_1"] = others;
    attributes["WEIGHTS_0"] = mGltf.addFloats({0.5f, 0.25f, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] =
        mGltf.addFloats({0.125f, 0.125f, 0, 0, 0, 0, 0, 0, 0.25f, 0.25f, 0.25f, 0.25f}, "VEC4");
    mGltf.json["skins"] = {{{"joints", {0, 1}}}}; // inverse bind matrices absent: identities
    mGltf.json["nodes"][0]["skin"] = 0;
    const Scene scene = load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.meshes[0].positions[0], glm::vec3(0, 0, 2));
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(0, 1, 8));
}

TEST_F(AnimatedGltf, AnExplosionNamesMeshAndCause) {
    animation()["samplers"][0]["output"] = mGltf.addFloats({0, 0, 0, 3e38f, 0, 0, 0, 0, 0}, "VEC3");
    const World rest = world();
    Motion motion(rest);
    motion.selectAnimation(0);
    try {
        (void)posedWorld(rest, motion.at(1.0));
        ADD_FAILURE() << "was posed";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the animation takes it beyond all numbers"));
    }
    EXPECT_NO_THROW((void)posedWorld(rest, motion.at(0.0)));
}

} // namespace
} // namespace celadon
