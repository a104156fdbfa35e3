// What the model's looks do to light and to the picture: cut-outs let light and sight through, the
// same for the camera, for lights and for rays.
#include "renderer/frame_quality.h"
#include "renderer/reference/ray_scene.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {
namespace {

using Texel = std::array<std::uint8_t, 4>;

constexpr glm::ivec2 kSize(64, 64);
constexpr double kViewMm = 100.0; ///< what the view of frameOf() spans

/// Square about the z axis at height z, facing +z; (0, 0) of the texture at its top left.
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

Image pictureOf(int width, const std::vector<Texel>& texels) {
    Image image;
    image.name = "picture";
    image.width = width;
    image.height = static_cast<int>(texels.size()) / width;
    for (const Texel& texel : texels) {
        image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    }
    return image;
}

TextureReference texture(bool nearest = true) {
    TextureReference reference;
    reference.image = 0;
    reference.nearest = nearest;
    return reference;
}

/// A slab of 100 mm below an opaque square of 50 mm with the given look.
/// @param scatters  else the slab is opaque as well, and only what hides below it scatters
World slabBelowSquare(const SurfaceMaterial& look, const Image& picture, bool scatters = true) {
    Scene scene;
    scene.name = "squares";
    scene.millimetersPerUnit = 1.0;
    scene.materials.resize(3);
    scene.materials[1] = look;
    scene.images.push_back(picture);
    scene.meshes = {square(0.0f, 50.0f, scatters ? 0 : 2), square(20.0f, 25.0f, 1)};
    if (!scatters) {
        scene.meshes.push_back(square(-1.0f, 50.0f, 0));
    }
    const std::vector<MaterialPointer> named{test::shortRangeMaterial(), nullptr, nullptr};
    return buildWorld(std::move(scene), nullptr, named, nullptr, {});
}

Camera cameraAbove() {
    Camera camera;
    camera.eye = {0.0, 0.0, 200.0};
    camera.at = glm::dvec3(0.0);
    camera.orthographicHeight = kViewMm;
    return camera;
}

class Looks : public test::GlTest {
protected:
    RenderedFrame frameOf(const World& world, const FrameSettings& settings,
                          const Light& light = test::directionalLight({0.0, 0.0, -1.0})) {
        return test::renderFrame(context(), world, settings, cameraAbove(), std::array{light});
    }
    RenderedFrame frameOf(const World& world) {
        FrameSettings settings = test::smallFrame(kSize, 256);
        settings.statistics = true;
        return frameOf(world, settings);
    }
    static glm::vec3 colorAt(const FloatImage& image, glm::ivec2 pixel) {
        return {image.at(pixel.x, pixel.y, 0), image.at(pixel.x, pixel.y, 1),
                image.at(pixel.x, pixel.y, 2)};
    }
};

TEST_F(Looks, CutOutsCastAShadowOfTheirOwnArea) {
    SurfaceMaterial look;
    look.baseColorTexture = texture();
    const Image halves = pictureOf(2, {{255, 255, 255, 0}, {255, 255, 255, 255}});
    const RenderedFrame whole = frameOf(slabBelowSquare(look, halves));
    look.alphaCutoff = 0.5f;
    const RenderedFrame cut = frameOf(slabBelowSquare(look, halves));
    // The square covers a quarter of the slab; its left half is not there.
    EXPECT_NEAR(whole.stats.flux.lit[1] / cut.stats.flux.lit[1], 0.75 / 0.875, 5e-3);
    EXPECT_FALSE(test::seesScattering(whole.image, {24, 32}));
    EXPECT_TRUE(test::seesScattering(cut.image, {24, 32}));
    EXPECT_FALSE(test::seesScattering(cut.image, {40, 32}));
    // What is lit through the hole glows like the slab beside the square.
    const double beside = test::exitanceAt(cut.image, {8, 32}).y;
    EXPECT_GT(beside, 0.0);
    EXPECT_NEAR(test::exitanceAt(cut.image, {24, 32}).y, beside, 0.01 * beside);
}

TEST_F(Looks, CutOutsAreTheSameForTheCameraAndForRays) {
    std::vector<Texel> texels;
    for (int i = 0; i < 7 * 5; ++i) {
        texels.push_back({255, 255, 255, static_cast<std::uint8_t>((i * 97 + i * i * 31) % 256)});
    }
    SurfaceMaterial look;
    look.baseColor.a = 0.9f;
    look.alphaCutoff = 0.4f;
    for (const bool nearest : {false, true}) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
            look.baseColorTexture = texture(nearest);
            look.baseColorTexture.wrapU = look.baseColorTexture.wrapV = wrap;
            look.baseColorTexture.transform = // scaled, turned, moved beyond the picture
                glm::mat3(1.7f, -0.6f, 0.0f, 0.8f, 1.3f, 0.0f, -0.6f, 0.3f, 1.0f);
            const World world = slabBelowSquare(look, pictureOf(7, texels));
            const FloatImage image = frameOf(world, test::smallFrame(kSize, 32)).image;
            const RayScene rays(world);
            int different = 0;
            int holes = 0;
            for (int y = 16; y < 48; ++y) { // where the square is
                for (int x = 16; x < 48; ++x) {
                    const glm::dvec2 place((x + 0.5) / kSize.x - 0.5, 0.5 - (y + 0.5) / kSize.y);
                    const auto hit =
                        rays.nearest(glm::dvec3(kViewMm * place, 200.0), {0.0, 0.0, -1.0});
                    ASSERT_TRUE(hit);
                    const bool isHole = test::seesScattering(image, {x, y});
                    holes += isHole ? 1 : 0;
                    different += isHole != (hit->place.mesh == 0) ? 1 : 0;
                }
            }
            EXPECT_GT(holes, 200);
            EXPECT_LT(holes, 800);
            // At rims only: GPUs filter with 8 bits.
            EXPECT_LE(different, 8) << nearest << " " << static_cast<int>(wrap);
        }
    }
}

