#include "subedit/effective_radius.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/log_linear.h"
#include "subedit/models/dipole.h"
#include "subedit/presets.h"
#include "subedit/radius_map.h"
#include "subedit/texel_energy.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <numbers>

namespace celadon::subedit {
namespace {

/// Knots are stored in single precision: e^(ln P) carries some |ln P| 6e-8.
constexpr double kFloatKnots = 3e-6;
/// The vectorized path works in single precision throughout.
constexpr double kSinglePrecision = 1e-4;

/// Integral of r e^(-r/a) over [0, R].
double exponentialEnergy(double a, double R) {
    return a * a - a * (R + a) * std::exp(-R / a);
}

TEST(LogLinear, AgreesWithQuadratureForAllSlopes) {
    for (const double slope : {-60.0, -3.0, -0.26, -0.24, -1e-3, -1e-9, 0.0, 1e-6, 0.2, 0.3, 5.0}) {
        const double start = 0.7;
        const double width = 0.4;
        double sum = 0.0;
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + 0.5) / kSteps;
            sum += std::exp(-2.0 + slope * t) * (start + t * width) * width / kSteps;
        }
        EXPECT_NEAR(pieceEnergy(-2.0, -2.0 + slope, start, width) / sum, 1.0, 1e-7) << slope;
    }
}

TEST(EffectiveRadius, EnergyOfAnExponentialIsItsClosedForm) {
    const MaterialMap map = test::exponentialMaterial(17, 20.0f, {3.0f, 2.0f, 1.0f});
    const ProfileView profile = profileAt(map, 0, 0);
    const glm::dvec3 albedo = diffuseAlbedo(profile);
    const glm::dvec3 within = radialEnergy(profile, 4.3);
    for (int channel = 0; channel < 3; ++channel) {
        const double a = 3.0 - channel;
        const double expected = 0.01 * exponentialEnergy(a, 20.0);
        EXPECT_NEAR(albedo[channel] / (2.0 * std::numbers::pi * expected), 1.0, kFloatKnots);
        EXPECT_NEAR(within[channel] / (0.01 * exponentialEnergy(a, 4.3)), 1.0, kFloatKnots);
    }
}

TEST(EffectiveRadius, HoldsItsEnergyFraction) {
    for (const MediumPreset& preset : mediumPresets()) {
        const FittedProfile fitted = fitProfile(dipoleProfile(preset.medium), {});
        const ProfileView profile = fitted.view();
        const glm::dvec3 total = diffuseAlbedo(profile) / (2.0 * std::numbers::pi);
        for (const double fraction : {0.01, 0.5, 0.95, 0.99, 1.0}) {
            const glm::dvec3 radius = effectiveRadiusMm(profile, fraction);
            for (int channel = 0; channel < 3; ++channel) {
                const double held = radialEnergy(profile, radius[channel])[channel];
                EXPECT_NEAR(held / total[channel], fraction, 1e-6)
                    << preset.name << ' ' << channelName(channel);
            }
        }
    }
}

TEST(EffectiveRadius, ScalesWithLengths) {
    const MaterialMap one = test::exponentialMaterial(16, 20.0f, {3.0f, 2.0f, 1.0f}, 0.04f);
    const MaterialMap two = test::exponentialMaterial(16, 40.0f, {6.0f, 4.0f, 2.0f}, 0.01f);
    const glm::dvec3 a = effectiveRadiusMm(profileAt(one, 0, 0));
    const glm::dvec3 b = effectiveRadiusMm(profileAt(two, 0, 0));
    const glm::dvec3 albedoOne = diffuseAlbedo(profileAt(one, 0, 0));
    const glm::dvec3 albedoTwo = diffuseAlbedo(profileAt(two, 0, 0));
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(b[channel] / a[channel], 2.0, kFloatKnots);
        EXPECT_NEAR(albedoTwo[channel] / albedoOne[channel], 1.0, kFloatKnots);
    }
}

TEST(EffectiveRadius, BlackChannelsHaveNoRange) {
    MaterialMap map = test::exponentialMaterial(8, 10.0f, {2.0f, 1.0f, 1.0f});
    for (int k = 0; k <= 8; ++k) {
        map.logProfile[static_cast<std::size_t>(k) * 3 + 1] = kLogProfileFloor;
    }
    const glm::dvec3 radius = effectiveRadiusMm(profileAt(map, 0, 0));
    EXPECT_GT(radius.x, 1.0);
    EXPECT_EQ(radius.y, 0.0);

    std::fill(map.logProfile.begin(), map.logProfile.end(), kLogProfileFloor);
    EXPECT_GT(effectiveRadiusMap(map).front(), 0.0f) << "a divisor in the renderer";
}

TEST(TexelEnergy, OfAnotherFirstKnotIsThatComputedAnew) {
    MaterialMap map = test::varyingMaterial(8, 8, 24);
    TexelEnergy changed(map.segments);
    TexelEnergy anew(map.segments);
    for (std::size_t i = 0; i < map.logProfile.size();
         i += static_cast<std::size_t>(map.knots()) * 3) {
        float* profile = map.logProfile.data() + i;
        changed.compute(profile);
        profile[0] += 0.7f;
        profile[2] -= 0.2f;
        std::copy_n(profile, 3, changed.logProfile());
        changed.computeFirst();
        anew.compute(profile);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(changed.total(c), anew.total(c));
            for (const float fraction : {0.01f, 0.5f, 0.95f, 0.999f}) {
                const float radius = anew.channelRadius(c, fraction, 0.0f);
                EXPECT_EQ(changed.channelRadius(c, fraction, 0.0f), radius);
                const float bound = anew.radiusBound(c, fraction, 0.0f);
                EXPECT_GE(bound, radius);
                EXPECT_LE(bound, radius + 1.0f);
            }
        }
    }
}

TEST(RadiusMap, AgreesWithTheDoublePrecisionRadii) {
    const MaterialMap map = test::varyingMaterial(13, 7, 24);
    const std::vector<double> fractions = {0.95, 0.99, 1.0};
    std::vector<std::vector<float>> radii;
    for (const double fraction : fractions) {
        radii.push_back(effectiveRadiusMap(map, fraction));
    }
    const std::vector<float> albedo = albedoMap(map);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const auto texel = static_cast<std::size_t>(y * map.width + x);
            for (std::size_t i = 0; i < fractions.size(); ++i) {
                const glm::dvec3 exact = effectiveRadiusMm(profileAt(map, x, y), fractions[i]);
                const double largest = std::max({exact.x, exact.y, exact.z});
                EXPECT_NEAR(static_cast<double>(radii[i][texel]) / largest, 1.0, kSinglePrecision);
            }
            const glm::dvec3 exact = diffuseAlbedo(profileAt(map, x, y));
            EXPECT_NEAR(static_cast<double>(albedo[texel * 3 + 2]) / exact.z, 1.0,
                        kSinglePrecision);
        }
    }
}

TEST(RadiusMap, IsTheSameForAnEdgeCaseProfile) {
    // Rising, flat and very steep pieces in one profile.
    MaterialMap map = test::exponentialMaterial(4, 4.0f, {1.0f, 1.0f, 1.0f});
    map.logProfile = {-3, -30, 0, -2, -30, -29, -2, -4, -30, -2.0001f, -4, -30, -30, -9, -30};
    const glm::dvec3 exact = effectiveRadiusMm(profileAt(map, 0, 0));
    const double largest = std::max({exact.x, exact.y, exact.z});
    EXPECT_NEAR(static_cast<double>(effectiveRadiusMap(map).front()) / largest, 1.0,
                kSinglePrecision);
}

} // namespace
} // namespace celadon::subedit
