#include "renderer/scene/load_scene.h"
#include "renderer/scene/world.h"
#include "subedit/map/material_map.h"
#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace celadon {
namespace {

using test::ProgramResult;
using test::readText;
using test::runInProcess;
using test::runProgram;
using test::TemporaryFolder;
using test::writeText;
using testing::HasSubstr;

/// A cube of side 2 without texture coordinates.
constexpr const char* kCube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
                              "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                              "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

class InfoCommand : public testing::Test {
protected:
    std::string file(const char* name) const { return (folder / name).string(); }
    std::string cube() const {
        writeText(folder / "cube.obj", kCube);
        return file("cube.obj");
    }
    void expectRefused(const std::vector<std::string>& words, int code, const char* says) const {
        const ProgramResult result = runInProcess(words);
        EXPECT_EQ(result.exitCode, code) << result.err;
        EXPECT_THAT(result.err, HasSubstr(says));
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_EQ(result.out, "");
    }

    TemporaryFolder folder;
};

TEST_F(InfoCommand, DescribesABuiltin) {
    const ProgramResult result = runProgram({"info", "builtin:slab"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, HasSubstr("bounding sphere: "));
    EXPECT_THAT(result.out, HasSubstr("rendered at: "));
    EXPECT_THAT(result.out, HasSubstr("automatic atlas: none"));
}

TEST_F(InfoCommand, TellsTheScaleOfAModelWithoutUnits) {
    const ProgramResult result = runInProcess({"info", cube()});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    // The sphere about a cube of side 2 has a diameter of 2 sqrt(3).
    EXPECT_THAT(result.out, HasSubstr("rendered at: 28.8675 mm per unit, a diameter of 100 mm"));
    EXPECT_THAT(result.out, HasSubstr("automatic atlas: for 1 of 1 meshes"));
    EXPECT_THAT(result.out, testing::Not(HasSubstr("charts"))); // it is not made for nothing
}

TEST_F(InfoCommand, DescribesAMaterialLikeMaterialInfo) {
    const ProgramResult result = runInProcess({"info", "marble"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("R_P"));
    EXPECT_EQ(result.out, runProgram({"material", "info", "marble"}).out);
}

TEST_F(InfoCommand, WritesTheCoordinatesThatARenderUses) {
    const ProgramResult result = runInProcess({"info", cube(), "--write-atlas", file("atlas.obj")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("charts: "));
    EXPECT_THAT(result.out, HasSubstr("coverage: "));
    EXPECT_THAT(result.out, HasSubstr("area distortion: "));

    const Scene written = loadScene(folder / "atlas.obj");
    auto material = std::make_shared<subedit::MaterialMap>();
    const World world = buildWorld(loadScene(folder / "cube.obj"), material, {}, nullptr, {});
    ASSERT_EQ(written.meshes.size(), 1u);
    const Mesh& a = written.meshes[0];
    const Mesh& b = world.meshes[0].mesh;
    ASSERT_FALSE(a.uvs.empty());
    ASSERT_EQ(a.indices.size(), b.indices.size());
    for (std::size_t i = 0; i < a.indices.size(); ++i) {
        const glm::vec2 difference = a.uvs[a.indices[i]] - b.uvs[b.indices[i]];
        EXPECT_LT(std::abs(difference.x) + std::abs(difference.y), 1e-6f); // v was turned twice
        const glm::vec3 position = a.positions[a.indices[i]];
        EXPECT_EQ(std::abs(position.x) + std::abs(position.y) + std::abs(position.z), 3.0f);
    }
}

TEST_F(InfoCommand, LeavesGivenCoordinatesAsTheyAre) {
    const ProgramResult result =
        runInProcess({"info", "builtin:slab", "--write-atlas", file("slab.obj")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, testing::Not(HasSubstr("charts")));
    EXPECT_FALSE(loadScene(folder / "slab.obj").meshes[0].uvs.empty());
}

TEST_F(InfoCommand, RefusesBeforeTheWork) {
    const std::string model = cube();
    expectRefused({"info", model, "--write-atlas", file("a.ply")}, 2, "only OBJ files");
    expectRefused({"info", "marble", "--write-atlas", file("a.obj")}, 2, "needs a model");
    expectRefused({"info", model, "--write-atlas", model}, 2, "is the same file as the model");
    expectRefused({"info", model, "--write-atlas", file("absent/a.obj")}, 1, "does not exist");
    EXPECT_EQ(readText(model), kCube);
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST_F(InfoCommand, RefusesWhatItCannotRead) {
    expectRefused({"info", file("absent.obj")}, 3, "absent.obj");
    expectRefused({"info", file("absent.subedit.exr")}, 3, "absent.subedit.exr");
    expectRefused({"info", "nacre"}, 3, "yellow_wax");
    expectRefused({"info", "builtin:teapto"}, 2, "vase");
    writeText(folder / "point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    const ProgramResult point = runInProcess({"info", file("point.obj")});
    EXPECT_EQ(point.exitCode, 3);
    EXPECT_EQ(point.errorLines(), 1) << point.err;
}

} // namespace
} // namespace celadon
