#include "load_support.h"

#include <cmath>

/// glTF made in the test: what the reader must understand, element by element.
namespace celadon {

namespace {

using loadtest::bytesOf;
using loadtest::GltfBuilder;
using loadtest::refusal;
using loadtest::TemporaryFolder;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfTest : public testing::Test {
protected:
    TemporaryFolder mFolder;
    GltfBuilder mGltf;

    [[nodiscard]] Scene load() const { return loadScene(mFolder.write("a.glb", mGltf.glb())); }
    [[nodiscard]] std::string refused() const {
        return refusal(mFolder.write("a.glb", mGltf.glb()));
    }
    static glm::dvec3 faceNormal(const Mesh& mesh, std::size_t triangle) {
        const glm::dvec3 a(mesh.positions[mesh.indices[3 * triangle]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[3 * triangle + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[3 * triangle + 2]]);
        return glm::normalize(glm::cross(b - a, c - a));
    }
};

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST_F(GltfTest, TriangleHasAFlatNormalAndIsInMeters) {
    mGltf.addTriangle();
    const Scene scene = load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.millimetersPerUnit, 1000.0);
    EXPECT_THAT(scene.meshes[0].normals, testing::Each(glm::vec3(0, 0, 1)));
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(1.0f));
}

TEST_F(GltfTest, MissingNormalsAreFlatSoVerticesAreUnshared) {
    const int positions = mGltf.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}, "VEC3");
    const int uvs = mGltf.addFloats({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    const int indices = mGltf.addIndices<std::uint8_t>({0, 1, 2, 2, 1, 3});
    mGltf.json["meshes"] = {{{"primitives",
                              {{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                                {"indices", indices}}}}}};
    const Scene scene = load();
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.uvs[5], glm::vec2(1, 1));
    for (std::size_t triangle = 0; triangle < 2; ++triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            expectNear(glm::dvec3(mesh.normals[mesh.indices[3 * triangle + k]]),
                       faceNormal(mesh, triangle));
        }
    }
}

TEST_F(GltfTest, GivenNormalsAreNormalizedAndUselessOnesReplaced) {
    mGltf.addTriangle();
    mGltf.primitive()["attributes"]["NORMAL"] =
        mGltf.addFloats({0, 3, 4, 0, 0, 0, NAN, 0, 1}, "VEC3");
    const Mesh mesh = load().meshes[0];
    expectNear(glm::dvec3(mesh.normals[0]), {0, 0.6, 0.8});
    expectNear(glm::dvec3(mesh.normals[1]), {0, 0, 1});
    expectNear(glm::dvec3(mesh.normals[2]), {0, 0, 1});
}

TEST_F(GltfTest, IndicesOfAllSizesStripsAndFans) {
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const int corners = mGltf.addFloats(square, "VEC3");
    const int around = mGltf.addFloats(fan, "VEC3");
    const auto primitive = [](int positions, int mode, int indices) {
        json result{{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
        if (indices >= 0) {
            result["indices"] = indices;
        }
        return result;
    };
    mGltf.json["meshes"] = {
        {{"primitives",
          {primitive(corners, 5, -1), primitive(around, 6, -1),
           primitive(corners, 4, mGltf.addIndices<std::uint16_t>({0, 1, 2, 2, 1, 3})),
           primitive(corners, 5, mGltf.addIndices<std::uint32_t>({0, 1, 2, 3})),
           primitive(corners, 0, -1), primitive(corners, 3, -1)}}}};
    const Scene scene = load();
    ASSERT_EQ(scene.meshes.size(), 4u);
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_EQ(mesh.triangleCount(), 2u);
        EXPECT_THAT(mesh.normals, testing::Each(glm::vec3(0, 0, 1)));
    }
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("skipped 2 primitives of points or lines")));
}

TEST_F(GltfTest, InterleavedNormalizedAttributes) {
    // Position as float, uv as normalized unsigned short, 20 bytes a vertex, 4 of them nothing.
    std::string bytes;
    const std::vector<glm::vec3> positions{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    for (const glm::vec3& p : positions) {
        bytes += bytesOf(p.x) + bytesOf(p.y) + bytesOf(p.z);
        bytes += bytesOf(std::uint16_t{65535}) + bytesOf(std::uint16_t{13107});
        bytes += "PADD";
    }
    const int view = mGltf.addView(bytes, 20);
    const int position = mGltf.addAccessor(view, "VEC3", 5126, 3);
    const int uv = mGltf.addAccessor(view, "VEC2", 5123, 3, 12);
    mGltf.json["accessors"][1]["normalized"] = true;
    mGltf.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}}}}}};
    const Mesh mesh = load().meshes[0];
    EXPECT_EQ(mesh.positions[1], glm::vec3(2, 0, 0));
    EXPECT_EQ(mesh.uvs[0], glm::vec2(1.0f, 0.2f));
}

