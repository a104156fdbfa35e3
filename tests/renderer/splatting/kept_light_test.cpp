// While a brush changes texels, the scattered light is kept and only what changes is added to it.
// What is then seen is what gathering all anew finds, but for rounding; where nothing of a change
// reaches, bit for bit.
#include "renderer/splatting/splatting_solver.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(100, 76); // no multiple of a tile or of a coarse pixel

/// Of one range, with an albedo that varies.
MaterialPointer stripes(double lengthMm) {
    return test::makeMaterial(
        "stripes", 64, 24, static_cast<float>(10.0 * lengthMm), [&](int x, int) {
            return test::ProfileRecipe{{0.9, x % 8 < 4 ? 0.7 : 0.2, 0.5}, glm::dvec3(lengthMm)};
        });
}

/// Rounding of sums: of the brightest value, since what was bright may be painted dark.
constexpr float kRounding = 3e-6f;

void expectSame(const std::vector<float>& kept, const std::vector<float>& anew) {
    ASSERT_EQ(kept.size(), anew.size());
    const float brightest = *std::ranges::max_element(anew);
    float largest = 0.0f;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        largest = std::max(largest, std::abs(kept[i] - anew[i]));
    }
    fmt::print("[ measured ] differs by {:.2g} of the brightest\n", largest / brightest);
    EXPECT_LE(largest, kRounding * brightest);
}

class KeptLight : public test::GlTest {
protected:
    void open(const char* model, const char* material, int coverageSamples = 1) {
        open(model, test::materialNamed(material), coverageSamples);
    }
    void open(const char* model, const MaterialPointer& material, int coverageSamples = 1) {
        mMap = std::make_shared<subedit::MaterialMap>(*material);
        mWorld = test::makeWorld(model, mMap);
        mSettings = test::smallFrame(kPicture, 120, Scheme::Hierarchical);
        mSettings.splatting.backend = SplatBackendKind::Cpu;
        mSettings.coverageSamples = coverageSamples;
        mScene = std::make_shared<GpuScene>(mWorld, mSettings);
        mRenderer = std::make_unique<FrameRenderer>(context(), mScene, mSettings);
        mCamera = test::defaultCamera(mWorld, kPicture);
        mLights = {test::frontLight({1.0, 0.8, 0.6})};
    }

    /// Shifts ln P of every knot in a rectangle, as an albedo operator does, and the last by so
    /// much more than the first, as one of ranges.
    void edit(const subedit::TexelRect& rect, float shift, float tilt = 0.0f) {
        for (int y = rect.y; y < rect.bottom(); ++y) {
            for (int x = rect.x; x < rect.right(); ++x) {
                for (int i = 0; i < 3 * mMap->knots(); ++i) {
                    float& value =
                        mMap->logProfile[mMap->index(x, y, 0) + static_cast<std::size_t>(i)];
                    const float along =
                        static_cast<float>(i / 3) / static_cast<float>(mMap->segments);
                    value = std::max(value + shift + along * tilt, subedit::kLogProfileFloor);
                }
            }
        }
        mRenderer->solver().materialChanged(mScene->materialChanged(0, rect));
    }

    std::vector<float> draw(std::uint64_t* gathered = nullptr) {
        const gl::Texture* color = mRenderer->draw(mCamera, mLights, nullptr);
        if (gathered != nullptr) {
            *gathered = dynamic_cast<SplattingSolver&>(mRenderer->solver()).cpu()->gatheredPairs();
        }
        std::vector<float> texels = mRenderer->exitance().readLevel(0);
        for (std::size_t i = 3; i < texels.size(); i += 4) {
            texels[i] = 0.0f; // counts pairs
        }
        const std::vector<float> seen = color->readLevel(0);
        texels.insert(texels.end(), seen.begin(), seen.end());
        return texels;
    }

    /// The same with nothing kept: another view was drawn in between.
    std::vector<float> drawAnew(std::uint64_t* gathered = nullptr) {
        const Camera camera = mCamera;
        mCamera.eye += glm::dvec3(1.0, 0.0, 0.0);
        draw();
        mCamera = camera;
        return draw(gathered);
    }

    void expectAsAnew() {
        const std::vector<float> kept = draw();
        expectSame(kept, drawAnew());
    }

    subedit::TexelRect part(double x, double y, double width, double height) const {
        const auto w = static_cast<double>(mMap->width);
        const auto h = static_cast<double>(mMap->height);
        return {static_cast<int>(x * w), static_cast<int>(y * h),
                std::max(static_cast<int>(width * w), 1),
                std::max(static_cast<int>(height * h), 1)};
    }

    std::shared_ptr<subedit::MaterialMap> mMap;
    World mWorld;
    FrameSettings mSettings;
    std::shared_ptr<GpuScene> mScene;
    std::unique_ptr<FrameRenderer> mRenderer;
    Camera mCamera;
    std::vector<Light> mLights;
};

