#include "renderer/scene/write_obj.h"
#include "subedit/errors.h"
#include "tests/renderer/scene/atlas_shapes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace celadon {
namespace {

class WriteObj : public testing::Test {
protected:
    void SetUp() override {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        mFolder = std::filesystem::path(testing::TempDir()) / ("celadon_write_obj_" + name);
        std::filesystem::remove_all(mFolder);
        std::filesystem::create_directories(mFolder);
    }
    void TearDown() override { std::filesystem::remove_all(mFolder); }

    static std::string contents(const std::filesystem::path& file) {
        std::ifstream in(file);
        std::ostringstream text;
        text << in.rdbuf();
        return text.str();
    }

    std::filesystem::path mFolder;
};

TEST_F(WriteObj, PositionsComeBackToTheBit) {
    Mesh mesh = test::makeSphere(12, 6, {0.1f, -7e5f, 1e-8f}, 3.3e-3f);
    const Mesh* meshes[] = {&mesh, &mesh};
    const std::filesystem::path file = mFolder / "two.obj";
    writeObj(meshes, file);
    const Mesh back = test::readTestModel(file.string());
    ASSERT_EQ(back.positions.size(), 2 * mesh.positions.size());
    ASSERT_EQ(back.indices.size(), 2 * mesh.indices.size());
    for (std::size_t i = 0; i < back.positions.size(); ++i) {
        EXPECT_EQ(back.positions[i], mesh.positions[i % mesh.positions.size()]);
    }
    EXPECT_EQ(back.indices[mesh.indices.size()], mesh.indices[0] + mesh.positions.size());
}

TEST_F(WriteObj, TextureCoordinatesRunUp) {
    Mesh mesh;
    mesh.name = "a name\nwith breaks";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uvs = {{0.0f, 0.25f}, {1.0f, 1.0f}, {0.5f, 0.0f}};
    mesh.indices = {0, 1, 2};
    const Mesh* one = &mesh;
    writeObj(std::span(&one, 1), mFolder / "uv.obj");
    const std::string text = contents(mFolder / "uv.obj");
    EXPECT_NE(text.find("o a_name_with_breaks\n"), std::string::npos);
    EXPECT_NE(text.find("vt 0 0.75\nvt 1 0\nvt 0.5 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("f 1/1/1 2/2/2 3/3/3\n"), std::string::npos);
}

TEST_F(WriteObj, FailureLeavesNothingBehind) {
    const Mesh mesh = test::makeCube();
    const Mesh* one = &mesh;
    EXPECT_THROW(writeObj(std::span(&one, 1), mFolder / "missing" / "x.obj"), OutputError);
    // A folder of that name: the file cannot take its place.
    std::filesystem::create_directories(mFolder / "taken.obj" / "inside");
    EXPECT_THROW(writeObj(std::span(&one, 1), mFolder / "taken.obj"), OutputError);
    int entries = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(mFolder)) {
        ++entries;
    }
    EXPECT_EQ(entries, 1);
}

} // namespace
} // namespace celadon