TEST_F(GltfTest, QuantizedPositionsAndNormals) {
    const int view = mGltf.addView(
        bytesOf(std::vector<std::int16_t>{0, 0, 0, 0, 1000, 0, 0, 0, 0, -1000, 0, 0}), 8);
    const int normals = mGltf.addView(
        bytesOf(std::vector<std::int8_t>{0, 0, -128, 0, 0, 0, -127, 0, 0, 0, -127, 0}), 4);
    const int position = mGltf.addAccessor(view, "VEC3", 5122, 3);
    const int normal = mGltf.addAccessor(normals, "VEC3", 5120, 3);
    mGltf.json["accessors"][1]["normalized"] = true;
    mGltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    mGltf.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    mGltf.json["nodes"][0]["scale"] = {0.001, 0.001, 0.001};
    mGltf.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}}}}}};
    const Mesh mesh = load().meshes[0];
    expectNear(glm::dvec3(mesh.positions[1]), {1, 0, 0});
    expectNear(glm::dvec3(mesh.positions[2]), {0, -1, 0});
    expectNear(glm::dvec3(mesh.normals[0]), {0, 0, -1});
}

TEST_F(GltfTest, SparseValuesReplaceThoseOfTheView) {
    mGltf.addTriangle();
    const int indices = mGltf.addView(bytesOf(std::vector<std::uint16_t>{1}));
    const int values = mGltf.addView(bytesOf(std::vector<float>{5, 0, 0}));
    mGltf.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    const Mesh mesh = load().meshes[0];
    EXPECT_EQ(mesh.positions[1], glm::vec3(5, 0, 0));
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, 1, 0));
}

TEST_F(GltfTest, NodesComposeAndMirrorsKeepTheFront) {
    mGltf.addTriangle();
    mGltf.primitive()["attributes"]["NORMAL"] =
        mGltf.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const double half = std::sqrt(0.5);
    mGltf.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                           {{"mesh", 0}, {"rotation", {half, 0, 0, half}}, {"scale", {-2, 1, 1}}}};
    const Mesh mesh = load().meshes[0];
    // Scaled by -2 in x, then turned by 90 degrees about x (y to z), then moved.
    std::vector<glm::vec3> expected{{10, 0, 0}, {8, 0, 0}, {10, 0, 1}};
    for (const glm::vec3& p : expected) {
        EXPECT_TRUE(std::any_of(mesh.positions.begin(), mesh.positions.end(),
                                [&](const auto& q) { return glm::distance(p, q) < 1e-6f; }));
    }
    // The front of the triangle looked along +z, which is now -y.
    expectNear(faceNormal(mesh, 0), {0, -1, 0});
    expectNear(glm::dvec3(mesh.normals[0]), {0, -1, 0});
}

TEST_F(GltfTest, NormalsFollowTheInverseTranspose) {
    const int positions = mGltf.addFloats({0, 0, 0, 1, -1, 0, 0, 0, 1}, "VEC3");
    const int normals = mGltf.addFloats({-1, -1, 0, -1, -1, 0, -1, -1, 0}, "VEC3");
    mGltf.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}}}}}};
    mGltf.json["nodes"][0]["matrix"] = {4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const Mesh mesh = load().meshes[0];
    expectNear(faceNormal(mesh, 0), glm::normalize(glm::dvec3(-1, -4, 0)));
    expectNear(glm::dvec3(mesh.normals[0]), faceNormal(mesh, 0));
}

TEST_F(GltfTest, TheDefaultSceneIsShownAndInstancesAreMany) {
    mGltf.addTriangle();
    mGltf.json["nodes"] = {{{"mesh", 0}},
                           {{"children", {2, 3}}},
                           {{"mesh", 0}, {"translation", {1, 0, 0}}},
                           {{"mesh", 0}, {"translation", {2, 0, 0}}}};
    mGltf.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    mGltf.json["scene"] = 1;
    const Scene scene = load();
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positions[0], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[1].positions[0], glm::vec3(2, 0, 0));
}

TEST_F(GltfTest, MorphTargetsHaveTheWeightsOfTheNodeOrElseOfTheMesh) {
    mGltf.addTriangle();
    const int change = mGltf.addFloats({0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3");
    mGltf.primitive()["targets"] = {{{"POSITION", change}}, {{"POSITION", change}}};
    mGltf.json["meshes"][0]["weights"] = {0.5, 0.0};
    mGltf.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"weights", {1.0, 0.25}}}};
    mGltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    const Scene scene = load();
    EXPECT_EQ(scene.meshes[0].positions[0].z, 1.0f);
    EXPECT_EQ(scene.meshes[1].positions[0].z, 2.5f);
}

