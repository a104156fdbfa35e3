#include "renderer/shading/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace celadon {
namespace {

constexpr double kIndices[] = {1.0001, 1.1, 1.3, 1.5, 2.4};

/// Closed form of the diffuse reflectance of a dielectric, eta > 1 (Walsh 1926; Duntley 1942).
double walshReflectance(double n) {
    const double n2 = n * n;
    const double n4 = n2 * n2;
    return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
           n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
           2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
           8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

TEST(Fresnel, NormalIncidenceIsTheClosedForm) {
    for (const double eta : kIndices) {
        const double expected = std::pow((eta - 1) / (eta + 1), 2);
        EXPECT_NEAR(fresnelReflectance(1.0, eta), expected, 1e-15);
        EXPECT_NEAR(fresnelReflectance(1.0, 1 / eta), expected, 1e-15);
    }
}

TEST(Fresnel, GrazingIncidenceReflectsAll) {
    for (const double eta : kIndices) {
        EXPECT_DOUBLE_EQ(fresnelReflectance(0.0, eta), 1.0);
        EXPECT_DOUBLE_EQ(fresnelReflectance(-0.3, eta), 1.0);
    }
}

TEST(Fresnel, NoBoundaryReflectsNothing) {
    for (const double cosTheta : {0.0, 1e-9, 0.5, 1.0}) {
        EXPECT_EQ(fresnelReflectance(cosTheta, 1.0), 0.0);
    }
    EXPECT_NEAR(diffuseTransmittance(1.0), 1.0, 1e-12);
}

TEST(Fresnel, BrewsterAngleReflectsHalfOfThePerpendicularPartOnly) {
    const double eta = 1.5;
    const double cosI = std::cos(std::atan(eta));
    const double r = (1 - eta * eta) / (1 + eta * eta); // perpendicular amplitude at Brewster
    EXPECT_NEAR(fresnelReflectance(cosI, eta), 0.5 * r * r, 1e-14);
}

TEST(Fresnel, TotalInternalReflectionBeyondTheCriticalAngle) {
    const double eta = 1 / 1.3;
    const double critical = std::sqrt(1 - eta * eta);
    EXPECT_EQ(fresnelReflectance(critical - 1e-9, eta), 1.0);
    EXPECT_LT(fresnelReflectance(critical + 1e-3, eta), 1.0);
    EXPECT_EQ(fresnelReflectance(0.0, eta), 1.0);
}

TEST(Fresnel, TransmissionIsReciprocal) {
    for (const double eta : kIndices) {
        for (int i = 1; i <= 20; ++i) {
            const double cosI = i / 20.0;
            const double cosT = std::sqrt(1 - (1 - cosI * cosI) / (eta * eta));
            EXPECT_NEAR(fresnelTransmittance(cosI, eta), fresnelTransmittance(cosT, 1 / eta),
                        1e-12);
        }
    }
}

TEST(Fresnel, StaysWithinBoundsAndFallsWithTheCosine) {
    for (const double eta : kIndices) {
        double last = 1.0;
        for (int i = 0; i <= 1000; ++i) {
            const double r = fresnelReflectance(i / 1000.0, eta);
            EXPECT_GE(r, 0.0);
            EXPECT_LE(r, 1.0);
            EXPECT_LE(r, last + 1e-12);
            last = r;
        }
    }
}

TEST(DiffuseTransmittance, IsTheClosedFormFromBothSides) {
    for (const double eta : {1.05, 1.1, 1.3, 1.5, 2.4}) {
        const double expected = 1 - walshReflectance(eta);
        EXPECT_NEAR(diffuseTransmittance(eta), expected, 1e-11) << eta;
        // Radiance over index squared is kept: what passes outwards is 1/eta^2 of what passes in.
        EXPECT_NEAR(diffuseTransmittance(1 / eta), expected / (eta * eta), 1e-11) << eta;
    }
}

TEST(DiffuseTransmittance, IsTheMidpointSumOverAngles) {
    for (const double eta : {0.7, 1.0001, 1.3}) {
        constexpr int kSteps = 200000;
        const double step = 0.5 * std::numbers::pi / kSteps;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double theta = (i + 0.5) * step;
            sum += 2 * fresnelTransmittance(std::cos(theta), eta) * std::cos(theta) *
                   std::sin(theta) * step;
        }
        EXPECT_NEAR(diffuseTransmittance(eta), sum, 2e-8) << eta;
    }
}

} // namespace
} // namespace celadon
