#include "renderer/scene/builtin.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/rewrite_gltf.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/write_gltf.h"
#include "subedit/errors.h"
#include "tests/support/materials.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdlib>

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

/// A vase whose look has all that a look can have.
TEST(WriteGltf, LooksKeepTheirTextures) {
    World world = vaseWorld();
    WorldMesh& part = world.meshes.front();
    part.scattering = -1;
    Image picture{"bark", 4, 2, {}};
    for (int i = 0; i < 32; ++i) {
        picture.rgba.push_back(static_cast<std::uint8_t>(i * 7));
    }
    Image opaque = picture;
    for (std::size_t i = 3; i < opaque.rgba.size(); i += 4) {
        opaque.rgba[i] = 255;
    }
    world.images = {picture, opaque};
    SurfaceMaterial look;
    look.name = "wood";
    look.baseColor = {0.2f, 0.4f, 0.6f, 0.5f};
    look.emission = {3.0f, 1.5f, 0.0f};
    look.roughness = 0.25f;
    look.metallic = 0.75f;
    look.ior = 1.7f;
    look.doubleSided = true;
    look.alphaCutoff = 0.3f;
    look.baseColorTexture.image = 0;
    look.baseColorTexture.wrapU = Wrap::ClampToEdge;
    look.baseColorTexture.wrapV = Wrap::MirroredRepeat;
    look.baseColorTexture.nearest = true;
    const float c = std::cos(0.4f), s = std::sin(0.4f);
    look.baseColorTexture.transform =
        glm::mat3(glm::vec3(2.0f * c, -2.0f * s, 0.0f), glm::vec3(3.0f * s, 3.0f * c, 0.0f),
                  glm::vec3(0.1f, 0.2f, 1.0f));
    look.metallicRoughnessTexture.image = 1;
    look.normalTexture.image = 1;
    look.normalScale = 0.5f;
    look.emissiveTexture.image = 0;
    world.looks.assign(world.looks.size(), look);
    const test::TemporaryFolder folder;
    for (const char* name : {"vase.gltf", "vase.glb"}) {
        writeGltf(world, {{{"name", "wax"}}}, {}, folder / name);
        const Scene scene = loadScene((folder / name).string());
        EXPECT_TRUE(scene.warnings.empty());
        ASSERT_EQ(scene.images.size(), 2u);
        EXPECT_EQ(scene.images[0].rgba, picture.rgba);
        EXPECT_EQ(scene.images[1].rgba, opaque.rgba);
        EXPECT_EQ(scene.images[0].name, "bark");
        const SurfaceMaterial& back =
            scene.materials[static_cast<std::size_t>(scene.meshes.front().material)];
        EXPECT_EQ(back.name, "wood");
        EXPECT_EQ(back.baseColor, look.baseColor);
        EXPECT_LT(glm::distance(back.emission, look.emission), 1e-5f);
        EXPECT_EQ(back.metallic, look.metallic);
        EXPECT_EQ(back.roughness, look.roughness);
        EXPECT_EQ(back.ior, look.ior);
        EXPECT_TRUE(back.doubleSided);
        EXPECT_EQ(back.alphaCutoff, look.alphaCutoff);
        EXPECT_EQ(back.normalScale, look.normalScale);
        EXPECT_EQ(back.baseColorTexture.wrapU, Wrap::ClampToEdge);
        EXPECT_EQ(back.baseColorTexture.wrapV, Wrap::MirroredRepeat);
        EXPECT_TRUE(back.baseColorTexture.nearest);
        for (int k = 0; k < 3; ++k) {
            EXPECT_LT(glm::distance(back.baseColorTexture.transform[k],
                                    look.baseColorTexture.transform[k]),
                      1e-5f);
        }
        EXPECT_EQ(back.metallicRoughnessTexture.image, 1);
        EXPECT_EQ(back.normalTexture.image, 1);
        EXPECT_EQ(back.emissiveTexture.image, 0);
    }
}