TEST_F(GltfTest, SkinnedVerticesFollowTheirJointsAndNotTheirNode) {
    mGltf.addTriangle();
    const int joints = mGltf.addAccessor(
        mGltf.addView(bytesOf(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0})),
        "VEC4", 5121, 3);
    const int weights =
        mGltf.addFloats({1, 0, 0, 0, 2, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4"); // one not normalized
    std::vector<float> inverse(32, 0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
        inverse[5 * k] = inverse[16 + 5 * k] = 1.0f;
    }
    inverse[16 + 12] = -1.0f; // joint 1 rests at x = 1
    mGltf.primitive()["attributes"]["JOINTS_0"] = joints;
    mGltf.primitive()["attributes"]["WEIGHTS_0"] = weights;
    mGltf.json["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", mGltf.addFloats(inverse, "MAT4")}}};
    mGltf.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                           {{"translation", {0, 0, 0}}, {"children", {2}}},
                           {{"translation", {1, 0, 3}}}};
    mGltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    const Mesh mesh = load().meshes[0];
    expectNear(glm::dvec3(mesh.positions[0]), {0, 0, 0});
    expectNear(glm::dvec3(mesh.positions[1]), {1, 0, 3});
    expectNear(glm::dvec3(mesh.positions[2]), {0, 1, 1.5});
}

TEST_F(GltfTest, CamerasLookAlongMinusZAtTheDepthOfTheScene) {
    mGltf.addTriangle();
    mGltf.json["cameras"] = {
        {{"type", "perspective"}, {"name", "lens"}, {"perspective", {{"yfov", 0.5}, {"znear", 1}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 2}, {"ymag", 1.5}, {"znear", 1}, {"zfar", 9}}}}};
    mGltf.json["nodes"] = {{{"mesh", 0}},
                           {{"camera", 0}, {"translation", {0.5, 0.5, 4}}},
                           {{"camera", 1}, {"translation", {0, 0, -4}}}};
    mGltf.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
    const Scene scene = load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "lens");
    EXPECT_NEAR(scene.cameras[0].fovYDegrees, 0.5 * 180.0 / 3.14159265358979, 1e-9);
    expectNear(scene.cameras[0].eye, {0.5, 0.5, 4});
    expectNear(scene.cameras[0].at, {0.5, 0.5, 0});
    expectNear(scene.cameras[0].up, {0, 1, 0});
    EXPECT_EQ(scene.cameras[1].orthographicHeight, 3.0);
    expectNear(scene.cameras[1].at, {0, 0, -5}); // the scene lies behind it
}

TEST_F(GltfTest, LightsTravelAlongMinusZ) {
    mGltf.addTriangle();
    const double half = std::sqrt(0.5);
    mGltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0.25}}},
        {{"type", "point"}},
        {{"type", "spot"},
         {"intensity", 10},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}}};
    const auto node = [](int light) {
        return json{{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}},
                    {"translation", {1, 2, 3}}};
    };
    mGltf.json["nodes"] = {{{"mesh", 0}}, node(0), node(1), node(2)};
    mGltf.json["nodes"][1]["rotation"] = {half, 0, 0, half}; // -z becomes +y
    mGltf.json["nodes"][3]["scale"] = {2, 2, 2};
    mGltf.json["scenes"] = {{{"nodes", {0, 1, 2, 3}}}};
    const Scene scene = load();
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].kind, Light::Kind::Directional);
    expectNear(scene.lights[0].direction, {0, 1, 0});
    expectNear(scene.lights[0].color, {3, 1.5, 0.75});
    EXPECT_EQ(scene.lights[1].kind, Light::Kind::Point);
    expectNear(scene.lights[1].position, {1, 2, 3});
    expectNear(scene.lights[1].color, {1, 1, 1});
    expectNear(scene.lights[2].direction, {0, 0, -1});
    EXPECT_DOUBLE_EQ(scene.lights[2].innerConeRadians, 0.2);
    EXPECT_DOUBLE_EQ(scene.lights[2].outerConeRadians, 0.6);
}

TEST_F(GltfTest, HardSpotConesGetAWidth) {
    mGltf.addTriangle();
    mGltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.6}, {"outerConeAngle", 0.6}}}}};
    mGltf.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const Scene scene = load();
    EXPECT_LT(scene.lights[0].innerConeRadians, scene.lights[0].outerConeRadians);
}

/// A PNG of 2 x 1 pixels, (255, 0, 0, 255) and (0, 0, 255, 128), stored without compression.
std::string tinyPng() {
    const auto big = [](std::uint32_t value) {
        std::string bytes = bytesOf(value);
        std::reverse(bytes.begin(), bytes.end());
        return bytes;
    };
    const auto crc = [](const std::string& bytes) {
        std::uint32_t c = 0xffffffffu;
        for (const char byte : bytes) {
            c ^= static_cast<unsigned char>(byte);
            for (int k = 0; k < 8; ++k) {
                c = (c >> 1) ^ ((c & 1u) != 0 ? 0xedb88320u : 0u);
            }
        }
        return c ^ 0xffffffffu;
    };
    const auto chunk = [&](const std::string& typeAndData) {
        return big(static_cast<std::uint32_t>(typeAndData.size() - 4)) + typeAndData +
               big(crc(typeAndData));
    };
    const std::string row("\0\xff\0\0\xff\0\0\xff\x80", 9);
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char byte : row) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const auto length = static_cast<std::uint16_t>(row.size());
    const std::string deflated = std::string("\x78\x01\x01", 3) + bytesOf(length) +
                                 bytesOf(static_cast<std::uint16_t>(~length)) + row +
                                 big((b << 16) | a);
    return std::string("\x89PNG\r\n\x1a\n") +
           chunk("IHDR" + big(2) + big(1) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT" + deflated) + chunk("IEND");
}

