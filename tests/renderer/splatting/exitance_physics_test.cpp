// What physics says of the exitance, whatever the scheme: linear in the light, independent of the
// camera, B = A F_t H on a large plane, and the flux that a sphere takes in, in closed form.
#include "renderer/shading/fresnel.h"
#include "subedit/radius_map.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <numbers>
#include <vector>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(96, 72);

class ExitancePhysics : public test::GlTest, public testing::WithParamInterface<Scheme> {
protected:
    FloatImage render(const World& world, const FrameSettings& settings, const Camera& camera,
                      const std::vector<Light>& lights) {
        FloatImage image = test::renderFrame(context(), world, settings, camera, lights).image;
        EXPECT_FALSE(findNonFinite(image).has_value());
        return image;
    }
    FloatImage exitance(const World& world, const std::vector<Light>& lights) {
        return extractLayer(render(world, test::smallFrame(kPicture, 64, GetParam()),
                                   test::defaultCamera(world, kPicture), lights),
                            "exitance");
    }
};

TEST_P(ExitancePhysics, ALargePlaneGivesBackItsAlbedo) {
    // Texels of the light view are 0.56 mm: the core of the finer profile is as small.
    for (const double lengthMm : {2.0, 1.5}) {
        const MaterialPointer material = test::homogeneousMaterial(lengthMm);
        const World world = test::makeWorld("builtin:slab", material);
        const glm::dvec3 center = world.scatteringSphere.center;
        Camera camera; // a steep view of the middle of the large face, r_s away from its edges
        camera.at = center + glm::dvec3(0.0, 10.0, 0.0);
        camera.eye = camera.at + glm::dvec3(20.0, 140.0, 30.0);
        camera.up = {0.0, 0.0, -1.0};
        camera.fovYDegrees = 8.0;
        const glm::dvec3 H(2.0, 1.0, 0.5);
        const FloatImage image = render(world, test::smallFrame(kPicture, 256, GetParam()), camera,
                                        {test::directionalLight({0.0, -1.0, 0.0}, H)});
        const glm::dvec3 expected = subedit::diffuseAlbedo(subedit::profileAt(*material, 0, 0)) *
                                    fresnelTransmittance(1.0, static_cast<double>(material->eta)) *
                                    H;
        glm::dvec3 mean(0.0);
        glm::dvec3 worst(0.0);
        int pixels = 0;
        for (int y = 0; y < kPicture.y; ++y) {
            for (int x = 0; x < kPicture.x; ++x) {
                const glm::dvec3 position = test::positionAt(image, {x, y}) - center;
                const double edge = 50.0 - std::max(std::abs(position.x), std::abs(position.z));
                if (!test::seesScattering(image, {x, y}) ||
                    edge < static_cast<double>(material->maxRadiusMm)) {
                    continue;
                }
                const glm::dvec3 ratio = test::exitanceAt(image, {x, y}) / expected;
                mean += ratio;
                worst = glm::max(worst, glm::abs(ratio - 1.0));
                ++pixels;
            }
        }
        ASSERT_GT(pixels, kPicture.x * kPicture.y / 2);
        mean /= pixels;
        fmt::print(
            "[ measured ] slab {} mm: B / (A F_t H) = {:.5f} {:.5f} {:.5f}, worst pixel {:.5f} "
            "{:.5f} {:.5f}\n",
            lengthMm, mean.x, mean.y, mean.z, worst.x, worst.y, worst.z);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], 1.0, test::kSlabExitance) << lengthMm << " mm, channel " << c;
        }
    }
}

TEST_P(ExitancePhysics, IsLinearInTheLights) {
    for (const char* const material : {"long", "chessboard"}) {
        const World world = test::makeWorld("builtin:vase", test::materialNamed(material));
        const Light first = test::frontLight({1.0, 0.5, 0.25});
        const Light second = test::backLight({0.2, 0.7, 1.5});
        Light twice = first;
        twice.color *= 2.0;
        const FloatImage one = exitance(world, {first});
        const FloatImage two = exitance(world, {twice});
        const FloatImage other = exitance(world, {second});
        const FloatImage both = exitance(world, {first, second});
        FloatImage doubled = one;
        FloatImage sum = one;
        for (std::size_t i = 0; i < one.pixels.size(); ++i) {
            doubled.pixels[i] *= 2.0f;
            sum.pixels[i] += other.pixels[i];
        }
        const double doubling = compareValues(two, doubled).relativeRmse;
        const double adding = compareValues(both, sum).relativeRmse;
        fmt::print("[ measured ] vase {}: twice the light {:.2g}, sum of lights {:.2g}\n", material,
                   doubling, adding);
        EXPECT_GT(compareValues(one, one).peak, 0.0);
        EXPECT_LT(doubling, test::kSameFormula);
        EXPECT_LT(adding, test::kSameFormula);
    }
}

TEST_P(ExitancePhysics, NoLightIsNoExitance) {
    const World world = test::makeWorld("builtin:sphere", test::mediumRangeMaterial());
    EXPECT_THAT(exitance(world, {}).pixels, testing::Each(0.0f));
    EXPECT_THAT(exitance(world, {test::frontLight(glm::dvec3(0.0))}).pixels, testing::Each(0.0f));
}

