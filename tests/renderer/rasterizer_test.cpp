// The processor finds the same triangles as the driver's rasterizer, and every pass shades them the
// same: with textures, cut-outs, vertex colors, several meshes, from close by and from lights.
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace celadon {
namespace {

using test::makeWorld;

constexpr glm::ivec2 kSize(160, 120);
constexpr double kEdges = 0.005; ///< of the pixels

class RasterizerTest : public test::GlTest {
protected:
    RenderedFrame frameBy(Rasterizer rasterizer, const World& world, const Camera& camera,
                          const std::vector<Light>& lights) {
        FrameSettings settings = test::smallFrame(kSize, 128, Scheme::Hierarchical);
        settings.specular = true;
        settings.coverageSamples = 8; // two draws
        settings.shadowSize = 256;
        settings.rasterizer = rasterizer;
        return test::renderFrame(context(), world, settings, camera, lights);
    }

    /// Pixels may differ where the two snap a corner to different sides of a sample: few, and at
    /// edges. All others agree to the precision of float.
    /// @param fraction of pixels that may differ
    void expectTheSame(const World& world, const Camera& camera, const std::vector<Light>& lights,
                       const std::string& what, double fraction = kEdges) {
        SCOPED_TRACE(what);
        const FloatImage driver = frameBy(Rasterizer::Driver, world, camera, lights).image;
        const FloatImage processor = frameBy(Rasterizer::Processor, world, camera, lights).image;
        ASSERT_EQ(driver.channels, processor.channels);
        const double pixels = kSize.x * kSize.y;
        for (std::size_t c = 0; c < driver.channels.size(); ++c) {
            const auto channel = static_cast<int>(c);
            double greatest = 0.0;
            int seen = 0;
            for (int i = 0; i < kSize.x * kSize.y; ++i) {
                const double value =
                    std::abs(static_cast<double>(driver.at(i % kSize.x, i / kSize.x, channel)));
                greatest = std::max(greatest, value);
                seen += value > 0.0 ? 1 : 0;
            }
            int differing = 0;
            double farthest = 0.0;
            for (int i = 0; i < kSize.x * kSize.y; ++i) {
                const auto a = static_cast<double>(driver.at(i % kSize.x, i / kSize.x, channel));
                const auto b = static_cast<double>(processor.at(i % kSize.x, i / kSize.x, channel));
                differing += std::abs(a - b) > 2e-3 * greatest ? 1 : 0;
                farthest = std::max(farthest, std::abs(a - b));
            }
            EXPECT_LT(differing, fraction * pixels) << driver.channels[c];
            if (driver.channels[c] == "A") {
                EXPECT_GT(seen, 0.02 * pixels);
                EXPECT_LE(farthest, fraction > kEdges ? 0.376 : 0.251); // samples of eight
            }
        }
    }
};

MaterialPointer wax() {
    return test::makeMaterial("wax", 8, 24, 12.0f, [](int x, int y) {
        return test::ProfileRecipe{.albedo = glm::dvec3(0.5 + 0.05 * ((x + y) % 8))};
    });
}

TEST_F(RasterizerTest, SameFramesOfBuiltins) {
    for (const char* const model : {"builtin:vase", "builtin:sphere"}) {
        const World world = makeWorld(model, wax());
        Camera camera = test::defaultCamera(world, kSize);
        expectTheSame(world, camera, {test::frontLight(), test::backLight()}, model);
        camera.orthographicHeight = 80.0;
        expectTheSame(world, camera, {test::frontLight()}, fmt::format("{}, parallel", model));
        // From inside, a light there as well: triangles behind the eye, cube faces.
        camera.orthographicHeight.reset();
        camera.eye = world.scatteringSphere.center + glm::dvec3(1.0, 2.0, 0.5);
        camera.fovYDegrees = 100.0;
        expectTheSame(world, camera,
                      {test::pointLight(world.scatteringSphere.center + glm::dvec3(3.0, 0.0, 1.0))},
                      fmt::format("{}, from inside", model));
    }
}

TEST_F(RasterizerTest, SameFramesOfTexturedModels) {
    if (!test::modelFolder()) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    for (const char* const model :
         {"gltf/BoxVertexColors.glb", "gltf/LightsPunctualLamp/LightsPunctualLamp.gltf",
          "gltf/SimpleInstancing.glb", "gltf/CesiumMan.glb", "mesh/spot_uv.obj"}) {
        if (!std::filesystem::exists(*test::modelFolder() / model)) {
            continue;
        }
        World world = makeWorld(model, wax());
        for (WorldMesh& mesh : world.meshes) {
            mesh.scattering = 0;
        }
        const Camera camera = test::defaultCamera(world, kSize);
        expectTheSame(world, camera, {test::frontLight()}, model);
    }
}

/// A wall of fine tiles with a texture, a normal map and holes, before a smaller one.
World walls() {
    Scene scene;
    scene.name = "walls";
    scene.millimetersPerUnit = 1.0;
    scene.materials.resize(2);
    for (int k = 0; k < 2; ++k) {
        Image image;
        image.name = k == 0 ? "picture" : "normals";
        image.width = image.height = 16;
        for (int i = 0; i < 256; ++i) {
            const int x = i % 16;
            const int y = i / 16;
            const auto part = [](int t) { return static_cast<std::uint8_t>(17 * t); };
            const bool isHole = k == 0 && (x / 4 + y / 4) % 3 == 0;
            image.rgba.insert(image.rgba.end(),
                              {k == 0 ? part(x) : std::uint8_t(100 + 3 * x),
                               k == 0 ? part(y) : std::uint8_t(150 - 3 * y),
                               std::uint8_t(k == 0 ? 90 : 230), std::uint8_t(isHole ? 0 : 255)});
        }
        scene.images.push_back(std::move(image));
    }
    scene.materials[0].baseColorTexture.image = 0;
    scene.materials[0].alphaCutoff = 0.5f;
    scene.materials[0].normalTexture.image = 1;
    scene.materials[0].roughness = 0.3f;
    scene.materials[0].doubleSided = true;
    for (int m = 0; m < 2; ++m) {
        Mesh mesh;
        mesh.name = "wall";
        mesh.material = m;
        const float half = m == 0 ? 50.0f : 30.0f;
        constexpr std::uint32_t kCells = 9;
        for (std::uint32_t i = 0; i < (kCells + 1) * (kCells + 1); ++i) {
            const glm::vec2 uv = glm::vec2(i % (kCells + 1), i / (kCells + 1)) / float(kCells);
            mesh.positions.emplace_back((2.0f * uv - 1.0f) * half, m == 0 ? 0.0f : -15.0f);
            mesh.normals.emplace_back(0, 0, 1);
            mesh.uvs.push_back(uv);
        }
        for (std::uint32_t y = 0; y < kCells; ++y) {
            for (std::uint32_t x = 0; x < kCells; ++x) {
                const std::uint32_t a = y * (kCells + 1) + x;
                const std::uint32_t b = a + kCells + 1;
                mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
            }
        }
        scene.meshes.push_back(std::move(mesh));
    }
    const std::vector<MaterialPointer> named{nullptr, test::shortRangeMaterial()};
    return buildWorld(std::move(scene), nullptr, named, nullptr, {});
}

TEST_F(RasterizerTest, SameFramesOfCutOutsAndNormalMaps) {
    // Along a straight rim a whole row of samples may lie on it: drivers interpolate and filter in
    // few bits there.
    constexpr double kRims = 0.025;
    const World world = walls();
    Camera camera;
    camera.at = glm::dvec3(0.0);
    camera.eye = {70.0, 40.0, 130.0};
    expectTheSame(world, camera, {test::directionalLight({0.2, -0.3, -1.0})}, "from the front",
                  kRims);
    camera.eye = {90.0, 5.0, 25.0};
    expectTheSame(world, camera, {test::directionalLight({0.2, -0.3, -1.0})}, "slantingly", kRims);
    camera.eye = {-20.0, -30.0, -140.0};
    expectTheSame(world, camera, {test::directionalLight({0.2, -0.3, 1.0})}, "from behind", kRims);
}

TEST_F(RasterizerTest, TrianglesWoundAgainstTheirNeighborsLookAsThey) {
    World sphere = makeWorld("builtin:sphere", wax());
    World scan = sphere;
    std::vector<std::uint32_t>& indices = scan.meshes[0].mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3 * 50) {
        std::swap(indices[i], indices[i + 1]);
    }
    const Camera camera = test::defaultCamera(sphere, kSize);
    for (const Rasterizer rasterizer : {Rasterizer::Driver, Rasterizer::Processor}) {
        SCOPED_TRACE(static_cast<int>(rasterizer));
        const FloatImage well = frameBy(rasterizer, sphere, camera, {test::frontLight()}).image;
        const FloatImage ill = frameBy(rasterizer, scan, camera, {test::frontLight()}).image;
        const int normal = well.channelIndex("normal.X");
        float brightest = 0.0f;
        for (int i = 0; i < kSize.x * kSize.y; ++i) {
            brightest = std::max(brightest, well.at(i % kSize.x, i / kSize.x, 0));
        }
        int seen = 0;
        for (int i = 0; i < kSize.x * kSize.y; ++i) {
            const int x = i % kSize.x;
            const int y = i / kSize.x;
            if (well.at(x, y, 3) < 1.0f || ill.at(x, y, 3) < 1.0f) {
                continue;
            }
            ++seen;
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(ill.at(x, y, normal + c), well.at(x, y, normal + c), 1e-3);
                // Not black; some is missing, since no light enters where a triangle turns its
                // back.
                EXPECT_GT(ill.at(x, y, c), 0.5f * well.at(x, y, c) - 0.02f * brightest)
                    << x << ' ' << y;
            }
        }
        EXPECT_GT(seen, 2000);
    }
}