TEST_F(GltfTest, MaterialsAndTheirTextures) {
    mGltf.addTriangle();
    mGltf.primitive()["material"] = 0;
    const int picture = mGltf.addView(tinyPng());
    mGltf.json["images"] = {{{"bufferView", picture}, {"mimeType", "image/png"}, {"name", "two"}},
                            {{"uri", "sub%20folder.png"}},
                            {{"uri", "missing.png"}}};
    mFolder.write("sub folder.png", tinyPng());
    mGltf.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    mGltf.json["textures"] = {
        {{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 0}}};
    mGltf.json["materials"] = {
        {{"name", "stone"},
         {"doubleSided", true},
         {"emissiveFactor", {1, 0.5, 0}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 1}},
           {"roughnessFactor", 0.5},
           {"metallicFactor", 0},
           {"baseColorTexture",
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"texCoord", 1}}}}}}},
           {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
         {"normalTexture", {{"index", 2}, {"scale", 0.7}}},
         {"extensions",
          {{"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_unlit", json::object()},
           {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
         {"extras", {{"subedit", "materials/jade.subedit.exr"}}}},
        {{"normalTexture", {{"index", 3}}}}};
    const Scene scene = load();
    ASSERT_EQ(scene.materials.size(), 2u);
    const SurfaceMaterial& stone = scene.materials[0];
    EXPECT_EQ(stone.name, "stone");
    EXPECT_TRUE(stone.doubleSided);
    EXPECT_EQ(stone.emission, glm::vec3(4, 2, 0));
    EXPECT_EQ(stone.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 1.0f));
    EXPECT_EQ(stone.roughness, 0.5f);
    EXPECT_EQ(stone.ior, 1.33f);
    EXPECT_EQ(stone.subedit, mFolder.path() / "materials" / "jade.subedit.exr");
    EXPECT_EQ(stone.baseColorTexture.wrapU, Wrap::ClampToEdge);
    EXPECT_EQ(stone.baseColorTexture.wrapV, Wrap::MirroredRepeat);
    EXPECT_TRUE(stone.baseColorTexture.nearest);
    EXPECT_EQ(stone.baseColorTexture.uvSet, 1);
    EXPECT_EQ(stone.baseColorTexture.transform * glm::vec3(1, 1, 1), glm::vec3(2.5f, 4.25f, 1));
    EXPECT_EQ(stone.metallicRoughnessTexture.uvSet, 1);
    EXPECT_FALSE(stone.normalTexture.isSet());
    EXPECT_EQ(stone.normalScale, 0.7f);
    EXPECT_EQ(scene.materials[1].normalTexture.image, stone.baseColorTexture.image);
    ASSERT_EQ(scene.images.size(), 2u) << testing::PrintToString(scene.warnings);
    const Image& two = scene.images[static_cast<std::size_t>(stone.baseColorTexture.image)];
    EXPECT_EQ(two.name, "two");
    EXPECT_THAT(two.rgba, ElementsAre(255, 0, 0, 255, 0, 0, 255, 128));
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("missing.png': there is no such file")));
}

TEST_F(GltfTest, VertexColorsAreLinearAndInRange) {
    mGltf.addTriangle();
    const auto read = [&](int accessor) {
        mGltf.primitive()["attributes"]["COLOR_0"] = accessor;
        return load().meshes[0].colors;
    };
    EXPECT_TRUE(load().meshes[0].colors.empty());
    const int three = mGltf.addFloats({0.5f, 0, 1, 2, -1, 0.25f, 0, 0, 0}, "VEC3");
    EXPECT_THAT(read(three), ElementsAre(glm::vec4(0.5f, 0, 1, 1), glm::vec4(1, 0, 0.25f, 1),
                                         glm::vec4(0, 0, 0, 1)));
    const std::vector<std::uint8_t> bytes{255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 255};
    const int four = mGltf.addAccessor(mGltf.addView(bytesOf(bytes)), "VEC4", 5121, 3);
    mGltf.json["accessors"][static_cast<std::size_t>(four)]["normalized"] = true;
    EXPECT_THAT(read(four),
                ElementsAre(glm::vec4(1, 0, 0.2f, 0.4f), glm::vec4(0.0f), glm::vec4(0, 0, 0, 1)));
}

TEST_F(GltfTest, VertexColorsThatMakeNoSenseAreRefused) {
    mGltf.addTriangle();
    const auto refusedColors = [&](int accessor) {
        mGltf.primitive()["attributes"]["COLOR_0"] = accessor;
        return refused();
    };
    EXPECT_THAT(refusedColors(mGltf.addFloats({1, 1, 1, 1, 1, 1}, "VEC3")),
                HasSubstr("COLOR_0 has 2 elements, but there are 3 vertices"));
    EXPECT_THAT(refusedColors(mGltf.addFloats({1, 1, 1}, "SCALAR")),
                HasSubstr("COLOR_0 is of type SCALAR, not VEC3 or VEC4"));
    EXPECT_THAT(refusedColors(mGltf.addFloats({1, 1, 1, 1, NAN, 1, 1, 1, 1}, "VEC3")),
                HasSubstr("COLOR_0 of vertex 1 is not finite"));
    const int whole = mGltf.addView(bytesOf(std::vector<std::uint32_t>(9, 1)));
    EXPECT_THAT(refusedColors(mGltf.addAccessor(whole, "VEC3", 5125, 3)),
                HasSubstr("COLOR_0 has component type 5125, not 5121, 5123 or 5126"));
    EXPECT_THAT(refusedColors(99), HasSubstr("'COLOR_0' is 99, but the file has"));
}