TEST_F(Looks, RimsOfHolesAreAntialiased) {
    // A ramp of alpha across the square: the hole ends 1/4 of a pixel into a column of pixels.
    SurfaceMaterial look;
    look.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    look.alphaCutoff = 0.5f;
    look.baseColorTexture = texture(false);
    look.baseColorTexture.wrapU = Wrap::ClampToEdge;
    look.baseColorTexture.transform[2][0] = 0.25f / 32.0f; // the square is 32 pixels wide
    look.emission = glm::vec3(1.0f);
    const World world =
        slabBelowSquare(look, pictureOf(2, {{255, 255, 255, 255}, {255, 255, 255, 0}}));
    FrameSettings settings = test::smallFrame(kSize, 32);
    settings.coverageSamples = 4; // of one draw, within their pixel
    const FloatImage image =
        frameOf(world, settings, test::directionalLight({0.0, 0.0, 1.0})).image; // the slab is dark
    EXPECT_NEAR(colorAt(image, {30, 32}).g, 1.0f, 1e-3f);
    EXPECT_NEAR(colorAt(image, {31, 32}).g, 0.75f, 0.13f); // one sample in each quarter
    EXPECT_NEAR(colorAt(image, {32, 32}).g, 0.0f, 1e-3f);
}

TEST_F(Looks, OpaquePartsAreLitThroughHoles) {
    SurfaceMaterial look;
    look.baseColorTexture = texture();
    look.alphaCutoff = 0.5f;
    const World world =
        slabBelowSquare(look, pictureOf(2, {{255, 255, 255, 0}, {255, 255, 255, 255}}), false);
    FrameSettings settings = test::smallFrame(kSize, 32);
    settings.shadowSize = 512;
    // Light from the right reaches the slab below the left half, and shadows what lies further
    // left.
    const Light light = test::directionalLight({-0.5, 0.0, -1.0});
    const FloatImage image = frameOf(world, settings, light).image;
    const float beside = colorAt(image, {60, 32}).g;
    EXPECT_GT(beside, 0.05f);
    // At height 20 the shadow moves by 10 mm, 6.4 pixels, to the left: whole from x = 25.6 to 41.6.
    EXPECT_NEAR(colorAt(image, {20, 32}).g, beside, 1e-3f * beside); // through the hole
    EXPECT_EQ(colorAt(image, {28, 32}).g, 0.0f); // in the shadow, seen through it
}

