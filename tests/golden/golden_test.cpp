// Whole frames against stored pictures: relative RMSE on linear radiance, FLIP on what a display
// shows. On failure the actual picture and a heat map lie in a folder that the message names.
#include "renderer/output/flip.h"
#include "renderer/output/image_io.h"
#include "renderer/output/tone_map.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <memory>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(128, 96);

/// Drivers rasterize edges differently, which antialiasing turns into a few dim pixels.
constexpr double kRelativeRmse = 5e-3;
/// Mean FLIP; 0.01 is far below what shows when pictures are flipped.
constexpr double kFlip = 5e-3;

struct Distance {
    double relativeRmse = 0.0;
    double flip = 0.0;
    FloatImage heat; ///< FLIP as colors
    [[nodiscard]] bool isSmall() const { return relativeRmse <= kRelativeRmse && flip <= kFlip; }
};

/// Linear R,G,B of what the display shows in front of black: what flipMap takes.
FloatImage shown(const FloatImage& image) {
    DisplaySettings display;
    display.background = glm::vec3(0.0f);
    FloatImage result = toDisplay(image, display);
    for (float& value : result.pixels) {
        value = decodeSrgb(value);
    }
    return result;
}

Distance distance(const FloatImage& actual, const FloatImage& golden) {
    const FloatImage map = flipMap(shown(actual), shown(golden));
    return {compareValues(extractLayer(actual, ""), extractLayer(golden, "")).relativeRmse,
            meanValue(map), heatMap(map, 1.0f)};
}

struct GoldenCase {
    const char* name;
    const char* model;
    const char* material;
    bool fromBehind;
};

class Golden : public test::GlTest, public testing::WithParamInterface<GoldenCase> {
protected:
    FloatImage render() {
        const MaterialPointer material = std::make_shared<subedit::MaterialMap>(
            subedit::readMaterial(subedit::findMaterial(GetParam().material)));
        const World world = test::makeWorld(GetParam().model, material);
        FrameSettings settings;
        settings.size = kPicture;
        settings.splatting.irradianceSize = 128;
        const glm::dvec3 color(3.0);
        const Light light =
            GetParam().fromBehind ? test::backLight(color) : test::frontLight(color);
        return test::renderFrame(context(), world, settings, test::defaultCamera(world, kPicture),
                                 std::array{light})
            .image;
    }
    static std::filesystem::path goldenFile() {
        return std::filesystem::path(CELADON_SOURCE_DIR) / "tests" / "golden" /
               (std::string(GetParam().name) + ".exr");
    }
};

TEST_P(Golden, LooksAsStored) {
    const FloatImage actual = render();
    ASSERT_FALSE(findNonFinite(actual).has_value());
    if (std::getenv("CELADON_UPDATE_GOLDEN") != nullptr) {
        writeExr(goldenFile(), actual);
        GTEST_SKIP() << "wrote '" << goldenFile().string() << "': look at it";
    }
    const FloatImage golden = readImage(goldenFile()).image;
    const Distance found = distance(actual, golden);
    fmt::print("[ measured ] {}: relative RMSE {:.2g}, FLIP {:.2g}\n", GetParam().name,
               found.relativeRmse, found.flip);
    if (!found.isSmall()) {
        const std::filesystem::path folder =
            std::filesystem::temp_directory_path() / "celadon-golden";
        std::filesystem::create_directories(folder);
        const std::filesystem::path stem = folder / GetParam().name;
        writeExr(stem.string() + ".actual.exr", actual);
        writeDisplayImage(stem.string() + ".heat.png", found.heat);
        ADD_FAILURE() << fmt::format(
            "relative RMSE {:.4g} (at most {}), FLIP {:.4g} (at most {}); actual and heat map in "
            "'{}'; again: celadon compare '{}.actual.exr' '{}'; new golden: "
            "CELADON_UPDATE_GOLDEN=1 "
            "ctest --preset release -R golden.egl",
            found.relativeRmse, kRelativeRmse, found.flip, kFlip, folder.string(), stem.string(),
            goldenFile().string());
    }
}

TEST_P(Golden, TheComparatorSeesWhatItShould) {
    // Negative controls: a light a twentieth stronger, and a picture moved by one pixel.
    const FloatImage golden = readImage(goldenFile()).image;
    EXPECT_TRUE(distance(golden, golden).isSmall());
    FloatImage brighter = golden;
    FloatImage moved = golden;
    for (int y = 0; y < golden.height; ++y) {
        for (int x = 0; x < golden.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                brighter.at(x, y, c) *= 1.05f;
                moved.at(x, y, c) = golden.at(std::max(x - 1, 0), y, c);
            }
        }
    }
    EXPECT_FALSE(distance(brighter, golden).isSmall());
    EXPECT_FALSE(distance(moved, golden).isSmall());
}

INSTANTIATE_TEST_SUITE_P(Pictures, Golden,
                         testing::Values(GoldenCase{"vase_yellow_wax_back", "builtin:vase",
                                                    "yellow_wax", true},
                                         GoldenCase{"sphere_marble_chessboard_front",
                                                    "builtin:sphere", "marble_chessboard", false}),
                         [](const auto& instance) { return std::string(instance.param.name); });

} // namespace
} // namespace celadon
