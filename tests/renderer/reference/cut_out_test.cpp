// Cut-outs for rays: where a picture's alpha leaves surface, and that light passes through the
// rest.
#include "reference_support.h"
#include "renderer/reference/cut_out.h"
#include "renderer/reference/light_view.h"
#include "renderer/reference/surface_reference.h"
#include "tests/support/tolerance.h"

#include <gtest/gtest.h>

#include <array>

namespace celadon {
namespace {

using namespace celadon::testing;

/// One row of texels of the given alpha; the color does not matter.
Image alphaRow(const std::vector<std::uint8_t>& alphas) {
    Image image;
    image.width = static_cast<int>(alphas.size());
    image.height = 1;
    for (const std::uint8_t alpha : alphas) {
        image.rgba.insert(image.rgba.end(), {255, 255, 255, alpha});
    }
    return image;
}

/// A scattering slab 100 mm wide, with an opaque square of `size` mm above it whose base color is
/// `image`.
World slabBelowSquare(double size, const Image& image, bool nearest) {
    World world = makeWorld({{makeSlab(100, 16)}, {makeSlab(size, 1, 20)}},
                            {makeHomogeneous({1, 1, 1}, 20, glm::dvec3(0.9), 1.0f)});
    world.meshes[1].scattering = -1;
    world.looks.resize(2);
    world.meshes[1].mesh.material = 1;
    SurfaceMaterial& look = world.looks[1];
    look.alphaCutoff = 0.5f;
    look.baseColorTexture.image = 0;
    look.baseColorTexture.nearest = nearest;
    world.images = {image};
    return world;
}

/// Whether the square is cut out at a texture coordinate within its first triangle's unit square.
bool isCutOutAt(const World& world, double u, double v) {
    // The grid's first triangle has the corners (0, 0), (1, 0), (1, 1) of the texture.
    return isCutOut(world, {1, 0, u - v, v});
}

TEST(CutOut, NearestTexelsWithEachWrap) {
    World world = slabBelowSquare(50, alphaRow({255, 0, 0, 255}), true);
    SurfaceMaterial& look = world.looks[1];
    const auto isCutOutAlong = [&](double scale, double offset) {
        look.baseColorTexture.transform = glm::mat3(scale, 0, 0, 0, 1, 0, offset, 0, 1);
        std::string row;
        for (int i = 0; i < 8; ++i) {
            row += isCutOutAt(world, (i + 0.5) / 8.0, 0.01) ? '.' : '#';
        }
        return row;
    };
    EXPECT_EQ(isCutOutAlong(1, 0), "##....##");
    EXPECT_EQ(isCutOutAlong(2, 0), "#..##..#");
    EXPECT_EQ(isCutOutAlong(2, -1e6), "#..##..#");
    world.images[0] = alphaRow({255, 255, 0, 0});
    EXPECT_EQ(isCutOutAlong(2, 0), "##..##..");
    EXPECT_EQ(isCutOutAlong(2, -1), "##..##..");
    look.baseColorTexture.wrapU = Wrap::MirroredRepeat;
    EXPECT_EQ(isCutOutAlong(2, 0), "##....##");
    EXPECT_EQ(isCutOutAlong(2, -1), "..####..");
    look.baseColorTexture.wrapU = Wrap::ClampToEdge;
    EXPECT_EQ(isCutOutAlong(2, 0), "##......");
    EXPECT_EQ(isCutOutAlong(2, -1), "######..");
}

TEST(CutOut, LinearFilteringPutsTheRimWhereAlphaIsTheCutoff) {
    World world = slabBelowSquare(50, alphaRow({255, 0}), false);
    world.looks[1].baseColorTexture.wrapU = Wrap::ClampToEdge;
    // From 1 at u = 1/4 to 0 at u = 3/4.
    for (const float cutoff : {0.2f, 0.5f, 0.9f}) {
        world.looks[1].alphaCutoff = cutoff;
        const double rim = 0.25 + 0.5 * (1.0 - static_cast<double>(cutoff));
        EXPECT_FALSE(isCutOutAt(world, rim - 1e-6, 0.01)) << cutoff;
        EXPECT_TRUE(isCutOutAt(world, rim + 1e-6, 0.01)) << cutoff;
    }
}

TEST(CutOut, AlphaIsThatOfTheBaseColorAndCountsOnlyWhereItCuts) {
    World world = slabBelowSquare(50, alphaRow({255}), true);
    SurfaceMaterial& look = world.looks[1];
    look.baseColor.a = 0.5f;
    EXPECT_FALSE(isCutOutAt(world, 0.5, 0.1)); // at the cutoff: surface
    look.baseColor.a = 0.49f;
    EXPECT_TRUE(isCutOutAt(world, 0.5, 0.1));
    look.alphaCutoff.reset();
    EXPECT_FALSE(isCutOutAt(world, 0.5, 0.1));
    look.alphaCutoff = 0.5f;
    look.baseColor.a = 1.0f;
    world.images[0] = alphaRow({0, 255});
    EXPECT_TRUE(isCutOutAt(world, 0.25, 0.1));
    world.meshes[1].mesh.uvs1.assign(world.meshes[1].mesh.uvs.size(), glm::vec2(0.75f, 0.5f));
    look.baseColorTexture.uvSet = 1;
    EXPECT_FALSE(isCutOutAt(world, 0.25, 0.1));
}

TEST(CutOut, VertexAlphaMultiplies) {
    World world = slabBelowSquare(50, alphaRow({255}), true);
    world.looks[1].baseColor.a = 0.8f;
    Mesh& mesh = world.meshes[1].mesh;
    for (const glm::vec2 uv : mesh.uvs) {
        mesh.colors.emplace_back(1.0f, 1.0f, 1.0f, uv.x); // 0.5 = 0.8 u at u = 0.625
    }
    EXPECT_TRUE(isCutOutAt(world, 0.624, 0.01));
    EXPECT_FALSE(isCutOutAt(world, 0.626, 0.01));
}

TEST(CutOut, ShadowHasTheAreaOfWhatIsLeft) {
    // Two holes and two bars, each a quarter of the square, which covers a quarter of the slab.
    World world = slabBelowSquare(50, alphaRow({255, 0, 255, 0}), true);
    const Light light = directionalLight({0, 0, -1});
    const double slab = 0.1 * 0.1; // m^2
    const auto byLightView = [&] {
        double sum = 0;
        for (const Patch& patch : lightViewPatches(world, light, 512)) {
            sum += static_cast<double>(patch.flux.x);
        }
        return sum / slab;
    };
    const auto bySurface = [&] {
        double sum = 0;
        const SurfaceReference reference(world);
        for (const Patch& patch : reference.samplePatches(std::array{light}, 40000, 7).patches) {
            sum += static_cast<double>(patch.flux.x);
        }
        return sum / slab;
    };
    // Rims of 4 x 50 mm, known to a texel of 0.3 mm or to a cell of 0.5 mm on either side.
    EXPECT_NEAR(byLightView(), 1.0 - 0.125, 5e-3);
    EXPECT_NEAR(bySurface(), 1.0 - 0.125, 5e-3);
    world.looks[1].alphaCutoff.reset();
    EXPECT_NEAR(byLightView(), 1.0 - 0.25, 5e-3);
    EXPECT_NEAR(bySurface(), 1.0 - 0.25, 5e-3);
}

TEST(CutOut, SurfaceThatIsCutOutTakesNoLight) {
    World world = slabBelowSquare(50, alphaRow({255, 0, 0, 0}), true);
    world.meshes[1].scattering = 0; // the square scatters as well, and nothing is below it
    world.meshes.erase(world.meshes.begin());
    const Light light = directionalLight({0, 0, -1});
    double sum = 0;
    const SurfaceReference reference(world);
    for (const Patch& patch : reference.samplePatches(std::array{light}, 10000, 3).patches) {
        sum += static_cast<double>(patch.flux.x);
    }
    EXPECT_NEAR(sum / (0.05 * 0.05), 0.25, 5e-3);
}

} // namespace
} // namespace celadon
