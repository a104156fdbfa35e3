#include "subedit/fit/profile_fit.h"
#include "subedit/models/better_dipole.h"
#include "subedit/models/dipole.h"
#include "subedit/models/monte_carlo.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/models/photon_beam.h"
#include "subedit/models/quantized_diffusion.h"
#include "subedit/presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace celadon::subedit {
namespace {

/// The total diffuse reflectance that follows from the coefficients by the dipole of Jensen et al.
/// 2001, computed apart, to two decimals: a misprint in the coefficients would show.
struct DipoleTotal {
    const char* preset;
    glm::dvec3 total;
};
constexpr DipoleTotal kDipoleTotals[] = {
    {"apple", {0.85, 0.84, 0.53}},    {"chicken1", {0.31, 0.16, 0.13}},
    {"chicken2", {0.32, 0.16, 0.11}}, {"cream", {0.98, 0.90, 0.72}},
    {"ketchup", {0.16, 0.01, 0.00}},  {"marble", {0.83, 0.79, 0.75}},
    {"potato", {0.76, 0.61, 0.21}},   {"skimmilk", {0.81, 0.81, 0.68}},
    {"skin1", {0.44, 0.23, 0.13}},    {"skin2", {0.62, 0.43, 0.34}},
    {"spectralon", {1.0, 1.0, 1.0}},  {"wholemilk", {0.91, 0.88, 0.76}},
};

TEST(Presets, JensensMediaHaveTheDipolesTotals) {
    for (const DipoleTotal& printed : kDipoleTotals) {
        const glm::dvec3 total = dipoleTotal(findMediumPreset(printed.preset));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(total[channel], printed.total[channel], 0.0051)
                << printed.preset << ' ' << channelName(channel);
        }
    }
}

/// Narasimhan et al. 2006, table 1, as measured: `amount` of the medium (ml; of powders what the
/// table's own dilution says) in 23 l of water, coefficients in 0.01 / mm.
struct Diluted {
    const char* preset;
    double amount;
    glm::dvec3 extinction;
    glm::dvec3 absorption;
};
constexpr Diluted kDiluted[] = {
    {"lowfat-milk", 16, {0.9126, 1.0748, 1.2500}, {0.0002, 0.0004, 0.0008}},
    {"reduced-fat-milk", 18, {1.0750, 1.2213, 1.3941}, {0.0002, 0.0004, 0.0010}},
    {"regular-milk", 15, {1.1874, 1.3296, 1.4602}, {0.0001, 0.0003, 0.0013}},
    {"espresso", 8, {0.4376, 0.5115, 0.6048}, {0.1669, 0.2287, 0.3078}},
    {"mint-mocha", 6, {0.1900, 0.2600, 0.3500}, {0.0984, 0.1519, 0.2040}},
    {"soy-milk-lowfat", 16, {0.1419, 0.1625, 0.2740}, {0.0001, 0.0005, 0.0025}},
    {"soy-milk", 12, {0.2434, 0.2719, 0.4597}, {0.0001, 0.0005, 0.0034}},
    {"chocolate-milk-lowfat", 10, {0.4282, 0.5014, 0.5791}, {0.0005, 0.0016, 0.0068}},
    {"chocolate-milk", 16, {0.7359, 0.9172, 1.0688}, {0.0007, 0.0030, 0.0100}},
    {"sports-drink", 1500, {0.4009, 0.4185, 0.4324}, {0.1617, 0.1258, 0.0579}},
    {"bleach", 1200, {0.1600, 0.2500, 0.3300}, {0.0175, 0.0777, 0.1372}},
    {"white-grapefruit-juice", 160, {0.3609, 0.3800, 0.5632}, {0.0096, 0.0131, 0.0395}},
    {"anti-dandruff-shampoo", 240, {0.3674, 0.4527, 0.5211}, {0.0883, 0.1637, 0.2125}},
    {"salt", 414.03, {0.7600, 0.8685, 0.9363}, {0.5115, 0.5863, 0.6147}},
    {"mocha-powder", 2.464, {0.5098, 0.6476, 0.7944}, {0.1875, 0.2893, 0.3796}},
};