TEST_F(GltfTest, AlphaModes) {
    mGltf.addTriangle();
    mGltf.json["materials"] = {{{"alphaMode", "MASK"}},
                               {{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}},
                               {{"alphaMode", "OPAQUE"}, {"alphaCutoff", 0.25}},
                               {{"alphaMode", "BLEND"}},
                               json::object()};
    const Scene scene = load();
    EXPECT_EQ(scene.materials[0].alphaCutoff, 0.5f);
    EXPECT_EQ(scene.materials[1].alphaCutoff, 0.25f);
    for (const std::size_t opaque : {2u, 3u, 4u, 5u}) { // the last is that of no material
        EXPECT_FALSE(scene.materials[opaque].alphaCutoff) << opaque;
    }
    EXPECT_THAT(scene.warnings,
                ElementsAre(HasSubstr("material 3: its alpha mode BLEND is ignored")));
    mGltf.json["materials"][1]["alphaCutoff"] = "low";
    EXPECT_THAT(refused(), HasSubstr("material 1: 'alphaCutoff' is not a finite number"));
    mGltf.json["materials"][1] = {{"alphaMode", 1}};
    EXPECT_THAT(refused(), HasSubstr("material 1: 'alphaMode' is not a string"));
}

TEST_F(GltfTest, EmissiveTextures) {
    mGltf.addTriangle();
    mGltf.json["images"] = {{{"bufferView", mGltf.addView(tinyPng())}, {"mimeType", "image/png"}},
                            {{"uri", "missing.png"}}};
    mGltf.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    const json strength = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2.5}}}};
    mGltf.json["materials"] = {
        {{"emissiveFactor", {1, 0.5, 0}},
         {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}},
         {"extensions", strength}},
        {{"emissiveTexture", {{"index", 0}}}}, // a factor of 0
        {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 1}}}}};
    const Scene scene = load();
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(2.5f, 1.25f, 0));
    EXPECT_TRUE(scene.materials[0].emissiveTexture.isSet());
    EXPECT_EQ(scene.materials[0].emissiveTexture.uvSet, 1);
    EXPECT_EQ(scene.materials[1].emission, glm::vec3(0));
    EXPECT_EQ(scene.materials[2].emission, glm::vec3(0)); // the factor alone would make all glow
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("missing.png': there is no such file")));
    mGltf.json["materials"][0]["emissiveTexture"]["index"] = 2;
    EXPECT_THAT(refused(), HasSubstr("'index' is 2, but the file has 2 textures"));
}

TEST_F(GltfTest, TextureRotationTurnsCounterClockwiseAsSeen) {
    mGltf.addTriangle();
    mGltf.json["images"] = {{{"bufferView", mGltf.addView(tinyPng())}, {"mimeType", "image/png"}}};
    mGltf.json["textures"] = {{{"source", 0}}};
    mGltf.json["materials"] = {
        {{"normalTexture",
          {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 0.3}}}}}}}}};
    const TextureReference texture = load().materials[0].normalTexture;
    const glm::vec3 right = texture.transform * glm::vec3(1, 0, 1);
    EXPECT_NEAR(right.x, std::cos(0.3), 1e-6);
    EXPECT_NEAR(right.y, -std::sin(0.3), 1e-6); // up, for v points down
}

TEST_F(GltfTest, PicturesThatLieAreWarnings) {
    std::string huge = tinyPng();
    huge[16] = '\x7f'; // a width of some 2 G
    std::string cut = tinyPng().substr(0, 50);
    std::string wide = tinyPng();
    mGltf.addTriangle();
    mGltf.json["images"] = {{{"bufferView", mGltf.addView(huge)}},
                            {{"bufferView", mGltf.addView(cut)}},
                            {{"bufferView", mGltf.addView("nothing of the kind")}},
                            {{"uri", "data:image/png;base64,AAA*"}},
                            {{"uri", "file:///etc/passwd"}},
                            {{"uri", "/etc/passwd"}}};
    for (int i = 0; i < 6; ++i) {
        mGltf.json["textures"].push_back({{"source", i}});
        mGltf.json["materials"].push_back({{"normalTexture", {{"index", i}}}});
    }
    const Scene scene = load();
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(scene.warnings.size(), 6u);
}

