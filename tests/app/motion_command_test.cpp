// Motion as a user asks for it, by running the program.
#include "renderer/output/image_compare.h"
#include "renderer/output/image_io.h"
#include "tests/support/program.h"
#include "tests/support/worlds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace celadon {
namespace {

using test::ProgramResult;
using test::readText;
using test::runProgram;
using test::TemporaryFolder;
using testing::HasSubstr;
using Words = std::vector<std::string>;

/// The same shape from a file and from motion differs in the last bits of its vertices; texels at
/// edges may change sides.
constexpr double kSameShape = 1e-4;

class MotionCommand : public testing::Test {
protected:
    std::string file(const char* name) const { return (folder / name).string(); }

    static Words with(Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    void expectDone(const Words& words) const {
        const ProgramResult result = runProgram(words);
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }

    /// Small, with layers, and with nothing that depends on the rest pose.
    Words render(const std::string& model, const char* output, const Words& more) const {
        return with({"render", model, "-o", file(output), "--size", "96x72", "--samples", "1",
                     "--irradiance-size", "256", "--aov", "--material", "yellow_wax"},
                    more);
    }

    ValueErrors compareExitance(const char* a, const char* b) const {
        return compareValues(extractLayer(readImage(folder / a).image, "exitance"),
                             extractLayer(readImage(folder / b).image, "exitance"));
    }

    void expectUsage(const Words& words, const char* says) const {
        const ProgramResult result = runProgram(words);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr(says));
        EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
    }

    TemporaryFolder folder;
};

TEST_F(MotionCommand, TheDeformedFrameIsThatOfTheMeshWrittenOut) {
    const Words deform{"--deform", "twist:y:60", "--deform", "bend:y:40", "--deform", "inflate:1"};
    const Words view{"--scale",     "1",
                     "--view-from", "60,90,160",
                     "--view-at",   "0,0,0",
                     "--light",     "directional:0.5,-0.3,0.8",
                     "--light",     "directional:-0.3,-0.5,-1"};
    expectDone(
        with({"info", "builtin:vase", "--scale", "1", "--write-mesh", file("posed.obj")}, deform));
    expectDone(render("builtin:vase", "motion.exr",
                      with(with(view, deform), {"--stats", file("stats.json")})));
    expectDone(render(file("posed.obj"), "mesh.exr", view));
    expectDone(render("builtin:vase", "rest.exr", view));
    EXPECT_LT(compareExitance("motion.exr", "mesh.exr").relativeRmse, kSameShape);
    EXPECT_GT(compareExitance("rest.exr", "mesh.exr").relativeRmse, 0.1);
    const auto stats = nlohmann::json::parse(readText(folder / "stats.json"));
    EXPECT_GT(stats["frames"][0]["milliseconds"]["deformation"].get<double>(), 0.0);
}

TEST_F(MotionCommand, FramesOfAnAnimationStandAlone) {
    if (!test::modelFolder()) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const std::string model = (*test::modelFolder() / "gltf/RiggedSimple.glb").string();
    const Words view{"--diameter", "100", "--light", "directional:0.5,-0.3,0.8"};
    const auto at = [&](const char* output, const Words& more) {
        return render(model, output, with(view, more));
    };
    expectDone(at("f_%d.exr", {"--animation", "0", "--frames", "0:4", "--fps", "4"}));
    expectDone(at("late.exr", {"--time", "1"}));
    EXPECT_EQ(compareExitance("f_4.exr", "late.exr").rmse, 0.0);
    EXPECT_GT(compareExitance("f_0.exr", "f_4.exr").relativeRmse, 0.05);
}

TEST_F(MotionCommand, WhatDoesNotExistIsRefused) {
    const auto slab = [&](const Words& more) { return render("builtin:slab", "out.exr", more); };
    expectUsage(slab({"--deform", "spin:y:90"}), "spin:y:90");
    expectUsage(slab({"--deform", "twist:w:90"}), "not an axis");
    expectUsage(slab({"--animation", "0"}), "no animations");
    expectUsage(slab({"--time", "1"}), "no animations");
    expectUsage({"info", "builtin:slab", "--deform", "twist:y:90"}, "--write-mesh");
    expectUsage({"info", "builtin:slab", "--write-mesh", file("a.ply")}, "OBJ");
}

TEST_F(MotionCommand, AnExplosionNamesTheFrameAndTheCause) {
    const ProgramResult result = runProgram(render(
        "builtin:sphere", "out.exr", {"--deform", "twist:y:5", "--deform", "taper:y:1e300"}));
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("frame 0 at 0 s"));
    EXPECT_THAT(result.err, HasSubstr("deformer 2 of 2"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
}

} // namespace
} // namespace celadon