TEST_F(KeptLight, ADabChangesWhatGatheringAnewFinds) {
    for (const double lengthMm : {0.3, 2.0, 6.0}) {
        SCOPED_TRACE(lengthMm);
        open("builtin:vase", stripes(lengthMm));
        const std::vector<float> before = draw();
        for (const auto& [x, y] :
             {std::pair(0.25, 0.4), std::pair(0.3, 0.55), std::pair(0.9, 0.2)}) {
            edit(part(x, y, 0.08, 0.08), -0.7f);
            std::uint64_t gathered = 0;
            std::uint64_t all = 0;
            const std::vector<float> kept = draw(&gathered);
            expectSame(kept, drawAnew(&all));
            fmt::print("[ measured ] {} mm at {}, {}: {} of {} pairs gathered\n", lengthMm, x, y,
                       gathered, all);
            EXPECT_LE(gathered, all);
        }
        EXPECT_NE(draw(), before);
    }
}

TEST_F(KeptLight, ManyDabsAddUpNoError) {
    open("builtin:vase", stripes(4.0));
    draw();
    for (int i = 0; i < 60; ++i) {
        edit(part(0.1 + 0.011 * i, 0.2 + 0.07 * (i % 8), 0.08, 0.08), i % 2 == 0 ? -1.5f : 0.8f);
        draw();
    }
    expectAsAnew();
}

TEST_F(KeptLight, ASmallDabOfShortRangeGathersLittle) {
    open("builtin:vase", stripes(0.3));
    draw();
    edit(part(0.25, 0.4, 0.05, 0.05), -0.7f);
    std::uint64_t gathered = 0;
    std::uint64_t all = 0;
    draw(&gathered);
    drawAnew(&all);
    EXPECT_GT(gathered, 0u);
    EXPECT_LT(4 * gathered, all);
}

// The radii of what is seen, and the energies that the accumulation divides out, are kept as well.
TEST_F(KeptLight, ShorterRangesAreWhatAnotherRendererFinds) {
    open("builtin:vase", stripes(3.0));
    draw();
    for (const double x : {0.2, 0.45, 0.7}) {
        edit(part(x, 0.1, 0.25, 0.8), 0.0f, -9.0f);
        const std::vector<float> kept = draw();
        mRenderer = std::make_unique<FrameRenderer>(context(), mScene, mSettings);
        expectSame(kept, draw());
    }
}

TEST_F(KeptLight, NothingChangedGathersNothing) {
    open("builtin:vase", "chessboard");
    const std::vector<float> before = draw();
    std::uint64_t gathered = 1;
    EXPECT_EQ(draw(&gathered), before);
    EXPECT_EQ(gathered, 0u);
}

TEST_F(KeptLight, BrighterTexelsChangeTheCodesOfAll) {
    open("builtin:vase", "chessboard");
    draw();
    edit(part(0.4, 0.4, 0.1, 0.1), 0.3f);
    expectAsAnew();
    edit(part(0.5, 0.4, 0.1, 0.1), 4.0f);
    const std::vector<float> kept = draw();
    expectSame(kept, drawAnew());
}

TEST_F(KeptLight, ADabAcrossTheMapsBorderIsSeenOnBothSides) {
    open("builtin:sphere", "chessboard");
    draw();
    edit(part(0.0, 0.3, 0.05, 0.2), -0.9f);
    const std::vector<float> kept = draw();
    expectSame(kept, drawAnew());
}

TEST_F(KeptLight, LightsThatMoveOrComeAreSeen) {
    open("builtin:vase", "chessboard");
    draw();
    mLights[0] = test::backLight();
    expectAsAnew();
    mLights.push_back(test::frontLight({0.1, 0.2, 0.3}));
    expectAsAnew();
    edit(part(0.5, 0.4, 0.1, 0.1), -0.4f);
    expectAsAnew();
    for (int i = 0; i < 5; ++i) { // more than are kept
        mLights.push_back(test::directionalLight({0.2 * i - 0.5, -1.0, -0.3}));
    }
    expectAsAnew();
    edit(part(0.2, 0.4, 0.1, 0.1), -0.4f);
    expectAsAnew();
    mLights.resize(1);
    expectAsAnew();
}

TEST_F(KeptLight, AnInterruptedFrameLosesNoEdit) {
    open("builtin:vase", "chessboard");
    draw();
    const std::atomic<bool> interrupt = true;
    edit(part(0.3, 0.4, 0.1, 0.1), -0.7f);
    EXPECT_EQ(mRenderer->draw(mCamera, mLights, &interrupt), nullptr);
    edit(part(0.6, 0.4, 0.1, 0.1), -0.7f);
    const std::vector<float> kept = draw();
    expectSame(kept, drawAnew());
}

TEST_F(KeptLight, SilhouettesAreSmoothAsBefore) {
    open("builtin:vase", "chessboard", 4);
    draw();
    edit(part(0.3, 0.4, 0.1, 0.1), -0.7f);
    const std::vector<float> kept = draw();
    expectSame(kept, drawAnew());
}

} // namespace
} // namespace celadon