TEST_F(GltfTest, BuffersBesideTheFileAndWithinIt) {
    mGltf.addTriangle();
    json beside = mGltf.finished();
    beside["buffers"][0]["uri"] = "the%20data.bin";
    mFolder.write("the data.bin", mGltf.binary + "more than is needed");
    EXPECT_EQ(loadScene(mFolder.write("a.gltf", "\xef\xbb\xbf" + beside.dump())).meshes.size(), 1u);

    json missing = beside;
    missing["buffers"][0]["uri"] = "gone.bin";
    EXPECT_THAT(refusal(mFolder.write("a.gltf", missing.dump())),
                HasSubstr("gone.bin': there is no such file"));
    mFolder.write("short.bin", mGltf.binary.substr(0, 20));
    missing["buffers"][0]["uri"] = "short.bin";
    EXPECT_THAT(refusal(mFolder.write("a.gltf", missing.dump())),
                HasSubstr("buffer 0: 36 bytes are promised, 20 are there"));
    for (const char* const uri : {"/etc/passwd", "file:///etc/passwd", "http://a.b/c.bin", ""}) {
        missing["buffers"][0]["uri"] = uri;
        EXPECT_THAT(refusal(mFolder.write("a.gltf", missing.dump())),
                    HasSubstr("is not a relative path"));
    }

    json within = beside;
    within["buffers"][0]["uri"] = "data:application/octet-stream;base64,"
                                  "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    EXPECT_EQ(loadScene(mFolder.write("a.gltf", within.dump())).meshes[0].positions[1],
              glm::vec3(1, 0, 0));
    within["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAA*AAA";
    EXPECT_THAT(refusal(mFolder.write("a.gltf", within.dump())), HasSubstr("not valid base64"));
    within["buffers"][0].erase("uri");
    EXPECT_THAT(refusal(mFolder.write("a.gltf", within.dump())), HasSubstr("has no 'uri'"));
}

TEST_F(GltfTest, TheKindOfFileIsToldByItsBytes) {
    mGltf.addTriangle();
    EXPECT_EQ(loadScene(mFolder.write("a.gltf", mGltf.glb())).meshes.size(), 1u);
}

TEST_F(GltfTest, RequiredExtensionsThatWeLackAreNamed) {
    mGltf.addTriangle();
    mGltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_materials_ior",
                                        "EXT_wobble"};
    EXPECT_THAT(refused(), HasSubstr("requires KHR_draco_mesh_compression, EXT_wobble, which "
                                     "Celadon does not have; export it without Draco"));
    mGltf.json.erase("extensionsRequired");
    mGltf.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "KHR_materials_unlit"};
    EXPECT_THAT(load().warnings, ElementsAre(HasSubstr("ignores EXT_mesh_gpu_instancing")));
}

TEST_F(GltfTest, ExtensionsThatStandInForASubEditMaterialAreNotMissed) {
    mGltf.addTriangle();
    mGltf.json["extensionsUsed"] = {"KHR_materials_volume", "KHR_materials_diffuse_transmission"};
    nlohmann::json wax = {{"extensions",
                           {{"KHR_materials_volume", {{"thicknessFactor", 0.01}}},
                            {"KHR_materials_diffuse_transmission", nlohmann::json::object()}}},
                          {"extras", {{"subedit", "wax.subedit.exr"}}}};
    mGltf.json["materials"] = {wax};
    EXPECT_THAT(load().warnings, ElementsAre());
    wax.erase("extras");
    mGltf.json["materials"].push_back(wax);
    EXPECT_THAT(load().warnings, ElementsAre(HasSubstr("ignores KHR_materials_volume, KHR_mat")));
}

TEST_F(GltfTest, VersionsOtherThanTwoAreRefused) {
    mGltf.addTriangle();
    mGltf.json["asset"]["version"] = "1.0";
    EXPECT_THAT(refused(), HasSubstr("is glTF 1.0, not 2.0"));
    mGltf.json["asset"] = {{"version", "2.0"}, {"minVersion", "2.1"}};
    EXPECT_THAT(refused(), HasSubstr("is glTF 2.1"));
    mGltf.json.erase("asset");
    EXPECT_THAT(refused(), HasSubstr("does not say its version"));
}

TEST_F(GltfTest, ScenesWithoutTrianglesAreRefused) {
    mGltf.addTriangle();
    mGltf.primitive()["mode"] = 0;
    EXPECT_THAT(refused(), HasSubstr("shows no triangles"));
    mGltf.primitive()["mode"] = 4;
    mGltf.json["nodes"][0]["scale"] = {0, 0, 0};
    EXPECT_THAT(refused(), HasSubstr("shows no triangles"));
}

/// A change that makes a good file bad, and what must be said about it.
struct Damage {
    const char* name;
    const char* patch; ///< JSON merge patch of arrays by index: {"path": value}
    const char* says;
};

class GltfDamageTest : public testing::TestWithParam<Damage> {};