TEST_F(RasterizerTest, AMovedViewLeavesNothingBehind) {
    // Passes that run only where something is seen must undo what they wrote elsewhere.
    const World world = makeWorld("builtin:vase", wax());
    FrameSettings settings = test::smallFrame(kSize, 64, Scheme::Hierarchical);
    settings.rasterizer = Rasterizer::Processor;
    const std::vector<Light> lights{test::frontLight()};
    const Camera near = test::defaultCamera(world, kSize);
    Camera far = near;
    far.eye = near.at + 4.0 * (near.eye - near.at);
    Camera beside = far;
    beside.at = far.at + 0.8 * glm::cross(near.eye - near.at, near.up);
    Camera away = near;
    away.at = 2.0 * near.eye - near.at;
    const auto lightOf = [](FrameRenderer& renderer) {
        std::vector<float> exitance;
        for (int level = 0; level < renderer.exitance().levels(); ++level) {
            const std::vector<float> texels = renderer.exitance().readLevel(level);
            exitance.insert(exitance.end(), texels.begin(), texels.end());
        }
        return exitance;
    };
    for (const int samples : {1, 4, 8}) {
        settings.coverageSamples = samples;
        FrameRenderer moved(context(), world, settings);
        for (const Camera& camera : {near, far, beside, away, near, beside}) {
            FrameRenderer fresh(context(), world, settings);
            EXPECT_EQ(moved.render(camera, lights).image.pixels,
                      fresh.render(camera, lights).image.pixels);
            EXPECT_EQ(lightOf(moved), lightOf(fresh));
        }
    }
}

TEST_F(RasterizerTest, RimsThatOneDrawOfSamplesSeesAreForgottenToo) {
    const World world = makeWorld("builtin:vase", wax());
    FrameSettings settings = test::smallFrame(kSize, 16, Scheme::Hierarchical);
    settings.rasterizer = Rasterizer::Processor;
    settings.coverageSamples = 16; // four draws
    const std::vector<Light> lights{test::frontLight()};
    FrameRenderer moved(context(), world, settings);
    const Camera start = test::defaultCamera(world, kSize);
    const glm::dvec3 side = 0.1 / kSize.x * glm::cross(start.at - start.eye, start.up);
    for (int i = 0; i < 80; ++i) { // by a tenth of a pixel or so: rims pass the borders of tiles
        Camera camera = start;
        camera.eye += double(i) * side;
        camera.at += double(i) * side;
        ASSERT_NE(moved.draw(camera, lights, nullptr), nullptr);
    }
    Camera away = start;
    away.at = 2.0 * start.eye - start.at;
    for (const float value : moved.draw(away, lights, nullptr)->readLevel()) {
        ASSERT_EQ(value, 0.0f);
    }
}

} // namespace
} // namespace celadon
