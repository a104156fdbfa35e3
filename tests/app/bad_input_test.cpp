// What goes wrong for a user of `celadon render`, by running the program: the exit code, one line
// that says what and why, and no trace of an output. An earlier output stays as it was.
#include "renderer/output/image_io.h"
#include "tests/support/images.h"
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace celadon {
namespace {

using test::ProgramResult;
using test::readText;
using test::runProgram;
using test::TemporaryFolder;
using test::uniformImage;
using test::writeText;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Words = std::vector<std::string>;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr const char* kEarlier = "an earlier picture";

class BadInput : public testing::Test {
protected:
    std::string file(const char* name) const { return (folder / name).string(); }

    std::string textFile(const char* name, std::string_view text) const {
        writeText(folder / name, text);
        return file(name);
    }

    /// A render of the least size.
    static ProgramResult render(const Words& more) {
        Words words{"render", "--size",    "64x48", "--irradiance-size", "64", "--levels",
                    "3,2",    "--samples", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return runProgram(words);
    }

    void expectOneLine(const ProgramResult& result, int code,
                       const testing::Matcher<std::string>& says) const {
        EXPECT_EQ(result.exitCode, code) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, AllOf(StartsWith("celadon: "), says));
    }

    /// Twice: where there was no output, and where an earlier one is.
    void expectRefused(const Words& more, int code,
                       const testing::Matcher<std::string>& says) const {
        const std::size_t before = folder.entryCount();
        Words words = more;
        words.insert(words.end(), {"-o", file("out.png")});
        expectOneLine(render(words), code, says);
        EXPECT_EQ(folder.entryCount(), before);

        writeText(folder / "out.png", kEarlier);
        expectOneLine(render(words), code, says);
        EXPECT_EQ(folder.entryCount(), before + 1);
        EXPECT_EQ(readText(folder / "out.png"), kEarlier);
        std::filesystem::remove(folder / "out.png");
    }

    TemporaryFolder folder;
};

TEST_F(BadInput, ModelsThatCannotBeRead) {
    expectRefused({file("absent.obj")}, 3, HasSubstr("absent.obj"));
    expectRefused({folder.path().string()}, 3, HasSubstr(folder.path().string()));
    expectRefused({textFile("model.blend", "x")}, 3, HasSubstr("model.blend"));
    expectRefused({textFile("empty.obj", "")}, 3, HasSubstr("empty.obj"));
    expectRefused({textFile("cut.glb", std::string_view("glTF\2\0\0\0\377\0\0\0", 12))}, 3,
                  HasSubstr("cut.glb"));
    expectRefused({textFile("cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                       "property float y\nproperty float z\nelement face 1\n"
                                       "property list uchar int vertex_indices\nend_header\n"
                                       "0 0 0\n1 0 0\n")},
                  3, HasSubstr("cut.ply"));
    expectRefused({"builtin:teapot"}, 2, AllOf(HasSubstr("teapot"), HasSubstr("vase")));
}

TEST_F(BadInput, ModelsThatAreNoSurface) {
    expectRefused({textFile("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")}, 3,
                  HasSubstr("nan.obj"));
    expectRefused({textFile("inf.obj", "v 0 0 0\nv 1e99 0 0\nv 0 1 0\nf 1 2 3\n")}, 3,
                  HasSubstr("inf.obj"));
    expectRefused({textFile("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")}, 3,
                  HasSubstr("points.obj"));
    expectRefused({textFile("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")}, 3,
                  HasSubstr("index.obj"));
    expectRefused({textFile("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n")}, 3,
                  HasSubstr("point.obj"));
}

TEST_F(BadInput, GltfThatNeedsDraco) {
    const char* models = std::getenv("CELADON_MODELS");
    if (models == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const std::string model = std::string(models) + "/gltf/Box_draco.glb";
    expectRefused({model}, 3, AllOf(HasSubstr("Box_draco.glb"), HasSubstr("draco")));
}

TEST_F(BadInput, Materials) {
    expectRefused({"builtin:slab", "--material", "nacre"}, 3,
                  AllOf(HasSubstr("'nacre'"), HasSubstr("yellow_wax")));
    expectRefused({"builtin:slab", "--material", file("absent.subedit.exr")}, 3,
                  HasSubstr("absent.subedit.exr"));
    const std::string whole =
        readText(std::filesystem::path(CELADON_SOURCE_DIR) / "materials/jade.subedit.exr");
    ASSERT_GT(whole.size(), 1000u);
    textFile("cut.subedit.exr", std::string_view(whole).substr(0, whole.size() / 2));
    expectRefused({"builtin:slab", "--material", file("cut.subedit.exr")}, 3,
                  HasSubstr("cut.subedit.exr"));
    writeExr(folder / "picture.exr", uniformImage(4, 4, {"R", "G", "B"}, {1, 1, 1}));
    expectRefused({"builtin:slab", "--material", file("picture.exr")}, 3, HasSubstr("subedit:"));
}

TEST_F(BadInput, Environments) {
    FloatImage map = uniformImage(8, 4, {"R", "G", "B"}, {1, 1, 1});
    map.at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    writeExr(folder / "sky.exr", map);
    expectRefused({"builtin:slab", "--environment", file("sky.exr")}, 3, HasSubstr("sky.exr"));
    expectRefused({"builtin:slab", "--environment", textFile("sky.hdr", "#?RADIANCE\n")}, 3,
                  HasSubstr("sky.hdr"));
}

TEST_F(BadInput, CommandLines) {
    expectRefused({"builtin:slab", "--exposrue", "1"}, 2, HasSubstr("did you mean '--exposure'?"));
    expectRefused({"builtin:slab", "--light", "directional:0,0,0"}, 2, HasSubstr("directional"));
    expectRefused({"builtin:slab", "--light", "point:1,2"}, 2, HasSubstr("point:1,2"));
    expectRefused({"builtin:slab", "--scale", "1", "--diameter", "1"}, 2, HasSubstr("--diameter"));
    expectRefused({"builtin:slab", "--size", "0x48"}, 2, HasSubstr("--size"));
}

TEST_F(BadInput, Outputs) {
    expectOneLine(render({"builtin:slab", "-o", file("absent/a.png")}), 1,
                  HasSubstr("does not exist"));
    expectOneLine(render({"builtin:slab", "-o", file("a.webm")}), 2, HasSubstr("a.webm"));
    std::filesystem::create_directory(folder / "folder.png");
    expectOneLine(render({"builtin:slab", "-o", file("folder.png")}), 1, HasSubstr("folder.png"));
    expectOneLine(render({"builtin:slab", "-o", file("a.png"), "--stats", file("absent/a.json")}),
                  1, HasSubstr("a.json"));
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST_F(BadInput, OutputsThatAreOtherFiles) {
    const auto isSame = [](const char* name) {
        return HasSubstr("is the same file as " + std::string(name));
    };
    const std::string model = textFile("m.obj", kTriangle);
    const std::string sky = file("sky.exr");
    writeExr(sky, uniformImage(8, 4, {"R", "G", "B"}, {1, 1, 1}));
    std::filesystem::copy_file(std::filesystem::path(CELADON_SOURCE_DIR) /
                                   "materials/jade.subedit.exr",
                               folder / "m_1.subedit.exr");
    std::filesystem::create_symlink("m_1.subedit.exr", folder / "link.exr");
    const std::string bytes = readText(folder / "m_1.subedit.exr");
    const std::size_t before = folder.entryCount();

    expectOneLine(render({model, "-o", file("a.png"), "--stats", (folder / "./a.png").string()}), 2,
                  isSame("--output"));
    expectOneLine(render({model, "-o", file("a.png"), "--stats", model}), 2, isSame("MODEL"));
    expectOneLine(render({model, "--environment", sky, "-o", sky}), 2, isSame("--environment"));
    expectOneLine(render({model, "--material", file("m_1.subedit.exr"), "-o", file("link.exr")}), 2,
                  isSame("--material"));
    const std::string pattern = file("m_%d.subedit.exr");
    expectOneLine(
        render({model, "--frames", "1:2", "--material", file("m_1.subedit.exr"), "-o", pattern}), 2,
        isSame("--material"));
    EXPECT_EQ(readText(folder / "m.obj"), kTriangle);
    EXPECT_EQ(readText(folder / "m_1.subedit.exr"), bytes);
    EXPECT_EQ(folder.entryCount(), before);
}

TEST_F(BadInput, OptionsOfTheOtherSchemeAreSaidToHaveNoEffect) {
    expectOneLine(render({"builtin:slab", "--alpha", "3", "--no-orientation", "-o", file("a.png")}),
                  0, HasSubstr("--alpha, --no-orientation: of no effect without --scheme paper"));
}

TEST_F(BadInput, ASheetIsLitWhereNoLightIsGiven) {
    const ProgramResult result =
        render({textFile("sheet.obj", kTriangle), "-o", file("sheet.exr")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.err, testing::Not(HasSubstr("no light")));
}

TEST_F(BadInput, NoDisplayForAWindow) {
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    expectRefused({"builtin:slab", "--context", "glfw"}, 4, HasSubstr("DISPLAY"));
}

TEST_F(BadInput, BlackPicturesAreExplained) {
    const auto explained = [&](const Words& more, const char* says) {
        Words words{"builtin:slab", "-o", file("black.png")};
        words.insert(words.end(), more.begin(), more.end());
        expectOneLine(render(words), 0, HasSubstr(says)); // a warning: the picture is as asked for
        EXPECT_TRUE(std::filesystem::remove(folder / "black.png"));
    };
    explained({"--light", "directional:0,0,-1:0,0,0"}, "no light reaches");
    explained({"--view-from", "0,0,500", "--view-at", "0,0,1000"}, "outside the view");
}

TEST_F(BadInput, SequencesStopAtTheFirstMissingModel) {
    textFile("m_0001.obj", kTriangle);
    textFile("m_0002.obj", kTriangle);
    const Words sequence{"--sequence",  file("m_%04d.obj"),   "-o",         file("o_%04d.png"),
                         "--view-from", "0.3,0.3,3",          "--view-at",  "0.3,0.3,0",
                         "--light",     "directional:0,0,-1", "--material", "marble",
                         "--frames"};
    const auto renderFrames = [&](const char* frames) {
        Words words = sequence;
        words.emplace_back(frames);
        return render(words);
    };
    const ProgramResult done = renderFrames("1:2");
    EXPECT_EQ(done.exitCode, 0) << done.err;
    EXPECT_EQ(readText(folder / "o_0001.png"), readText(folder / "o_0002.png"));
    EXPECT_EQ(folder.entryCount(), 4u);

    const ProgramResult missing = renderFrames("2:3");
    EXPECT_EQ(missing.exitCode, 3);
    EXPECT_THAT(missing.err, HasSubstr("m_0003.obj"));
    EXPECT_EQ(folder.entryCount(), 4u); // frame 2 again, nothing of frame 3
    expectRefused({"--sequence", file("m_%04d.obj")}, 2, HasSubstr("--frames"));
    expectRefused({"--sequence", file("m.obj"), "--frames", "1:2"}, 2, HasSubstr("--sequence"));
}

TEST_F(BadInput, ATableThatIsNone) {
    expectRefused({"builtin:slab", "--table", textFile("t.csv", "T,minimalRadius\n1,2\n")}, 3,
                  AllOf(HasSubstr("t.csv"), HasSubstr("[0, 1]")));
    expectRefused({"builtin:slab", "--table", file("absent.csv")}, 3, HasSubstr("no such file"));
}

} // namespace
} // namespace celadon