void expectSame(const Scene& before, const Scene& after) {
    ASSERT_EQ(after.meshes.size(), before.meshes.size());
    for (std::size_t m = 0; m < before.meshes.size(); ++m) {
        EXPECT_EQ(after.meshes[m].positions, before.meshes[m].positions);
        EXPECT_EQ(after.meshes[m].normals, before.meshes[m].normals);
        EXPECT_EQ(after.meshes[m].uvs, before.meshes[m].uvs);
        EXPECT_EQ(after.meshes[m].colors, before.meshes[m].colors);
        EXPECT_EQ(after.meshes[m].indices, before.meshes[m].indices);
        EXPECT_EQ(after.meshes[m].material, before.meshes[m].material);
    }
    ASSERT_EQ(after.images.size(), before.images.size());
    for (std::size_t i = 0; i < before.images.size(); ++i) {
        EXPECT_EQ(after.images[i].rgba, before.images[i].rgba);
    }
    EXPECT_EQ(after.cameras.size(), before.cameras.size());
    EXPECT_EQ(after.lights.size(), before.lights.size());
    ASSERT_EQ(after.rig != nullptr, before.rig != nullptr);
    if (before.rig != nullptr) {
        EXPECT_EQ(after.rig->animations.size(), before.rig->animations.size());
    }
}

/// Models of others, written anew into another folder: all is there, whatever lay beside them.
TEST(RewriteGltf, KeepsAllButMaterialsAndDeformers) {
    const char* const models = std::getenv("CELADON_MODELS");
    if (models == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS names no folder";
    }
    const test::TemporaryFolder folder;
    const nlohmann::json made = {{"name", "wax"},
                                 {"extensions", {{"KHR_materials_ior", {{"ior", 1.3}}}}},
                                 {"extras", {{"subedit", "wax.subedit.exr"}}}};
    for (const char* name :
         {"CesiumMan.glb", "MorphPrimitivesTest.glb", "Suzanne/Suzanne.gltf",
          "TextureTransformTest/TextureTransformTest.gltf", "SimpleInstancing.glb",
          "LightsPunctualLamp/LightsPunctualLamp.gltf", "Cameras_embedded.gltf"}) {
        SCOPED_TRACE(name);
        const std::filesystem::path source = std::filesystem::path(models) / "gltf" / name;
        const Scene before = loadScene(source.string());
        const auto used = static_cast<std::size_t>(before.meshes.front().material);
        for (const char* output : {"out.gltf", "out.glb"}) {
            EXPECT_THAT(loaders::rewriteGltf(source, {{{used, made}}, {}, 1.0}, folder / output),
                        testing::IsEmpty());
            const Scene after = loadScene((folder / output).string());
            expectSame(before, after);
            EXPECT_EQ(after.warnings.size(), before.warnings.size());
            const SurfaceMaterial& look = after.materials[used];
            ASSERT_TRUE(look.subedit);
            EXPECT_EQ(look.subedit->filename(), "wax.subedit.exr");
            EXPECT_FLOAT_EQ(look.ior.value_or(0.0f), 1.3f);
            EXPECT_EQ(look.normalTexture.image, before.materials[used].normalTexture.image);
        }
    }
}

TEST(RewriteGltf, ScalesWhatIsSkinnedAsWell) {
    const char* const models = std::getenv("CELADON_MODELS");
    if (models == nullptr) {
        GTEST_SKIP() << "CELADON_MODELS names no folder";
    }
    const test::TemporaryFolder folder;
    const auto source = std::filesystem::path(models) / "gltf/CesiumMan.glb";
    const auto output = folder / "small.glb";
    static_cast<void>(loaders::rewriteGltf(source, {{}, {}, 0.1}, output));
    const Scene before = loadScene(source.string());
    const Scene after = loadScene(output.string());
    const double radius = boundingSphere(before).radius;
    for (std::size_t i = 0; i < before.meshes.front().positions.size(); ++i) {
        ASSERT_LT(glm::distance(after.meshes.front().positions[i],
                                0.1f * before.meshes.front().positions[i]),
                  1e-6 * radius);
    }
    ASSERT_EQ(after.rig->animations.size(), before.rig->animations.size());
}

/// A triangle of its own buffer file, seen by an orthographic camera.
nlohmann::json triangle() {
    return nlohmann::json::parse(R"({
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "t.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36,
                         "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteLength": 9}}}],
        "extensionsUsed": ["EXT_meshopt_compression"],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "cameras": [{"type": "orthographic",
                     "orthographic": {"xmag": 2, "ymag": 3, "znear": 1, "zfar": 5}}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 4]}]})");
}

