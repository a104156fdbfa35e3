// Light of coarser levels on finer ones, by the processor, and what that reads of materials. That
// it is what the shaders say is tested on whole frames (splat_backends_test.cpp).
#include "renderer/gather/level_accumulation.h"
#include "tests/support/materials.h"

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace celadon {
namespace {

constexpr int kSide = 32; // pixels of level 0
constexpr float kPixelMm = 0.5f;
constexpr float kDepth = 100.0f;

/// Levels that see a surface whose points are given by the place on the picture, mm; nothing where
/// its z is infinite.
struct Picture {
    explicit Picture(int levelCount, const std::function<glm::vec3(glm::vec2)>& surface,
                     glm::ivec4 part = {0, 0, kSide, kSide})
        : levels(static_cast<std::size_t>(levelCount)) {
        for (int k = 0; k < levelCount; ++k) {
            levels[static_cast<std::size_t>(k)].part = part / (1 << k);
        }
        ViewLevel& first = levels[0];
        for (int y = part.y; y < part.y + part.w; ++y) {
            for (int x = part.x; x < part.x + part.z; ++x) {
                const glm::vec3 p = surface((glm::vec2(x, y) + 0.5f) * kPixelMm);
                const bool isThere = std::isfinite(p.z);
                const glm::vec3 place = isThere ? p : glm::vec3(0.0f);
                const float depth = isThere ? kDepth - place.z : 0.0f;
                first.positions.insert(first.positions.end(), {place.x, place.y, place.z, depth});
                first.normals.insert(first.normals.end(), {0.0f, 0.0f, 1.0f, 1.0f});
                first.surfaces.insert(first.surfaces.end(),
                                      {0.3f, 0.6f, isThere ? 0.0f : -1.0f, 20.0f});
            }
        }
        makeCoarserLevels(levels, 1.0f);
        for (ViewLevel& level : levels) {
            level.exitance.assign(level.positions.size(), 0.0f);
        }
    }

    /// B of a level as a function of the place.
    void setLight(std::size_t k, const std::function<float(glm::vec3)>& light) {
        ViewLevel& level = levels[k];
        for (std::size_t i = 0; i < level.exitance.size(); i += 4) {
            const float* const p = &level.positions[i];
            level.exitance[i] = level.exitance[i + 1] = level.exitance[i + 2] =
                light({p[0], p[1], p[2]});
            level.exitance[i + 3] = 5.0f; // pairs
        }
    }

    void accumulate(const MaterialPointer& material) {
        FarEnergies energies(std::vector<MaterialPointer>{material});
        std::vector<float> radii(levels.size(), 0.0f);
        for (std::size_t k = 1; k < radii.size(); ++k) {
            radii[k] = static_cast<float>(k);
        }
        const FarEnergies::Selection selection = energies.select(
            radii, [](int, int, const subedit::TexelRect&, std::span<std::uint16_t> halves) {
                std::ranges::fill(halves, std::uint16_t{0xbc00}); // -1
            });
        AccumulationSettings settings;
        settings.pixelOffset = kPixelMm;
        settings.objectRadius = 10.0f;
        LevelAccumulation().accumulate(levels, selection, settings);
    }

    std::vector<ViewLevel> levels;
};

const MaterialPointer& medium() {
    static const MaterialPointer material = test::materialNamed("medium");
    return material;
}

glm::vec3 plane(glm::vec2 at) {
    return {at, 0.0f};
}

TEST(LevelAccumulation, CarriesEvenLightToEveryPixelAndKeepsItsPairs) {
    Picture picture(3, plane);
    picture.setLight(1, [](glm::vec3) { return 2.0f; });
    picture.setLight(2, [](glm::vec3) { return 3.0f; });
    picture.accumulate(medium());
    for (std::size_t i = 0; i < picture.levels[0].exitance.size(); i += 4) {
        EXPECT_NEAR(picture.levels[0].exitance[i], 5.0f, 1e-4f);
        EXPECT_EQ(picture.levels[0].exitance[i + 3], 0.0f);
    }
    EXPECT_NEAR(picture.levels[1].exitance[0], 5.0f, 1e-4f);
    EXPECT_EQ(picture.levels[1].exitance[3], 5.0f);
}

TEST(LevelAccumulation, FollowsLightThatBends) {
    const auto bent = [](glm::vec3 p) { return 1.0f + 0.02f * p.x * p.x; };
    Picture picture(2, plane);
    picture.setLight(1, bent);
    picture.accumulate(medium());
    const ViewLevel& level = picture.levels[0];
    for (int y = 4; y < kSide - 4; ++y) { // at the rim there are no neighbors to tell
        for (int x = 4; x < kSide - 4; ++x) {
            const std::size_t i = level.indexOf({x, y});
            const glm::vec3 p(level.positions[4 * i], level.positions[4 * i + 1], 0.0f);
            EXPECT_NEAR(level.exitance[4 * i], bent(p), 2e-4f) << x << " " << y;
        }
    }
}

TEST(LevelAccumulation, LeaksNothingAcrossASilhouette) {
    // A bar far before a plane: bright light on the one, none on the other.
    constexpr float kNear = 40.0f;
    Picture picture(
        3, [](glm::vec2 at) { return glm::vec3(at, at.x > 5.0f && at.x < 9.0f ? kNear : 0.0f); });
    const auto light = [](glm::vec3 p) { return p.z > 0.5f * kNear ? 1.0f : 0.0f; };
    picture.setLight(1, light);
    picture.setLight(2, light);
    picture.accumulate(medium());
    const ViewLevel& level = picture.levels[0];
    for (std::size_t i = 0; i < level.exitance.size(); i += 4) {
        EXPECT_NEAR(level.exitance[i], 2.0f * light({0.0f, 0.0f, level.positions[i + 2]}), 0.02f);
    }
}

TEST(LevelAccumulation, LeavesHolesAndBackgroundAlone) {
    constexpr float kNowhere = std::numeric_limits<float>::infinity();
    Picture picture(4, [](glm::vec2 at) {
        const bool isHole = glm::ivec2(at / kPixelMm) / 3 % 3 == glm::ivec2(1);
        return glm::vec3(at, isHole || at.y > 12.0f ? kNowhere : 0.0f);
    });
    for (std::size_t k = 1; k < picture.levels.size(); ++k) {
        picture.setLight(k, [](glm::vec3) { return 1.0f; });
    }
    picture.accumulate(medium());
    const ViewLevel& level = picture.levels[0];
    for (std::size_t i = 0; i < level.exitance.size() / 4; ++i) {
        EXPECT_NEAR(level.exitance[4 * i], level.scatters(i) ? 3.0f : 0.0f, 1e-4f);
    }
}

TEST(LevelAccumulation, KnowsAPartOfThePictureOnly) {
    const auto light = [](glm::vec3 p) { return 1.0f + p.x + 0.5f * p.y; };
    const glm::ivec4 part(8, 16, 16, 8);
    Picture whole(3, [&](glm::vec2 at) { // nothing outside of the part
        const glm::ivec2 pixel(at / kPixelMm);
        const bool isInside =
            glm::all(glm::greaterThanEqual(pixel, glm::ivec2(part))) &&
            glm::all(glm::lessThan(pixel, glm::ivec2(part.x + part.z, part.y + part.w)));
        return glm::vec3(at, isInside ? 0.0f : std::numeric_limits<float>::infinity());
    });
    Picture cut(3, plane, part);
    for (Picture* const picture : {&whole, &cut}) {
        picture->setLight(1, light);
        picture->setLight(2, light);
        picture->accumulate(medium());
    }
    const ViewLevel& level = cut.levels[0];
    for (int y = part.y; y < part.y + part.w; ++y) {
        for (int x = part.x; x < part.x + part.z; ++x) {
            EXPECT_EQ(level.exitance[4 * level.indexOf({x, y})],
                      whole.levels[0].exitance[4 * whole.levels[0].indexOf({x, y})]);
        }
    }
}

/// Far energies that tell what was read of them: each knot's value is its number.
class Knots {
public:
    FarEnergies::Source source() {
        return [this](int material, int knot, const subedit::TexelRect& rect,
                      std::span<std::uint16_t> halves) {
            constexpr std::uint16_t kSmall[] = {0x0000, 0x3c00, 0x4000, 0x4200, 0x4400, 0x4500,
                                                0x4600, 0x4700, 0x4800, 0x4880, 0x4900, 0x4980};
            EXPECT_EQ(halves.size(), 4 * rect.texels());
            std::ranges::fill(halves, kSmall[knot + material]);
            texels += static_cast<int>(rect.texels());
        };
    }
    int texels = 0; ///< read
};

TEST(FarEnergies, ReadsWhatItLacksAndNoMore) {
    const auto map = [](int size) {
        return test::makeMaterial("flat", size, 10, 10.0f,
                                  [](int, int) { return test::ProfileRecipe{}; });
    };
    FarEnergies energies(std::vector<MaterialPointer>{map(4), map(8)});
    Knots knots;
    const auto select = [&](std::vector<float> radii) {
        knots.texels = 0;
        return energies.select(radii, knots.source());
    };
    constexpr int kBoth = 16 + 64; // texels
    const FarEnergies::Selection first = select({0.0f, 2.25f, 4.0f, 77.0f});
    EXPECT_EQ(knots.texels, 5 * kBoth) << "knots 0, 2, 3, 4 and 10";
    EXPECT_FLOAT_EQ(first.at(0, 0, {0.1f, 0.9f})[0], 0.0f);
    EXPECT_FLOAT_EQ(first.at(1, 0, {0.1f, 0.9f})[1], 2.25f);
    EXPECT_FLOAT_EQ(first.at(1, 1, {0.1f, 0.9f})[2], 3.25f);
    EXPECT_FLOAT_EQ(first.at(3, 0, {0.5f, 0.5f})[0], 10.0f);
    static_cast<void>(select({0.0f, 2.25f, 4.0f, 77.0f}));
    EXPECT_EQ(knots.texels, 0);
    static_cast<void>(select({0.0f, 3.5f, 2.0f}));
    EXPECT_EQ(knots.texels, 0) << "another order of what is there";
    static_cast<void>(select({0.0f, 4.5f}));
    EXPECT_EQ(knots.texels, kBoth) << "knot 5";
    energies.changed(1, {2, 3, 4, 2});
    energies.changed(1, {3, 3, 2, 1}); // within the other
    static_cast<void>(select({0.0f, 2.5f}));
    EXPECT_EQ(knots.texels, 3 * 8) << "of knots 0, 2 and 3";
    static_cast<void>(select({4.5f}));
    EXPECT_EQ(knots.texels, 2 * 8) << "of knots 4 and 5, that were not asked for before";
    for (int i = 0; i < 100; ++i) { // rather the whole than as many rectangles
        energies.changed(0, {i % 4, i / 4 % 4, 1, 1});
    }
    static_cast<void>(select({0.0f}));
    EXPECT_EQ(knots.texels, 16);
}

TEST(Four, ExponentialIsThatOfTheLibrary) {
    for (float x = -86.0f; x < 86.0f; x += 0.37f) {
        const Four found = exponential(Four{x, x + 0.1f, -x, 0.0f});
        for (const auto& [lane, at] : {std::pair(0, x), std::pair(1, x + 0.1f), std::pair(2, -x)}) {
            EXPECT_NEAR(found[lane] / std::exp(at), 1.0f, 2e-5f) << at;
        }
        EXPECT_EQ(found[3], 1.0f);
    }
    EXPECT_TRUE(std::isfinite(exponential(four(1e30f))[0]));
    EXPECT_EQ(exponential(four(-1e30f))[0], exponential(four(-88.0f))[0]);
}

} // namespace
} // namespace celadon