TEST_P(GltfDamageTest, IsNamed) {
    GltfBuilder gltf;
    gltf.addTriangle();
    gltf.json["accessors"][0]["name"] = "points";
    gltf.primitive()["indices"] = gltf.addIndices<std::uint16_t>({0, 1, 2});
    gltf.addFloats(std::vector<float>(16, 0.0f), "MAT4");
    json document = gltf.finished();
    const json patch = json::parse(GetParam().patch);
    for (const auto& change : patch.items()) {
        document[json::json_pointer(change.key())] = change.value();
    }
    gltf.json = document;
    const TemporaryFolder folder;
    EXPECT_THAT(refusal(folder.write("a.glb", gltf.glb())), HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfDamageTest,
    testing::Values(
        Damage{"AccessorPastItsView", R"({"/accessors/0/count": 4})",
               "accessor 0 'points': 4 elements of 12 bytes"},
        Damage{"AccessorOffsetPastItsView", R"({"/accessors/0/byteOffset": 1000})", "accessor 0"},
        Damage{"HugeCount", R"({"/accessors/0/count": 4000000000})",
               "accessor 0 'points': 'count'"},
        Damage{"OverflowingCount", R"({"/accessors/0/count": 18446744073709551615})", "'count'"},
        Damage{"NegativeCount", R"({"/accessors/0/count": -3})", "'count' is -3"},
        Damage{"FractionalCount", R"({"/accessors/0/count": 2.5})", "not a whole number"},
        Damage{"TextCount", R"({"/accessors/0/count": "3"})", "not a whole number"},
        Damage{"UnknownComponentType", R"({"/accessors/0/componentType": 5124})",
               "component type 5124 is unknown"},
        Damage{"UnknownType", R"({"/accessors/0/type": "VEC9"})", "type 'VEC9'"},
        Damage{"WrongType", R"({"/accessors/0/type": "VEC2"})", "POSITION is of type VEC2"},
        Damage{"NoSuchView", R"({"/accessors/0/bufferView": 7})", "the file has 3 buffer views"},
        Damage{"OverlappingStride", R"({"/bufferViews/0/byteStride": 4})", "are 4 bytes apart"},
        Damage{"WideStride", R"({"/bufferViews/0/byteStride": 100})", "100 apart"},
        Damage{"ViewPastItsBuffer", R"({"/bufferViews/0/byteLength": 9999})",
               "buffer view 0: its 9999 bytes"},
        Damage{"ViewOffsetOverflows", R"({"/bufferViews/0/byteOffset": 9223372036854775807})",
               "'byteOffset'"},
        Damage{"ViewLengthOverflows", R"({"/bufferViews/0/byteLength": 9223372036854775807})",
               "go past"},
        Damage{"BufferLongerThanTheFile", R"({"/buffers/0/byteLength": 2000000000})",
               "2000000000 bytes are promised"},
        Damage{"NoSuchAccessor", R"({"/meshes/0/primitives/0/attributes/POSITION": 9})",
               "'POSITION' is 9, but the file has 3 accessors"},
        Damage{"NegativeAccessor", R"({"/meshes/0/primitives/0/indices": -2})", "'indices' is -2"},
        Damage{"FloatIndices", R"({"/meshes/0/primitives/0/indices": 0})", "cannot hold indices"},
        Damage{"UnequalCounts", R"({"/meshes/0/primitives/0/attributes/NORMAL": 0,
                                    "/accessors/0/count": 2})",
               "index 2 at 2 is past the 2"},
        Damage{"UnknownMode", R"({"/meshes/0/primitives/0/mode": 7})", "'mode' is 7"},
        Damage{"NoSuchMaterial", R"({"/meshes/0/primitives/0/material": 0})",
               "mesh 0, primitive 0: 'material' is 0, but the file has 0 materials"},
        Damage{"NoSuchMesh", R"({"/nodes/0/mesh": 1})", "node 0: 'mesh' is 1"},
        Damage{"NodeIsItsOwnChild", R"({"/nodes/0/children": [0]})", "node 0: is its own ancestor"},
        Damage{"NodesInACircle",
               R"({"/nodes/1": {"children": [2]}, "/nodes/2": {"children": [1]}})",
               "node 1: is its own ancestor"},
        Damage{"NodeWithTwoParents",
               R"({"/nodes/1": {"children": [3]}, "/nodes/2": {"children": [3]}, "/nodes/3": {}})",
               "node 3: is a child of node 1 and of node 2"},
        Damage{"NoSuchChild", R"({"/nodes/0/children": [5]})", "'children' holds 5"},
        Damage{"SceneListsAChild", R"({"/nodes/1": {"children": [0]}})",
               "lists node 0, which is a child of node 1"},
        Damage{"ShortMatrix", R"({"/nodes/0/matrix": [1, 2, 3]})", "not an array of 16 numbers"},
        Damage{"InfiniteTransform", R"({"/nodes/0/translation": [1e300, 0, 0]})", "finite numbers"},
        Damage{"HugeTransform", R"({"/nodes/0/scale": [3e38, 3e38, 3e38],
                                    "/nodes/0/translation": [3e38, 3e38, 3e38]})",
               "beyond all numbers"},
        Damage{"WeightlessSkin", R"({"/skins/0": {"joints": []}, "/nodes/0/skin": 0})",
               "no joints"},
        Damage{"ShortSkin", R"({"/skins/0": {"joints": [0, 0], "inverseBindMatrices": 2}})",
               "does not hold 2 matrices"},
        Damage{"FlatCamera",
               R"({"/cameras/0": {"type": "perspective", "perspective": {"yfov": 4}}})",
               "'yfov' is 4"},
        Damage{"UnknownLight",
               R"({"/extensions": {"KHR_lights_punctual": {"lights": [{"type": "area"}]}}})",
               "type 'area' is unknown"},
        Damage{"InsideOutCone", R"({"/extensions": {"KHR_lights_punctual": {"lights": [
                   {"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}}]}}})",
               "cones of 1 and 0.5"},
        Damage{"NoSuchTexture", R"({"/materials/0": {"normalTexture": {"index": 0}}})",
               "'index' is 0, but the file has 0 textures"},
        Damage{"AbsoluteSubEdit", R"({"/materials/0": {"extras": {"subedit": "/etc/passwd"}}})",
               "'extras.subedit' is not a relative path"},
        Damage{"SparsePastItsView", R"({"/accessors/0/sparse": {"count": 3,
                   "indices": {"bufferView": 1, "componentType": 5125},
                   "values": {"bufferView": 0}}})",
               "3 elements of 4 bytes"},
        Damage{"SparseIndexPastTheEnd", R"({"/accessors/0/sparse": {"count": 1,
                   "indices": {"bufferView": 2, "componentType": 5121, "byteOffset": 0},
                   "values": {"bufferView": 0}}, "/bufferViews/2": {"buffer": 0,
                   "byteOffset": 15, "byteLength": 64}})",
               "sparse index 63 is past"},
        Damage{"ZerosFromNothing", R"({"/accessors/0": {"type": "VEC3", "componentType": 5126,
                   "count": 200000000}})",
               "200000000 zeros"},
        Damage{"ListInsteadOfObject", R"({"/nodes/0": [1]})", "node 0: is not an object"},
        Damage{"ObjectInsteadOfList", R"({"/nodes": {"a": 1}})", "'nodes' is not an array"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST_F(GltfTest, VerticesThatAreNoNumbersAreNamed) {
    const int positions = mGltf.addFloats({0, 0, 0, 1, 0, NAN, 0, 1, 0}, "VEC3");
    mGltf.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
    EXPECT_THAT(refused(), HasSubstr("accessor 0: POSITION of vertex 1 is not finite"));
}

TEST_F(GltfTest, InstancesBeyondMeasureAreRefusedBeforeTheyAreMade) {
    std::vector<std::uint32_t> indices(300000, 0);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        indices[i] = static_cast<std::uint32_t>(i % 3);
    }
    mGltf.addTriangle();
    mGltf.primitive()["indices"] = mGltf.addIndices(indices);
    mGltf.json["nodes"].clear();
    json all = json::array();
    for (int i = 0; i < 400; ++i) {
        mGltf.json["nodes"].push_back({{"mesh", 0}});
        all.push_back(i);
    }
    mGltf.json["scenes"] = {{{"nodes", all}}};
    EXPECT_THAT(refused(), HasSubstr("show more than 30000000 triangles"));
}

