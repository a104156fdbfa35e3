// Motion as a user asks for it, by running the program.
#include "renderer/output/image_compare.h"
#include "renderer/output/image_io.h"
#include "tests/support/program.h"
#include "tests/support/worlds.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace celadon {
namespace {

using test::ProgramResult;
using test::readText;
using test::runProgram;
using test::TemporaryFolder;
using test::writeText;
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
    expectDone(at("first_%d.exr", {"--frames", "4", "--fps", "4"})); // plays it unasked, as --time
    EXPECT_EQ(compareExitance("first_4.exr", "late.exr").rmse, 0.0);
    EXPECT_GT(compareExitance("f_0.exr", "f_4.exr").relativeRmse, 0.05);
}

/// Lattice, handles and keys at once, on the vase (1 mm per unit, some 100 mm high).
constexpr const char* kStack = R"({"deformers": [
  {"type": "twist", "axis": "y", "range": [0.2, 0.9],
   "angleDegrees": {"times": [0, 1], "values": [0, 80], "interpolation": "linear"}},
  {"type": "lattice", "size": [3, 3, 3], "moves": [{"point": [2, 1, 1], "by": [15, 5, 0]}]},
  {"type": "handles", "handles": [
    {"at": [0, -50, 0], "radius": 15},
    {"at": [0, 50, 0], "radius": 15, "move": [20, -5, 0], "turnDegrees": [0, 0, -20]}]}
]})";

TEST_F(MotionCommand, AFileOfDeformersMovesTheFrameAndTheMeshAlike) {
    writeText(folder / "stack.json", kStack);
    const Words deform{"--deform", file("stack.json")};
    const Words view{"--scale",     "1",
                     "--view-from", "60,90,160",
                     "--view-at",   "0,0,0",
                     "--light",     "directional:0.5,-0.3,0.8",
                     "--light",     "directional:-0.3,-0.5,-1"};
    expectDone(with({"info", "builtin:vase", "--scale", "1", "--time", "0.5", "--write-mesh",
                     file("posed.obj")},
                    deform));
    expectDone(render("builtin:vase", "f_%d.exr",
                      with(with(view, deform), {"--frames", "0:2", "--fps", "4"})));
    expectDone(render(file("posed.obj"), "mesh.exr", view));
    EXPECT_LT(compareExitance("f_2.exr", "mesh.exr").relativeRmse, kSameShape);
    EXPECT_GT(compareExitance("f_0.exr", "f_2.exr").relativeRmse, 0.05); // the key is at work
}

TEST_F(MotionCommand, DeformersTravelInTheGltf) {
    if (!test::modelFolder()) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const std::string model = (*test::modelFolder() / "gltf/RiggedSimple.glb").string();
    const Words light{"--diameter", "100", "--light", "directional:0.5,-0.3,0.8"};
    const Words bend{"--deform", "bend:y:70"};
    expectDone(with({"info", model, "--write-gltf", file("bent.glb")}, bend));
    expectDone(render(model, "given.exr", with(light, bend)));
    expectDone(render(file("bent.glb"), "stored.exr", light));
    expectDone(render(file("bent.glb"), "without.exr", with(light, {"--deform", "none"})));
    expectDone(render(model, "plain.exr", light));
    EXPECT_EQ(compareExitance("given.exr", "stored.exr").rmse, 0.0);
    EXPECT_EQ(compareExitance("plain.exr", "without.exr").rmse, 0.0);
    EXPECT_GT(compareExitance("plain.exr", "stored.exr").relativeRmse, 0.05);
    const ProgramResult told = runProgram({"info", file("bent.glb")});
    EXPECT_THAT(told.out, HasSubstr("deformer 0: bend"));
    expectUsage({"info", model, "--write-gltf", file("bent.glb")}, "--deform");
    expectUsage(with({"info", "builtin:vase", "--write-gltf", file("bent.glb")}, bend), ".glb");
}

TEST_F(MotionCommand, OneMaterialFadesIntoAnother) {
    const Words light{"--light", "directional:0.5,-0.3,0.8"};
    const auto slab = [&](const char* output, const Words& more) {
        return with({"render", "builtin:sphere", "-o", file(output), "--size", "48x48", "--samples",
                     "1", "--irradiance-size", "128", "--aov"},
                    with(light, more));
    };
    expectDone(slab("fade_%d.exr", {"--material", "marble", "--material-to", "yellow_wax",
                                    "--frames", "0:4", "--fade-frames", "1:3"}));
    expectDone(slab("marble.exr", {"--material", "marble"}));
    expectDone(slab("wax.exr", {"--material", "yellow_wax"}));
    EXPECT_EQ(compareExitance("fade_0.exr", "marble.exr").rmse, 0.0);
    EXPECT_EQ(compareExitance("fade_1.exr", "marble.exr").rmse, 0.0);
    EXPECT_EQ(compareExitance("fade_3.exr", "wax.exr").rmse, 0.0);
    EXPECT_EQ(compareExitance("fade_4.exr", "wax.exr").rmse, 0.0);
    EXPECT_GT(compareExitance("fade_2.exr", "wax.exr").relativeRmse, 0.01);
    EXPECT_GT(compareExitance("fade_2.exr", "marble.exr").relativeRmse, 0.01);
    expectUsage(slab("out.exr", {"--material-to", "marble"}), "--material-to");
    expectUsage(slab("out.exr", {"--material", "marble", "--fade-frames", "0:2"}), "--fade-frames");
}

TEST_F(MotionCommand, WhatDoesNotExistIsRefused) {
    const auto slab = [&](const Words& more) { return render("builtin:slab", "out.exr", more); };
    expectUsage(slab({"--deform", "spin:y:90"}), "spin:y:90");
    expectUsage(slab({"--deform", "twist:w:90"}), "not an axis");
    expectUsage(slab({"--animation", "0"}), "no animations");
    expectUsage(slab({"--time", "1"}), "no animations");
    expectUsage(slab({"--deform", "none", "--deform", "twist:y:9"}), "none");
    expectUsage({"info", "builtin:slab", "--deform", "twist:y:90"}, "--write-mesh");
    expectUsage({"info", "builtin:slab", "--write-mesh", file("a.ply")}, "OBJ");
}

// A lattice that flattens everything half way: said with its frame, and what was done stays.
TEST_F(MotionCommand, ADegenerateLatticeNamesItsFrame) {
    std::string moves;
    for (int i = 0; i < 8; ++i) { // into the plane y = 0 at one second
        moves +=
            fmt::format(R"({}{{"point": [{}, {}, {}], "by": {{"times": [0, 1],
                                "values": [[0, 0, 0], [0, {}, 0]]}}}})",
                        i == 0 ? "" : ", ", i % 2, i / 2 % 2, i / 4, i / 2 % 2 == 1 ? -10 : 10);
    }
    writeText(folder / "flat.json",
              R"({"deformers": [{"type": "lattice", "size": [2, 2, 2], "moves": [)" + moves +
                  "]}]}");
    const ProgramResult result =
        runProgram(render("builtin:slab", "out_%d.exr",
                          {"--deform", file("flat.json"), "--frames", "0:1", "--fps", "1"}));
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_THAT(result.err, HasSubstr("frame 1 at 1 s"));
    EXPECT_THAT(result.err, HasSubstr("lattice"));
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
