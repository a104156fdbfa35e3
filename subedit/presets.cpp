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

// Jensen, Marschner, Levoy, Hanrahan 2001, "A Practical Model for Subsurface Light Transport",
// figure 5: absorption and reduced scattering in 1/mm. (A widely copied misprint has chicken's red
// absorption ten times too small.) The totals follow from the coefficients by that paper's dipole.
constexpr std::array kPresets = {
    MediumPreset{"apple",
                 {{0.0030, 0.0034, 0.046}, {2.29, 2.39, 1.97}, 1.3},
                 {0.85, 0.84, 0.53},
                 "flesh of an apple"},
    MediumPreset{"chicken1",
                 {{0.015, 0.077, 0.19}, {0.15, 0.21, 0.38}, 1.3},
                 {0.31, 0.16, 0.13},
                 "chicken meat"},
    MediumPreset{"chicken2",
                 {{0.018, 0.088, 0.20}, {0.19, 0.25, 0.32}, 1.3},
                 {0.32, 0.16, 0.11},
                 "chicken meat, another piece"},
    MediumPreset{"cream",
                 {{0.0002, 0.0028, 0.0163}, {7.38, 5.47, 3.15}, 1.3},
                 {0.98, 0.90, 0.72},
                 "dairy cream"},
    MediumPreset{"ketchup",
                 {{0.061, 0.97, 1.45}, {0.18, 0.07, 0.03}, 1.3},
                 {0.16, 0.01, 0.00},
                 "tomato ketchup"},
    MediumPreset{"marble",
                 {{0.0021, 0.0041, 0.0071}, {2.19, 2.62, 3.00}, 1.5},
                 {0.83, 0.79, 0.75},
                 "marble"},
    MediumPreset{"potato",
                 {{0.0024, 0.0090, 0.12}, {0.68, 0.70, 0.55}, 1.3},
                 {0.76, 0.61, 0.21},
                 "flesh of a potato"},
    MediumPreset{"skimmilk",
                 {{0.0014, 0.0025, 0.0142}, {0.70, 1.22, 1.90}, 1.3},
                 {0.81, 0.81, 0.68},
                 "milk without fat"},
    MediumPreset{
        "skin1", {{0.032, 0.17, 0.48}, {0.74, 0.88, 1.01}, 1.3}, {0.44, 0.23, 0.13}, "human skin"},
    MediumPreset{"skin2",
                 {{0.013, 0.070, 0.145}, {1.09, 1.59, 1.79}, 1.3},
                 {0.62, 0.43, 0.34},
                 "human skin of another person, fairer"},
    MediumPreset{"spectralon",
                 {{0.0, 0.0, 0.0}, {11.6, 20.4, 14.9}, 1.3},
                 {1.0, 1.0, 1.0},
                 "white reflectance standard, does not absorb"},
    MediumPreset{"wholemilk",
                 {{0.0011, 0.0024, 0.014}, {2.55, 3.21, 3.77}, 1.3},
                 {0.91, 0.88, 0.76},
                 "milk with all its fat"},
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
