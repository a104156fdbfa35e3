#include "subedit/recipes/recipes.h"

#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/dipole.h"
#include "subedit/presets.h"
#include "subedit/recipes/jade.h"
#include "subedit/recipes/stone.h"
#include "subedit/recipes/strata.h"
#include "subedit/recipes/wax.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace celadon::subedit {

namespace {

/// A measured medium: the dipole with its coefficients, the same everywhere.
MaterialMap bakePreset(std::string_view name, int size, const BakeSettings& settings) {
    const Medium& medium = findMediumPreset(name);
    const FittedProfile fitted = fitProfile(
        dipoleProfile(medium), {settings.segments, settings.maxRadiusMm, settings.heldEnergy});
    MaterialMap map;
    map.name = name;
    map.width = map.height = size;
    map.segments = fitted.segments;
    map.maxRadiusMm = fitted.maxRadiusMm;
    map.eta = static_cast<float>(medium.eta);
    for (int texel = 0; texel < size * size; ++texel) {
        map.logProfile.insert(map.logProfile.end(), fitted.logProfile.begin(),
                              fitted.logProfile.end());
    }
    return map;
}

constexpr const char kApple[] = "apple";
constexpr const char kCream[] = "cream";
constexpr const char kKetchup[] = "ketchup";
constexpr const char kMarble[] = "marble";
constexpr const char kPotato[] = "potato";
constexpr const char kSkin1[] = "skin1";
constexpr const char kSkin2[] = "skin2";
constexpr const char kWholemilk[] = "wholemilk";

template<const char* Name>
MaterialMap bakeMeasured(int size, const BakeSettings& settings) {
    return bakePreset(Name, size, settings);
}

constexpr int kMapSegments = 24;
constexpr int kMeasuredSegments = 48;

constexpr std::array kRecipes = {
    Recipe{kApple, "flesh of an apple, measured (Jensen et al. 2001)", 1, bakeMeasured<kApple>,
           kMeasuredSegments},
    Recipe{"artificial_stone", "pressed grains of different minerals in a pale binder", 128,
           bakeArtificialStone, kMapSegments},
    Recipe{"banded_onyx", "folded layers of clear and milky onyx", 128, bakeBandedOnyx,
           kMapSegments},
    Recipe{"blue_wax", "swirls of clear and dense blue wax", 128, bakeBlueWax, kMapSegments},
    Recipe{kCream, "cream, measured (Jensen et al. 2001)", 1, bakeMeasured<kCream>,
           kMeasuredSegments},
    Recipe{"jade", "green nephrite with pale clouds and dark veins", 128, bakeJade, kMapSegments},
    Recipe{kKetchup, "ketchup, measured (Jensen et al. 2001)", 1, bakeMeasured<kKetchup>,
           kMeasuredSegments},
    Recipe{kMarble, "marble, measured (Jensen et al. 2001)", 1, bakeMeasured<kMarble>,
           kMeasuredSegments},
    Recipe{"marble_chessboard", "squares of light and dark marble with sharp borders", 256,
           bakeMarbleChessboard, kMapSegments},
    Recipe{kPotato, "flesh of a potato, measured (Jensen et al. 2001)", 1, bakeMeasured<kPotato>,
           kMeasuredSegments},
    Recipe{kSkin1, "skin, measured (Jensen et al. 2001)", 1, bakeMeasured<kSkin1>,
           kMeasuredSegments},
    Recipe{kSkin2, "skin of another person, measured (Jensen et al. 2001)", 1, bakeMeasured<kSkin2>,
           kMeasuredSegments},
    Recipe{"veined_marble", "white marble with gray veins", 128, bakeVeinedMarble, kMapSegments},
    Recipe{kWholemilk, "whole milk, measured (Jensen et al. 2001)", 1, bakeMeasured<kWholemilk>,
           kMeasuredSegments},
    Recipe{"yellow_wax", "beeswax with darker veins", 128, bakeYellowWax, kMapSegments},
};

} // namespace

std::span<const Recipe> recipes() {
    return kRecipes;
}

const Recipe& findRecipe(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Recipe& recipe : kRecipes) {
        if (recipe.name == name) {
            return recipe;
        }
        names.push_back(recipe.name);
    }
    throw UsageError(fmt::format("recipe '{}'", name), "no such recipe",
                     fmt::format("known are {}", fmt::join(names, ", ")));
}

} // namespace celadon::subedit