TEST_F(Looks, VertexColorsMultiplyTheBaseColor) {
    SurfaceMaterial look;
    look.baseColor = glm::vec4(0.8f, 0.6f, 0.4f, 1.0f);
    look.baseColorTexture = texture();
    const Image halves = pictureOf(2, {{255, 255, 255, 255}, {0, 255, 255, 255}});
    const World plain = slabBelowSquare(look, halves);
    World colored = plain;
    std::vector<glm::vec4>& colors = colored.meshes[1].mesh.colors;
    for (const glm::vec2 uv : colored.meshes[1].mesh.uvs) {
        colors.emplace_back(0.5f, uv.x, 0.0f, 1.0f);
    }
    const FrameSettings settings = test::smallFrame(kSize, 32);
    const FloatImage before = frameOf(plain, settings).image;
    const FloatImage after = frameOf(colored, settings).image;
    for (const glm::ivec2 pixel : {glm::ivec2(20, 32), glm::ivec2(44, 20)}) {
        const glm::vec3 was = colorAt(before, pixel);
        const glm::vec3 is = colorAt(after, pixel);
        const float u = (static_cast<float>(pixel.x) + 0.5f - 16.0f) / 32.0f;
        EXPECT_GT(was.g, 0.1f);
        EXPECT_NEAR(is.r, 0.5f * was.r, 1e-3f * was.r); // stored in halves
        EXPECT_NEAR(is.g, u * was.g, 1e-3f * was.g);
        EXPECT_EQ(is.b, 0.0f);
    }
    EXPECT_EQ(colorAt(after, {8, 32}), colorAt(before, {8, 32})); // meshes without are as they were
}

TEST_F(Looks, EmissionIsFactorTimesTextureWithoutLight) {
    SurfaceMaterial look;
    look.emission = glm::vec3(2.0f, 4.0f, 1e9f);
    look.emissiveTexture = texture();
    // sRGB 188 is 0.5029 linear (IEC 61966-2-1).
    const World world = slabBelowSquare(look, pictureOf(2, {{255, 0, 0, 255}, {0, 188, 255, 255}}));
    FrameSettings settings = test::smallFrame(kSize, 32);
    settings.coverageSamples = 4;
    const FloatImage image =
        frameOf(world, settings, test::directionalLight({0.0, 0.0, -1.0}, glm::dvec3(0.0))).image;
    EXPECT_EQ(colorAt(image, {24, 32}), glm::vec3(2.0f, 0.0f, 0.0f));
    EXPECT_EQ(colorAt(image, {40, 32}).r, 0.0f);
    EXPECT_NEAR(colorAt(image, {40, 32}).g, 4.0f * 0.5029f, 4e-3f); // stored in halves
    EXPECT_EQ(colorAt(image, {40, 32}).b, 65504.0f);                // the largest one
    EXPECT_EQ(colorAt(image, {8, 32}), glm::vec3(0.0f));
}

TEST_F(Looks, EmissionAddsToReflectedLight) {
    SurfaceMaterial look;
    const Image halves = pictureOf(2, {{255, 255, 255, 255}, {0, 0, 0, 255}});
    const FrameSettings settings = test::smallFrame(kSize, 32);
    const FloatImage dark = frameOf(slabBelowSquare(look, halves), settings).image;
    look.emission = glm::vec3(0.5f);
    look.emissiveTexture = texture();
    const FloatImage glowing = frameOf(slabBelowSquare(look, halves), settings).image;
    EXPECT_GT(colorAt(dark, {24, 32}).g, 0.1f);
    EXPECT_NEAR(colorAt(glowing, {24, 32}).g - colorAt(dark, {24, 32}).g, 0.5f, 1e-6f);
    EXPECT_EQ(colorAt(glowing, {40, 32}), colorAt(dark, {40, 32}));
}

// A sketch has no antialiasing, which would replace pixels at silhouettes whose normals turn away.
TEST_F(Looks, SketchesHaveNoDarkRims) {
    const World world = test::makeWorld("builtin:vase", test::shortRangeMaterial());
    FrameSettings settings = frameSettings(Quality::Sketch);
    settings.size = glm::ivec2(160);
    settings.specular = false;
    settings.layers = true;
    const std::vector<Light> lights{test::frontLight()};
    const FloatImage image = test::renderFrame(context(), world, settings,
                                               test::defaultCamera(world, settings.size), lights)
                                 .image;
    const int exitance = image.channelIndex("exitance.R");
    float least = 1e30f;
    float greatest = 0.0f;
    int seen = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y, exitance) > 1e-3f) {
                const float transmitted = image.at(x, y, 0) / image.at(x, y, exitance);
                least = std::min(least, transmitted);
                greatest = std::max(greatest, transmitted);
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 3000);
    EXPECT_GT(least, 0.7f * greatest); // the Fresnel terms of 0.25 and 1
}

} // namespace
} // namespace celadon
