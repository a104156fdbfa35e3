#include "renderer/scene/describe_scene.h"
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

class RealModelsTest : public testing::Test {
protected:
    void SetUp() override {
        if (const auto folder = modelFolder()) {
            mFolder = *folder;
        } else {
            GTEST_SKIP() << "CELADON_MODELS is not set";
        }
    }
    [[nodiscard]] Scene load(const char* path) const { return loadScene(mFolder / path); }

    std::filesystem::path mFolder;
};

TEST_F(RealModelsTest, DracoIsRefusedByName) {
    for (const char* const path : {"gltf/Box_draco.glb", "gltf/CesiumMan_draco/CesiumMan.gltf"}) {
        try {
            (void)load(path);
            ADD_FAILURE() << path << " was read";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("requires KHR_draco_mesh_compression"));
            EXPECT_THAT(error.what(), testing::HasSubstr("without Draco"));
        }
    }
}

/// Six times the volume that the triangles enclose, seen from the mesh's first vertex.
double enclosedVolume(const Mesh& mesh) {
    double volume = 0.0;
    const glm::dvec3 origin(mesh.positions[0]);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[mesh.indices[i]]) - origin;
        const glm::dvec3 b = glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - origin;
        const glm::dvec3 c = glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - origin;
        volume += glm::dot(a, glm::cross(b, c));
    }
    return volume;
}

/// The part of triangles whose corners' normals agree with their winding.
double agreement(const Mesh& mesh) {
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        const glm::dvec3 face = glm::cross(b - a, c - a);
        agreeing += glm::dot(face, glm::dvec3(mesh.normals[mesh.indices[i]])) > 0.0 &&
                            glm::dot(face, glm::dvec3(mesh.normals[mesh.indices[i + 1]])) > 0.0 &&
                            glm::dot(face, glm::dvec3(mesh.normals[mesh.indices[i + 2]])) > 0.0
                        ? 1
                        : 0;
    }
    return static_cast<double>(agreeing) / static_cast<double>(mesh.triangleCount());
}

TEST_F(RealModelsTest, MirroredSolidsStillFaceOutwards) {
    // Six spheres, some under one mirror, some under two.
    std::size_t spheres = 0;
    for (const Mesh& mesh : load("gltf/NegativeScaleTest.glb").meshes) {
        EXPECT_GT(agreement(mesh), 0.99) << mesh.name;
        if (mesh.name == "Icosphere") {
            ++spheres;
            EXPECT_GT(enclosedVolume(mesh), 0.0);
        }
    }
    EXPECT_EQ(spheres, 6u);
}

TEST_F(RealModelsTest, ClosedScansFaceOutwards) {
    for (const char* const path :
         {"mesh/bunny_watertight_60k.obj", "mesh/armadillo_86k.obj", "mesh/spot_uv.obj"}) {
        const Scene scene = load(path);
        EXPECT_GT(enclosedVolume(scene.meshes[0]), 0.0) << path;
        EXPECT_GT(agreement(scene.meshes[0]), 0.97) << path;
    }
}

TEST_F(RealModelsTest, SparseAccessorReplacesItsThreeVertices) {
    // The file says so: vertices 8, 10 and 12 go to (1,2,0), (3,3,0), (5,4,0).
    const Scene scene = load("gltf/SimpleSparseAccessor/SimpleSparseAccessor.gltf");
    for (const glm::vec3 wanted : {glm::vec3(1, 2, 0), glm::vec3(3, 3, 0), glm::vec3(5, 4, 0)}) {
        EXPECT_THAT(scene.meshes[0].positions, testing::Contains(wanted));
    }
}

TEST_F(RealModelsTest, SkinsStandAsTheFileSays) {
    // CesiumMan is 1.5 m tall, z up in the file, turned upright by its root node.
    const Scene man = load("gltf/CesiumMan.glb");
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (const glm::vec3& p : man.meshes[0].positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_NEAR(high.y - low.y, 1.5f, 0.1f);
    EXPECT_NEAR(low.y, 0.0f, 0.05f);
    EXPECT_GT(agreement(man.meshes[0]), 0.97);
    EXPECT_EQ(man.images.size(), 1u);
}

TEST_F(RealModelsTest, CamerasAreBoth) {
    const Scene scene = load("gltf/Cameras_embedded.gltf");
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_NEAR(scene.cameras[0].fovYDegrees, 0.7 * 180.0 / 3.14159265, 1e-4);
    EXPECT_EQ(scene.cameras[1].orthographicHeight, 2.0);
    EXPECT_EQ(scene.cameras[0].eye, glm::dvec3(0.5, 0.5, 3.0));
}

TEST_F(RealModelsTest, LampsShine) {
    const Scene scene = load("gltf/LightsPunctualLamp/LightsPunctualLamp.gltf");
    EXPECT_EQ(scene.lights.size(), 5u);
    EXPECT_GT(scene.images.size(), 3u);
}

TEST_F(RealModelsTest, TextureTransformPutsTheArrowWhereItsMarkerIs) {
    // The arrow of the picture lies on its diagonal. At the place of the green marker, the
    // transform must give a point of that diagonal; at that of the red one it does not.
    const Scene scene = load("gltf/TextureTransformTest/TextureTransformTest.gltf");
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [](const SurfaceMaterial& m) { return m.name == "Rotation"; });
    ASSERT_NE(found, scene.materials.end());
    const auto diagonal = [&](double x, double y) { // of the marker's node, in the quad
        const glm::vec3 uv = found->baseColorTexture.transform * glm::vec3(0.5 + x, 0.5 - y, 1.0);
        return std::abs(uv.x - uv.y);
    };
    EXPECT_LT(diagonal(-0.07904822439840126, -0.5162674857624154), 0.01f);
    EXPECT_GT(diagonal(0.5162674857624154, 0.07904822439840126), 0.3f);
}

TEST_F(RealModelsTest, DescriptionsHaveTheNumbers) {
    const std::vector<std::string> lines = describeScene(load("gltf/Cameras_embedded.gltf"));
    EXPECT_THAT(lines, testing::Contains("triangles: 2"));
    EXPECT_THAT(lines, testing::Contains("millimeters per unit: 1000"));
    EXPECT_THAT(lines, testing::Contains(testing::HasSubstr("camera 1: orthographic")));
}

} // namespace

} // namespace celadon