TEST_P(ExitancePhysics, IsPositiveAndNeverAboveTheLight) {
    // B <= max A F_t H on a convex body, within the light that one texel's patch may gain.
    const World world = test::makeWorld("builtin:sphere", test::longRangeMaterial());
    for (const float value : exitance(world, {test::frontLight()}).pixels) {
        EXPECT_GE(value, 0.0f);
        EXPECT_LE(value, 1.0f);
    }
}

/// Exitance of image B interpolated where camera B sees the point; unset where it does not see it.
std::optional<glm::dvec3> exitanceAtPoint(const FloatImage& image, const CameraView& view,
                                          glm::dvec3 point) {
    const glm::dvec4 clip =
        glm::dmat4(view.projection) * glm::dmat4(view.view) * glm::dvec4(point, 1.0);
    const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
    const glm::dvec2 pixel(0.5 * (1.0 + ndc.x) * image.width - 0.5,
                           0.5 * (1.0 - ndc.y) * image.height - 0.5);
    const glm::ivec2 base(glm::floor(pixel));
    const glm::dvec2 f = pixel - glm::dvec2(base);
    const double width = view.pixelWidth.atDepthMm(glm::length(point - view.eye));
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const glm::ivec2 step(i & 1, i >> 1);
        const glm::ivec2 neighbor = base + step;
        if (neighbor.x < 0 || neighbor.y < 0 || neighbor.x >= image.width ||
            neighbor.y >= image.height || !test::seesScattering(image, neighbor) ||
            glm::length(test::positionAt(image, neighbor) - point) > 2.0 * width) {
            return std::nullopt;
        }
        sum += (step.x == 1 ? f.x : 1.0 - f.x) * (step.y == 1 ? f.y : 1.0 - f.y) *
               test::exitanceAt(image, neighbor);
    }
    return sum;
}

TEST_P(ExitancePhysics, DoesNotDependOnTheCamera) {
    constexpr glm::ivec2 kSize(150, 112);
    // Long range: shadow borders are smooth over several pixels, so that interpolating the second
    // picture costs little (0.8 % with the image reference in place of splatting).
    const World world = test::makeWorld("builtin:vase", test::longRangeMaterial());
    const FrameSettings settings = test::smallFrame(kSize, 96, GetParam());
    const Camera first = test::defaultCamera(world, kSize);
    Camera second = first; // from 25 degrees aside and nearer
    const glm::dvec3 offset = first.eye - first.at;
    const double angle = 25.0 * std::numbers::pi / 180.0;
    second.eye = first.at +
                 0.9 * glm::dvec3(std::cos(angle) * offset.x + std::sin(angle) * offset.z, offset.y,
                                  std::cos(angle) * offset.z - std::sin(angle) * offset.x);
    const std::vector<Light> lights{test::frontLight()};
    const FloatImage a = render(world, settings, first, lights);
    const FloatImage b = render(world, settings, second, lights);
    const CameraView view = makeCameraView(second, kSize.x, kSize.y);
    double squares = 0.0;
    double norm = 0.0;
    int shared = 0;
    for (int y = 0; y < kSize.y; ++y) {
        for (int x = 0; x < kSize.x; ++x) {
            if (!test::seesScattering(a, {x, y})) {
                continue;
            }
            if (const auto seen = exitanceAtPoint(b, view, test::positionAt(a, {x, y}))) {
                const glm::dvec3 here = test::exitanceAt(a, {x, y});
                squares += glm::dot(here - *seen, here - *seen);
                norm += glm::dot(here, here);
                ++shared;
            }
        }
    }
    ASSERT_GT(shared, 1000);
    const double error = std::sqrt(squares / norm);
    fmt::print("[ measured ] two cameras: relative RMSE {:.5f} over {} shared points\n", error,
               shared);
    EXPECT_LT(error, test::kCameraIndependence);
}

TEST_P(ExitancePhysics, ASphereTakesInItsCrossSectionTimesTheMeanTransmittance) {
    // The mean of F_t over the disc that light sees is 2 integral F_t cos sin: c of DESIGN 1.
    const World world = test::makeWorld("builtin:sphere", test::mediumRangeMaterial());
    const double radiusM = 1e-3 * world.scatteringSphere.radius;
    const double eta = static_cast<double>(world.materials[0]->eta);
    const glm::dvec3 H(1.0, 2.0, 0.5);
    FrameSettings settings = test::smallFrame({16, 12}, 256, GetParam());
    settings.statistics = true;
    const FluxTotals flux =
        test::renderFrame(context(), world, settings, test::defaultCamera(world, {16, 12}),
                          std::array{test::frontLight(H)})
            .stats.flux;
    for (int c = 0; c < 3; ++c) {
        const double expected =
            std::numbers::pi * radiusM * radiusM * H[c] * diffuseTransmittance(eta);
        const double lit = flux.lit[static_cast<std::size_t>(c)];
        fmt::print("[ measured ] sphere: flux / (pi R^2 H c) = {:.5f}\n", lit / expected);
        EXPECT_NEAR(lit, expected, test::kSphereFlux * expected);
        EXPECT_NEAR(flux.selected[static_cast<std::size_t>(c)], lit, test::kFluxSum * lit);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ExitancePhysics, testing::ValuesIn(test::kSchemes),
                         [](const auto& instance) {
                             return std::string(test::schemeWord(instance.param));
                         });

} // namespace
} // namespace celadon
