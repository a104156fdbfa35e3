#include "subedit/models/dipole.h"
#include "subedit/models/half_space.h"
#include "subedit/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace celadon::subedit {
namespace {

TEST(HalfSpace, HIsChandrasekhars) {
    // Chandrasekhar 1960, table XI, isotropic scattering.
    EXPECT_NEAR(chandrasekharH(1.0, 1.0), 2.9078, 1e-3);
    EXPECT_NEAR(chandrasekharH(0.0, 0.8), 1.0, 1e-12);
    EXPECT_EQ(chandrasekharH(0.5, 0.0), 1.0);
}

TEST(HalfSpace, ReturnsAllLightWhenNothingAbsorbs) {
    for (const double eta : {1.0, 1.3, 1.5, 0.8}) {
        EXPECT_NEAR(halfSpaceTotal(1.0, eta), 1.0, 1e-4) << eta;
    }
    EXPECT_EQ(halfSpaceTotal(0.0, 1.3), 0.0);
}

TEST(HalfSpace, WithoutRefractionIsTheClosedForm) {
    for (const double albedo : {0.3, 0.5, 0.9, 0.99}) {
        EXPECT_NEAR(halfSpaceTotal(albedo, 1.0),
                    1.0 - chandrasekharH(1.0, albedo) * std::sqrt(1.0 - albedo), 1e-9);
    }
}

TEST(HalfSpace, AgreesWithARandomWalk) {
    constexpr int kWalks = 40000;
    for (const double eta : {1.0, 1.4}) {
        constexpr double kAlbedo = 0.95;
        std::mt19937 generator(7);
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        double sum = 0.0;
        double sumOfSquares = 0.0;
        for (int walk = 0; walk < kWalks; ++walk) {
            double weight = 1.0;
            double left = 0.0;
            double depth = -std::log(1.0 - uniform(generator)); // entered perpendicularly
            while (weight > 1e-4) {
                weight *= kAlbedo;
                double direction = 2.0 * uniform(generator) - 1.0; // isotropic, down is positive
                double length = -std::log(1.0 - uniform(generator));
                while (direction < 0.0 && -direction * length > depth) {
                    const double reflectance =
                        eta == 1.0 ? 0.0 : fresnelReflectance(-direction, 1.0 / eta);
                    left += weight * (1.0 - reflectance);
                    weight *= reflectance;
                    length -= depth / -direction;
                    depth = 0.0;
                    direction = -direction;
                }
                depth += direction * length;
            }
            sum += left;
            sumOfSquares += left * left;
        }
        const double mean = sum / kWalks;
        const double error = std::sqrt((sumOfSquares / kWalks - mean * mean) / kWalks);
        EXPECT_NEAR(halfSpaceTotal(kAlbedo, eta), mean, 3.5 * error) << eta;
    }
}

TEST(HalfSpace, IsNearTheDipoleWhereDiffusionHolds) {
    const Medium& milk = findMediumPreset("wholemilk");
    EXPECT_NEAR(halfSpaceTotal(milk).x, dipoleTotal(milk).x, 0.03);
}

} // namespace
} // namespace celadon::subedit
