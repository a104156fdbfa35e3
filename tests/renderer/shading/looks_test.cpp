// What opaque parts look like: cut-outs let light and sight through and are seen where they are
// whole, vertex colors and emissive textures multiply; a material's own lobe maps are heard.
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <gtest/gtest.h>

#include <array>

namespace celadon {
namespace {

constexpr glm::ivec2 kSize(64, 64);

/// A square of 2 x 2 model units at height z, facing +z, uv (0,0) at its top left.
Mesh square(float z, float half, int material) {
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.material = material;
    return mesh;
}

Image picture(std::array<std::uint8_t, 4> left, std::array<std::uint8_t, 4> right) {
    Image image;
    image.name = "halves";
    image.width = 2;
    image.height = 1;
    image.rgba.insert(image.rgba.end(), left.begin(), left.end());
    image.rgba.insert(image.rgba.end(), right.begin(), right.end());
    return image;
}

/// A scattering slab of 100 mm below a small opaque square whose look is `look`; texture 0 is
/// `texture`.
World world(SurfaceMaterial look, Image texture) {
    Scene scene;
    scene.name = "squares";
    scene.millimetersPerUnit = 1.0;
    scene.materials.resize(2);
    scene.materials[1] = std::move(look);
    scene.images.push_back(std::move(texture));
    scene.meshes = {square(0.0f, 50.0f, 0), square(20.0f, 25.0f, 1)};
    const std::vector<MaterialPointer> named{test::shortRangeMaterial(), nullptr};
    return buildWorld(std::move(scene), nullptr, named, nullptr, {});
}

TextureReference nearestTexture() {
    TextureReference reference;
    reference.image = 0;
    reference.nearest = true;
    return reference;
}

class Looks : public test::GlTest {
protected:
    RenderedFrame frameOf(const World& world) {
        Camera camera;
        camera.eye = {0.0, 0.0, 200.0};
        camera.at = glm::dvec3(0.0);
        camera.orthographicHeight = 100.0;
        const std::array lights{test::directionalLight({0.0, 0.0, -1.0})};
        FrameSettings settings = test::smallFrame(kSize, 128);
        settings.statistics = true;
        return test::renderFrame(context(), world, settings, camera, lights);
    }
    static glm::vec3 at(const FloatImage& image, int x, int y) {
        return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    }
};

TEST_F(Looks, CutOutsLetLightAndSightThrough) {
    SurfaceMaterial look;
    look.baseColorTexture = nearestTexture();
    const Image halves = picture({255, 255, 255, 0}, {255, 255, 255, 255});
    const RenderedFrame whole = frameOf(world(look, halves));
    look.alphaCutoff = 0.5f;
    const RenderedFrame cut = frameOf(world(look, halves));
    // The square covers a quarter of the slab; its left half is not there.
    const double lit = cut.stats.flux.lit[1];
    EXPECT_NEAR(whole.stats.flux.lit[1] / lit, 0.75 / 0.875, 0.02);
    EXPECT_TRUE(test::seesScattering(cut.image, {24, 32}));
    EXPECT_FALSE(test::seesScattering(cut.image, {40, 32}));
    EXPECT_FALSE(test::seesScattering(whole.image, {24, 32}));
    // What is lit through the hole glows like the rest of the slab.
    EXPECT_NEAR(test::exitanceAt(cut.image, {24, 32}).y, test::exitanceAt(cut.image, {8, 32}).y,
                0.05 * test::exitanceAt(cut.image, {8, 32}).y);
}

TEST_F(Looks, VertexColorsMultiplyTheBaseColor) {
    SurfaceMaterial look;
    look.baseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    World plain = world(look, picture({0, 0, 0, 255}, {0, 0, 0, 255}));
    World colored = plain;
    colored.meshes[1].mesh.colors.assign(4, glm::vec4(1.0f, 0.5f, 0.0f, 1.0f));
    const glm::vec3 before = at(frameOf(plain).image, 32, 32);
    const glm::vec3 after = at(frameOf(colored).image, 32, 32);
    EXPECT_GT(before.g, 0.1f);
    EXPECT_NEAR(after.r, before.r, 1e-5f);
    EXPECT_NEAR(after.g, 0.5f * before.g, 1e-4f);
    EXPECT_EQ(after.b, 0.0f);
}

TEST_F(Looks, EmissiveTexturesMultiplyTheFactor) {
    SurfaceMaterial look;
    look.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    look.emission = glm::vec3(2.0f, 4.0f, 8.0f);
    look.emissiveTexture = nearestTexture();
    const FloatImage image =
        frameOf(world(look, picture({255, 0, 255, 255}, {0, 255, 0, 255}))).image;
    const glm::vec3 left = at(image, 24, 32);
    const glm::vec3 right = at(image, 40, 32);
    EXPECT_NEAR(left.r, 2.0f, 5e-3f); // stored in halves
    EXPECT_NEAR(left.g, 0.0f, 5e-3f);
    EXPECT_NEAR(left.b, 8.0f, 2e-2f);
    EXPECT_NEAR(right.g, 4.0f, 1e-2f);
    EXPECT_NEAR(right.r, 0.0f, 5e-3f);
}

TEST_F(Looks, LobeMapsOfTheMaterialAreHeard) {
    const auto material =
        std::make_shared<subedit::MaterialMap>(*test::homogeneousMaterial(1.0, "painted"));
    const auto highlight = [&] {
        Scene scene;
        scene.millimetersPerUnit = 1.0;
        scene.materials.resize(1);
        scene.meshes = {square(0.0f, 50.0f, 0)};
        const World slab = buildWorld(std::move(scene), material, {nullptr}, nullptr, {});
        Camera camera;
        camera.eye = {0.0, 0.0, 200.0};
        camera.orthographicHeight = 100.0;
        const std::array lights{test::directionalLight({0.0, 0.0, -1.0})};
        FrameSettings settings = test::smallFrame(kSize, 32);
        const float without =
            test::renderFrame(context(), slab, settings, camera, lights).image.at(32, 32, 1);
        settings.specular = true;
        return test::renderFrame(context(), slab, settings, camera, lights).image.at(32, 32, 1) -
               without;
    };
    const float plain = highlight();
    material->roughness = {0.7f};
    const float rough = highlight();
    material->specular = {0.5f};
    const float half = highlight();
    EXPECT_GT(plain, 0.0f);
    // Straight on, D = 1 / (pi alpha^2): from roughness 0.35 to 0.7 a sixteenth.
    EXPECT_NEAR(rough / plain, 1.0f / 16.0f, 2e-3f);
    EXPECT_NEAR(half / rough, 0.5f, 1e-2f);
}

} // namespace
} // namespace celadon
