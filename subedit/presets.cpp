#include "subedit/presets.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace celadon::subedit {

namespace {

/// Jensen, Marschner, Levoy, Hanrahan 2001, "A Practical Model for Subsurface Light Transport",
/// figure 5: absorption and reduced scattering in 1/mm. (A widely copied misprint has the red
/// absorption of both chickens ten times too small.)
constexpr std::string_view kJensen2001 = "Jensen et al. 2001";

/// Narasimhan, Gupta, Donner, Ramamoorthi, Nayar, Jensen 2006, "Acquiring Scattering Properties of
/// Participating Media by Dilution", table 1, at the concentration of the undiluted medium:
/// sigma_s' = (extinction - absorption) (1 - g) times the dilution, in 1/mm; in water, eta 1.33.
/// The values agree to 0.3 % between the tables of pbrt (reduced scattering) and of Mitsuba 0.6
/// (scattering and g). Left out are the clear liquids: alpha' below 0.05 in some channel, where
/// next to nothing comes back from below the surface.
constexpr std::string_view kNarasimhan2006 = "Narasimhan et al. 2006";

constexpr std::array kPresets = {
    MediumPreset{"anti-dandruff-shampoo",
                 {{0.084621, 0.15688, 0.20365}, {0.023805, 0.028804, 0.034306}, 1.33},
                 "white anti-dandruff shampoo",
                 kNarasimhan2006,
                 {0.911, 0.896, 0.884}},
    MediumPreset{"apple",
                 {{0.0030, 0.0034, 0.046}, {2.29, 2.39, 1.97}, 1.3},
                 "flesh of an apple",
                 kJensen2001},
    MediumPreset{"bleach",
                 {{0.0033542, 0.014892, 0.026297}, {0.0024035, 0.0031373, 0.003991}, 1.33},
                 "household bleach",
                 kNarasimhan2006,
                 {0.912, 0.905, 0.892}},
    MediumPreset{
        "chicken1", {{0.015, 0.077, 0.19}, {0.15, 0.21, 0.38}, 1.3}, "chicken meat", kJensen2001},
    MediumPreset{"chicken2",
                 {{0.018, 0.088, 0.20}, {0.19, 0.25, 0.32}, 1.3},
                 "chicken meat, another piece",
                 kJensen2001},
    MediumPreset{"chocolate-milk",
                 {{0.010063, 0.043125, 0.14375}, {1.4585, 2.1289, 2.9527}, 1.33},
                 "chocolate milk",
                 kNarasimhan2006,
                 {0.862, 0.838, 0.806}},
    MediumPreset{"chocolate-milk-lowfat",
                 {{0.0115, 0.0368, 0.1564}, {0.64925, 0.83916, 1.1057}, 1.33},
                 "chocolate milk with little fat",
                 kNarasimhan2006,
                 {0.934, 0.927, 0.916}},
    MediumPreset{
        "cream", {{0.0002, 0.0028, 0.0163}, {7.38, 5.47, 3.15}, 1.3}, "dairy cream", kJensen2001},
    MediumPreset{"espresso",
                 {{4.7984, 6.5751, 8.8493}, {0.72378, 0.84557, 1.0247}, 1.33},
                 "strong coffee",
                 kNarasimhan2006,
                 {0.907, 0.896, 0.88}},
    MediumPreset{
        "ketchup", {{0.061, 0.97, 1.45}, {0.18, 0.07, 0.03}, 1.3}, "tomato ketchup", kJensen2001},
    MediumPreset{"lowfat-milk",
                 {{0.002875, 0.00575, 0.0115}, {0.89187, 1.5136, 2.532}, 1.33},
                 "milk with little fat",
                 kNarasimhan2006,
                 {0.932, 0.902, 0.859}},
    MediumPreset{
        "marble", {{0.0021, 0.0041, 0.0071}, {2.19, 2.62, 3.00}, 1.5}, "marble", kJensen2001},
    MediumPreset{"mint-mocha",
                 {{3.772, 5.8228, 7.82}, {0.31602, 0.38538, 0.48131}, 1.33},
                 "bottled coffee with chocolate and mint",
                 kNarasimhan2006,
                 {0.91, 0.907, 0.914}},
    MediumPreset{"mocha-powder",
                 {{17.502, 27.004, 35.433}, {2.7979, 3.5452, 4.3365}, 1.33},
                 "instant coffee powder with chocolate",
                 kNarasimhan2006,
                 {0.907, 0.894, 0.888}},
    MediumPreset{"potato",
                 {{0.0024, 0.0090, 0.12}, {0.68, 0.70, 0.55}, 1.3},
                 "flesh of a potato",
                 kJensen2001},
    MediumPreset{"reduced-fat-milk",
                 {{0.0025556, 0.0051111, 0.012778}, {2.4858, 3.1669, 4.5214}, 1.33},
                 "milk with less fat than regular milk",
                 kNarasimhan2006,
                 {0.819, 0.797, 0.746}},
    MediumPreset{"regular-milk",
                 {{0.0015333, 0.0046, 0.019933}, {4.5513, 5.8294, 7.136}, 1.33},
                 "milk with all its fat, another measurement",
                 kNarasimhan2006,
                 {0.75, 0.714, 0.681}},
    MediumPreset{"salt",
                 {{0.28415, 0.3257, 0.34148}, {0.027333, 0.032451, 0.031979}, 1.33},
                 "table salt, measured in solution",
                 kNarasimhan2006,
                 {0.802, 0.793, 0.821}},
    MediumPreset{"skimmilk",
                 {{0.0014, 0.0025, 0.0142}, {0.70, 1.22, 1.90}, 1.3},
                 "milk without fat",
                 kJensen2001},
    MediumPreset{
        "skin1", {{0.032, 0.17, 0.48}, {0.74, 0.88, 1.01}, 1.3}, "human skin", kJensen2001},
    MediumPreset{"skin2",
                 {{0.013, 0.070, 0.145}, {1.09, 1.59, 1.79}, 1.3},
                 "human skin of another person, fairer",
                 kJensen2001},
    MediumPreset{"soy-milk",
                 {{0.0019167, 0.0095833, 0.065167}, {0.59223, 0.73866, 1.4693}, 1.33},
                 "milk of soybeans",
                 kNarasimhan2006,
                 {0.873, 0.858, 0.832}},
    MediumPreset{"soy-milk-lowfat",
                 {{0.0014375, 0.0071875, 0.035937}, {0.30576, 0.34233, 0.61664}, 1.33},
                 "milk of soybeans with little fat",
                 kNarasimhan2006,
                 {0.85, 0.853, 0.842}},
    MediumPreset{"spectralon",
                 {{0.0, 0.0, 0.0}, {11.6, 20.4, 14.9}, 1.3},
                 "white reflectance standard, does not absorb",
                 kJensen2001},
    MediumPreset{"sports-drink",
                 {{0.024794, 0.019289, 0.008878}, {0.0024574, 0.003007, 0.0037325}, 1.33},
                 "cloudy soft drink",
                 kNarasimhan2006,
                 {0.933, 0.933, 0.935}},
    MediumPreset{"white-grapefruit-juice",
                 {{0.0138, 0.018831, 0.056781}, {0.22826, 0.23998, 0.32748}, 1.33},
                 "juice of white grapefruit",
                 kNarasimhan2006,
                 {0.548, 0.545, 0.565}},
    MediumPreset{"wholemilk",
                 {{0.0011, 0.0024, 0.014}, {2.55, 3.21, 3.77}, 1.3},
                 "milk with all its fat",
                 kJensen2001},
};

} // namespace

std::span<const MediumPreset> mediumPresets() {
    return kPresets;
}

std::vector<MediumPreset> searchMediumPresets(std::string_view word) {
    const auto contains = [&](std::string_view text) {
        const auto isSame = [](char a, char b) {
            return std::tolower(static_cast<unsigned char>(a)) ==
                   std::tolower(static_cast<unsigned char>(b));
        };
        return std::search(text.begin(), text.end(), word.begin(), word.end(), isSame) !=
                   text.end() ||
               word.empty();
    };
    std::vector<MediumPreset> found;
    for (const MediumPreset& preset : kPresets) {
        if (contains(preset.name) || contains(preset.description) || contains(preset.source)) {
            found.push_back(preset);
        }
    }
    return found;
}

const Medium& findMediumPreset(std::string_view name) {
    std::vector<std::string_view> names;
    for (const MediumPreset& preset : kPresets) {
        if (preset.name == name) {
            return preset.medium;
        }
        names.push_back(preset.name);
    }
    throw UsageError(fmt::format("preset '{}'", name), "no such measured medium",
                     fmt::format("known are {}", fmt::join(names, ", ")));
}

} // namespace celadon::subedit