TEST_F(GltfTest, DeepChainsOfNodesAreFineAndDeepJsonIsRefused) {
    mGltf.addTriangle();
    for (int i = 0; i < 20000; ++i) {
        mGltf.json["nodes"][static_cast<std::size_t>(i)]["children"] = {i + 1};
        mGltf.json["nodes"].push_back(json::object());
    }
    EXPECT_EQ(load().meshes.size(), 1u);
    const std::string deep = R"({"asset": {"version": "2.0"}, "extras": )" +
                             std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_THAT(refusal(mFolder.write("deep.gltf", deep)), HasSubstr("nested deeper than 64"));
}

TEST_F(GltfTest, ContainersThatLieAreRefused) {
    mGltf.addTriangle();
    const std::string good = mGltf.glb();
    const auto with = [&](std::size_t at, std::uint32_t value) {
        std::string bad = good;
        std::memcpy(bad.data() + at, &value, 4);
        return refusal(mFolder.write("a.glb", bad));
    };
    EXPECT_THAT(with(4, 1), HasSubstr("is binary glTF version 1"));
    EXPECT_THAT(with(8, 4000000000u), HasSubstr("4000000000 bytes are promised"));
    EXPECT_THAT(with(12, 4000000000u), HasSubstr("chunk 0 has 4000000000 bytes"));
    EXPECT_THAT(with(16, 0), HasSubstr("first chunk is not JSON"));
    EXPECT_THAT(with(20, 0x7d7d7d7d), HasSubstr("line 1: is not valid JSON here"));
    EXPECT_THAT(with(0, 0x12345678), HasSubstr("neither JSON nor a binary glTF"));
    EXPECT_THAT(refusal(mFolder.write("a.glb", "glTF")), HasSubstr("4 bytes cannot hold"));
    EXPECT_THAT(refusal(mFolder.write("a.gltf", "{\n\"asset\": {\n]")), HasSubstr("line 3"));
}

} // namespace

} // namespace celadon