TEST(Presets, NarasimhansMediaAreTheMeasuredDilutions) {
    for (const Diluted& diluted : kDiluted) {
        const auto found = searchMediumPresets(diluted.preset);
        const auto preset = std::ranges::find(found, diluted.preset, &MediumPreset::name);
        ASSERT_NE(preset, found.end()) << diluted.preset;
        EXPECT_EQ(preset->source, "Narasimhan et al. 2006");
        const double perMm = 0.01 * 23000.0 / diluted.amount;
        for (int c = 0; c < 3; ++c) {
            const double scattering = (diluted.extinction[c] - diluted.absorption[c]) * perMm;
            // Five digits are given.
            EXPECT_NEAR(preset->medium.absorption[c] / (diluted.absorption[c] * perMm), 1.0, 1e-4)
                << diluted.preset;
            EXPECT_NEAR(preset->medium.reducedScattering[c] /
                            (scattering * (1.0 - preset->measuredAnisotropy[c])),
                        1.0, 1e-4)
                << diluted.preset;
        }
    }
}

TEST(Presets, AllAreValidNamedOnceAndFoundByName) {
    const auto presets = mediumPresets();
    EXPECT_EQ(presets.size(), std::size(kDipoleTotals) + std::size(kDiluted));
    EXPECT_TRUE(std::ranges::is_sorted(presets, std::ranges::less_equal{}, &MediumPreset::name));
    for (const MediumPreset& preset : presets) {
        EXPECT_NO_THROW(validateMedium(preset.medium)) << preset.name;
        EXPECT_EQ(findMediumPreset(preset.name).eta, preset.medium.eta);
        EXPECT_FALSE(preset.description.empty());
        EXPECT_FALSE(preset.source.empty());
    }
    EXPECT_EQ(searchMediumPresets("").size(), presets.size());
    EXPECT_EQ(searchMediumPresets("JENSEN").size(), std::size(kDipoleTotals));
    EXPECT_EQ(searchMediumPresets("narasimhan").size(), std::size(kDiluted));
    EXPECT_GE(searchMediumPresets("milk").size(), 8u);
    EXPECT_TRUE(searchMediumPresets("cheese").empty());
}

RadialCurves normalizedDiffusion(const Medium& medium) {
    return normalizedDiffusionProfile(medium);
}

RadialCurves randomWalks(const Medium& medium) {
    return monteCarloProfile(simulateRandomWalk(medium, {.walks = 4000}));
}

TEST(ProfileFit, KeepsTheAlbedoOfEveryPresetByEveryModel) {
    const std::pair<const char*, std::function<RadialCurves(const Medium&)>> models[] = {
        {"dipole", dipoleProfile},
        {"better-dipole", betterDipoleProfile},
        {"quantized", quantizedDiffusionProfile},
        {"photon-beam", photonBeamProfile},
        {"normalized-diffusion", normalizedDiffusion},
        {"monte-carlo", randomWalks}};
    for (const MediumPreset& preset : mediumPresets()) {
        for (const auto& [name, model] : models) {
            const RadialCurves curves = model(preset.medium);
            const FittedProfile fitted = fitProfile(curves, {});
            const glm::dvec3 albedo = diffuseAlbedo(fitted.view());
            for (int c = 0; c < 3; ++c) {
                const double total = curves[static_cast<std::size_t>(c)].total;
                // 0.1 % is promised; what is below 1e-6 is black everywhere in the program.
                EXPECT_NEAR(albedo[c], total, 1e-3 * total + 1e-6)
                    << preset.name << ' ' << name << ' ' << channelName(c);
            }
        }
    }
}

} // namespace
} // namespace celadon::subedit