TEST(RewriteGltf, ScalesFilesWithoutAndWithSeveralScenes) {
    const test::TemporaryFolder folder;
    const std::array<float, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    test::writeText(folder / "t.bin",
                    {reinterpret_cast<const char*>(corners.data()), sizeof(corners)});
    const nlohmann::json both = {{"nodes", {0, 1}}};
    for (const nlohmann::json& scenes : {nlohmann::json(), nlohmann::json::array({both, both})}) {
        nlohmann::json document = triangle();
        if (!scenes.is_null()) {
            document["scenes"] = scenes;
        }
        test::writeText(folder / "t.gltf", document.dump());
        const Scene before = loadScene((folder / "t.gltf").string());
        static_cast<void>(loaders::rewriteGltf(folder / "t.gltf", {{}, {}, 0.5}, folder / "s.glb"));
        const Scene after = loadScene((folder / "s.glb").string());
        ASSERT_EQ(after.cameras.size(), 1u);
        EXPECT_NEAR(*after.cameras[0].orthographicHeight,
                    0.5 * *before.cameras[0].orthographicHeight, 1e-9);
        EXPECT_NEAR(after.cameras[0].eye.z, 2.0, 1e-9);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(after.meshes[0].positions[i], 0.5f * before.meshes[0].positions[i]);
        }
        EXPECT_EQ(test::readText(folder / "s.glb").find("meshopt"), std::string::npos);
    }
    // The buffer beside "t.gltf" would take the place of the model's own.
    std::filesystem::rename(folder / "t.gltf", folder / "model.gltf");
    EXPECT_THROW(
        static_cast<void>(loaders::rewriteGltf(folder / "model.gltf", {}, folder / "t.gltf")),
        UsageError);
}

TEST(RewriteGltf, LightsTakeThePlaceOfTheFilesOwn) {
    const test::TemporaryFolder folder;
    const World world = vaseWorld();
    const auto lightAlong = [](const glm::dvec3& direction) {
        loaders::NamedLight named{"sun", {}};
        named.light.direction = glm::normalize(direction);
        named.light.color = {3.0, 2.0, 0.0};
        return named;
    };
    const std::vector first{lightAlong({0.0, 0.0, 1.0}), lightAlong({1.0, 2.0, 3.0})};
    writeGltf(world, {{{"name", "wax"}}}, {}, folder / "a.gltf", first);
    const std::vector<Light> read = loadScene((folder / "a.gltf").string()).lights;
    ASSERT_EQ(read.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) { // the first is turned by half a circle
        EXPECT_LT(glm::distance(read[i].direction, first[i].light.direction), 1e-9);
        EXPECT_LT(glm::distance(read[i].color, first[i].light.color), 1e-9);
    }
    std::vector second{lightAlong({0.0, -1.0, 0.0}), lightAlong({0.3, -1.0, 0.0})};
    second[1].light.kind = Light::Kind::Spot; // where it is, whatever the rest is scaled by
    second[1].light.position = {0.1, 0.2, 0.3};
    second[1].light.innerConeRadians = 0.2;
    second[1].light.outerConeRadians = 0.4;
    loaders::GltfChanges changes;
    changes.scale = 2.0;
    changes.lights = second;
    static_cast<void>(loaders::rewriteGltf(folder / "a.gltf", changes, folder / "b.glb"));
    const Scene relit = loadScene((folder / "b.glb").string());
    ASSERT_EQ(relit.lights.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(glm::distance(relit.lights[i].direction, second[i].light.direction), 1e-9);
    }
    EXPECT_EQ(relit.lights[1].kind, Light::Kind::Spot);
    EXPECT_LT(glm::distance(relit.lights[1].position, second[1].light.position), 1e-9);
    EXPECT_NEAR(relit.lights[1].innerConeRadians, 0.2, 1e-9);
    EXPECT_NEAR(relit.lights[1].outerConeRadians, 0.4, 1e-9);
    changes.lights = std::vector<loaders::NamedLight>();
    static_cast<void>(loaders::rewriteGltf(folder / "a.gltf", changes, folder / "c.gltf"));
    EXPECT_TRUE(loadScene((folder / "c.gltf").string()).lights.empty());
    EXPECT_EQ(test::readText(folder / "c.gltf").find("punctual"), std::string::npos);
}

TEST(WriteGltf, NamesAFolderThatIsMissing) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(writeGltf(vaseWorld(), {nlohmann::json::object()}, {}, folder / "no/such.gltf"),
                 OutputError);
}

} // namespace
} // namespace celadon
