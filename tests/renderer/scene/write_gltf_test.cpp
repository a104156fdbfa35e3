#include "renderer/scene/builtin.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/write_gltf.h"
#include "subedit/errors.h"
#include "tests/support/materials.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace celadon {
namespace {

World vaseWorld() {
    Scene scene = makeBuiltin("vase");
    const std::size_t materials = scene.materials.size();
    return buildWorld(std::move(scene), test::homogeneousMaterial(2.0),
                      std::vector<MaterialPointer>(materials), nullptr, {std::nullopt, 80.0});
}

TEST(WriteGltf, WhatIsWrittenReadsBack) {
    const World world = vaseWorld();
    const test::TemporaryFolder folder;
    const auto file = folder / "a vase.gltf"; // a name that a URI must escape
    writeGltf(world, {{{"name", "wax"}, {"extras", {{"subedit", "wax.subedit.exr"}}}}}, {}, file);
    const Scene scene = loadScene(file.string());
    ASSERT_EQ(scene.meshes.size(), world.meshes.size());
    EXPECT_EQ(scene.millimetersPerUnit, 1000.0);
    const Mesh& before = world.meshes.front().mesh;
    const Mesh& after = scene.meshes.front();
    ASSERT_EQ(after.indices, before.indices);
    ASSERT_EQ(after.positions.size(), before.positions.size());
    EXPECT_EQ(after.uvs, before.uvs);
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        // Millimeters to meters and back: two roundings of a float.
        EXPECT_LE(glm::distance(1000.0f * after.positions[i], before.positions[i]), 80.0f * 3e-7f);
        EXPECT_LE(glm::distance(after.normals[i], before.normals[i]), 1e-5f);
    }
    const SurfaceMaterial& look = scene.materials[static_cast<std::size_t>(after.material)];
    ASSERT_TRUE(look.subedit);
    EXPECT_EQ(look.subedit->filename(), "wax.subedit.exr");
}

TEST(WriteGltf, NamesAFolderThatIsMissing) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(writeGltf(vaseWorld(), {nlohmann::json::object()}, {}, folder / "no/such.gltf"),
                 OutputError);
}

} // namespace
} // namespace celadon
