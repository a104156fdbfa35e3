#include "subedit/document/document.h"
#include "subedit/document/stroke_file.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace celadon::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace subedit;

/// A stroke over two points of the map, an edit of what is like a third, and a propagation.
StrokeFile someStrokes() {
    const auto at = [](float u, float v) { return StrokePoint{{}, {}, glm::vec2(u, v), 1.0f}; };
    StrokeFile file;
    file.surface.flatWidthMm = 60.0f;
    file.commands = {
        StrokeCommand{ScaleAlbedo{{0.5f, 0.9f, 1.1f}},
                      {.radiusMm = 7.0f, .flow = 0.4f},
                      {},
                      {at(0.2f, 0.3f), at(0.7f, 0.4f)}},
        SelectCommand{SelectSimilar{at(0.5f, 0.8f), 0.1f, 0.5f, 30.0f}, SelectMode::Replace},
        ApplyCommand{ScaleRange{{0.8f, 0.8f, 0.8f}}},
        SelectCommand{SelectAll{}, SelectMode::Replace},
        PropagateCommand{Tint{{1.0f, 0.5f, 0.2f}, 0.5f},
                         {{{{.radiusMm = 4.0f}, {}, {at(0.8f, 0.2f)}, 1.0f}}, 0.1f, 20.0f}},
    };
    return file;
}

class MaterialEdit : public ::testing::Test {
protected:
    test::TemporaryFolder folder;

    [[nodiscard]] std::string path(const char* name) const { return (folder / name).string(); }

    void writeStrokes(const StrokeFile& file) const {
        test::writeText(folder / "s.json", strokeFileText(file));
    }
    [[nodiscard]] test::ProgramResult edit(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"material", "edit", "yellow_wax", "--strokes",
                                           path("s.json")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::runInProcess(arguments);
    }
};

TEST_F(MaterialEdit, ReplaysByteForByteWhatWasPainted) {
    const StrokeFile file = someStrokes();
    writeStrokes(file);
    // As the editor does it: point by point, with a change of mind on the way.
    const MaterialMap material = readMaterial(findMaterial("yellow_wax"));
    Document document(material, std::make_shared<Surface>(makeFlatSurface(
                                    material.width, material.height, file.surface.flatWidthMm)));
    StrokeCommand stroke = std::get<StrokeCommand>(file.commands[0]);
    const std::vector<StrokePoint> points = std::exchange(stroke.path, {});
    document.beginStroke(stroke);
    for (const StrokePoint& point : points) {
        document.addStrokePoint(point);
    }
    document.endStroke();
    document.execute(ApplyCommand{SetAlbedo{glm::vec3(0.1f)}});
    ASSERT_TRUE(document.undo());
    for (std::size_t i = 1; i < file.commands.size(); ++i) {
        document.execute(file.commands[i]);
    }
    EXPECT_EQ(document.commands(), file.commands);
    writeMaterial(document.material(), folder / "painted.subedit.exr");

    for (const char* name : {"a.subedit.exr", "b.subedit.exr"}) {
        const test::ProgramResult result = edit({"-o", path(name)});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(test::readText(folder / name), test::readText(folder / "painted.subedit.exr"));
    }
}

TEST_F(MaterialEdit, PaintsOnModels) {
    StrokeFile file = someStrokes();
    file.surface.model = "builtin:vase";
    writeStrokes(file);
    const test::ProgramResult none = edit({"-o", path("a.subedit.exr")});
    EXPECT_EQ(none.exitCode, 2);
    EXPECT_THAT(none.err, AllOf(HasSubstr("builtin:vase"), HasSubstr("--model")));
    const test::ProgramResult result =
        edit({"--model", "builtin:vase", "--float", "--json", "-o", path("a.subedit.exr")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("scale-albedo stroke"), HasSubstr("\"texels\"")));
    EXPECT_NE(readMaterial(folder / "a.subedit.exr").logProfile,
              readMaterial(findMaterial("yellow_wax")).logProfile);
}

TEST_F(MaterialEdit, EnlargesAMaterialThatIsTooCoarseToPaintOn) {
    StrokeFile file = someStrokes();
    file.surface.texels = glm::ivec2(40, 30);
    writeStrokes(file);
    ASSERT_EQ(edit({"-o", path("a.subedit.exr")}).exitCode, 0);
    const MaterialMap painted = readMaterial(folder / "a.subedit.exr");
    EXPECT_EQ(painted.width, 40);
    EXPECT_EQ(painted.height, 30);
    ASSERT_EQ(edit({"--size", "64", "-o", path("b.subedit.exr")}).exitCode, 0);
    EXPECT_EQ(readMaterial(folder / "b.subedit.exr").height, 64);
}

TEST_F(MaterialEdit, SaysWhatItClamped) {
    StrokeFile file;
    file.commands = {ApplyCommand{ScaleAlbedo{glm::vec3(3.0f)}}};
    writeStrokes(file);
    const test::ProgramResult result = edit({"-o", path("a.subedit.exr")});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_THAT(result.err, AllOf(HasSubstr("/commands/0"), HasSubstr("albedo above 1")));
}

TEST_F(MaterialEdit, RefusesBadInput) {
    const auto expectRefused = [&](const std::string& text, int exitCode, auto matcher) {
        test::writeText(folder / "s.json", text);
        const test::ProgramResult result = edit({"-o", path("never.subedit.exr")});
        EXPECT_EQ(result.exitCode, exitCode) << text;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, matcher);
        EXPECT_FALSE(std::filesystem::exists(folder / "never.subedit.exr"));
    };
    const auto commands = [](const std::string& list) {
        return R"({"format": "celadon-strokes", "version": 1, "commands": [)" + list + "]}";
    };
    expectRefused(commands(R"({"command": "apply", "operator": {"name": "shine"}})"), 3,
                  AllOf(HasSubstr("/commands/0/operator/name"), HasSubstr("shine")));
    expectRefused(commands(R"({"command": "apply", "operator":
                               {"name": "set-albedo", "albedo": [2, 0, 0]}})"),
                  3, HasSubstr("/commands/0/operator/albedo/0"));
    expectRefused(commands(R"({"command": "apply", "operator":
                               {"name": "mix", "profile": {"material": "nacre"}}})"),
                  3, HasSubstr("nacre"));
    // Known only once the surface is there.
    expectRefused(commands(R"({"command": "select", "step": "similar", "tolerance": 0.1,
                               "point": {"positionMm": [1, 2, 300]}})"),
                  3, AllOf(HasSubstr("/commands/0"), HasSubstr("not on the surface")));
    const test::ProgramResult noStrokes =
        test::runInProcess({"material", "edit", "yellow_wax", "-o", path("x.subedit.exr")});
    EXPECT_EQ(noStrokes.exitCode, 2);
    const test::ProgramResult absent =
        test::runInProcess({"material", "edit", "yellow_wax", "--strokes", path("absent.json"),
                            "-o", path("x.subedit.exr")});
    EXPECT_EQ(absent.exitCode, 3);
    EXPECT_THAT(absent.err, HasSubstr("no such file"));
    const test::ProgramResult noOutput = edit({});
    EXPECT_EQ(noOutput.exitCode, 2);
    EXPECT_THAT(noOutput.err, HasSubstr("-o"));
}

} // namespace
} // namespace celadon::app
