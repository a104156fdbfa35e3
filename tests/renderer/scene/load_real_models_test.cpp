#include "renderer/scene/load_scene.h"
#include "subedit/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

/// Real models of the folder CELADON_MODELS, against counts from independent parsers.
namespace celadon {

namespace {

std::optional<std::filesystem::path> modelFolder() {
    const char* const folder = std::getenv("CELADON_MODELS");
    return folder == nullptr ? std::nullopt : std::optional<std::filesystem::path>(folder);
}

struct RealModel {
    const char* path;
    std::size_t triangles; ///< of the file; glTF: as often as nodes show them
    bool hasUvs;
    std::size_t dropped; ///< triangles of no area among them (two corners at one position)
};

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) {
        count += mesh.triangleCount();
    }
    return count;
}

bool hasUvs(const Scene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const Mesh& mesh) { return !mesh.uvs.empty(); });
}

void expectSound(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_FALSE(mesh.indices.empty());
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
        ASSERT_LT(static_cast<std::size_t>(mesh.material), scene.materials.size());
        std::vector<bool> used(mesh.positions.size(), false);
        for (const std::uint32_t index : mesh.indices) {
            ASSERT_LT(index, mesh.positions.size());
            used[index] = true;
        }
        for (std::size_t i = 0; i < used.size(); ++i) {
            ASSERT_TRUE(used[i]) << "vertex " << i;
            ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5f) << "vertex " << i;
        }
    }
}

class RealModelTest : public testing::TestWithParam<RealModel> {};

TEST_P(RealModelTest, LoadsWithItsTriangles) {
    const auto folder = modelFolder();
    if (!folder) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    testing::internal::CaptureStderr();
    const Scene scene = loadScene(*folder / GetParam().path);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(triangleCount(scene) + GetParam().dropped, GetParam().triangles);
    EXPECT_EQ(hasUvs(scene), GetParam().hasUvs);
    expectSound(scene);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealModelTest,
    testing::Values(RealModel{"mesh/armadillo_86k.obj", 86482, false, 0},
                    RealModel{"mesh/bunny_watertight_60k.obj", 59664, false, 0},
                    RealModel{"mesh/hand_16k.obj", 15982, false, 0},
                    RealModel{"mesh/happy_buddha_100k.obj", 100000, false, 0},
                    RealModel{"mesh/koala_100k.obj", 99994, false, 0},
                    RealModel{"mesh/penguin_27k.obj", 26880, false, 0},
                    RealModel{"mesh/rocker_arm_genus1.obj", 20088, false, 0},
                    RealModel{"mesh/skull_genus2_100k.obj", 100002, false, 0},
                    RealModel{"mesh/spot_uv.obj", 5856, true, 0},
                    RealModel{"mesh/stanford_bunny_69k_ascii.ply", 69451, false, 0},
                    RealModel{"mesh/stanford_dragon_203k.ply", 202520, false, 0},
                    RealModel{"mesh/stanford_dragon_871k.ply", 871414, false, 108},
                    RealModel{"mesh/suzanne_quads.obj", 968, false, 0},
                    RealModel{"mesh/teapot_open.obj", 6320, false, 0},
                    RealModel{"gltf/AnimatedMorphCube.glb", 12, false, 0},
                    RealModel{"gltf/AttenuationTest.glb", 292, true, 0},
                    RealModel{"gltf/BoxInterleaved.glb", 12, false, 0},
                    RealModel{"gltf/BoxVertexColors.glb", 12, false, 0},
                    RealModel{"gltf/Cameras_embedded.gltf", 2, false, 0},
                    RealModel{"gltf/CesiumMan.glb", 4672, true, 0},
                    RealModel{"gltf/LightsPunctualLamp/LightsPunctualLamp.gltf", 6000, true, 0},
                    RealModel{"gltf/MeshPrimitiveModes_embedded.gltf", 16, false, 0},
                    RealModel{"gltf/MorphPrimitivesTest.glb", 32, true, 0},
                    RealModel{"gltf/NegativeScaleTest.glb", 7724, true, 0},
                    RealModel{"gltf/RiggedSimple.glb", 188, false, 0},
                    RealModel{"gltf/SimpleInstancing.glb", 12, false, 0},
                    RealModel{"gltf/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12, false, 0},
                    RealModel{"gltf/SpotDiffuseTransmission_MADE.glb", 5856, true, 0},
                    RealModel{"gltf/Suzanne/Suzanne.gltf", 3936, true, 0},
                    RealModel{"gltf/TextureTransformTest/TextureTransformTest.gltf", 24, true, 0}),
    [](const auto& instance) {
        std::string name = std::filesystem::path(instance.param.path).stem().string();
        return name;
    });

} // namespace

} // namespace celadon
