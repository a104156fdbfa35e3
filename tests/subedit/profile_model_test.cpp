#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/dipole.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/presets.h"
#include "tests/support/curves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace celadon::subedit {
namespace {

using test::integrate;

TEST(Dipole, IntegratesToItsClosedForms) {
    const Medium& marble = findMediumPreset("marble");
    const RadialCurves curves = dipoleProfile(marble);
    const glm::dvec3 total = dipoleTotal(marble);
    for (int channel = 0; channel < 3; ++channel) {
        const RadialCurve& curve = curves[static_cast<std::size_t>(channel)];
        EXPECT_NEAR(integrate(curve, 1e-5, 500.0) / total[channel], 1.0, 1e-5);
        EXPECT_NEAR(integrate(curve, 1e-5, 3.0) / curve.energyWithin(3.0), 1.0, 1e-5);
    }
}

TEST(Dipole, ScalingLengthsByTwoScalesPByAQuarter) {
    const Medium& skin = findMediumPreset("skin1");
    Medium scaled = skin;
    scaled.absorption *= 0.5;
    scaled.reducedScattering *= 0.5;
    const RadialCurves one = dipoleProfile(skin);
    const RadialCurves two = dipoleProfile(scaled);
    for (const double r : {0.0, 0.1, 1.0, 7.0}) {
        EXPECT_NEAR(two[0].reflectance(2.0 * r) * 4.0 / one[0].reflectance(r), 1.0, 1e-12);
    }
}

TEST(Dipole, FresnelFitIsContinuousWhereItsTwoFormulasMeet) {
    // Two independent fits: they agree to their own accuracy, and both are nearly 0 at eta = 1.
    EXPECT_NEAR(diffuseFresnelReflectance(1.0), 0.0, 0.005);
    EXPECT_NEAR(diffuseFresnelReflectance(0.999), 0.0, 0.005);
    EXPECT_NEAR(diffuseFresnelReflectance(1.3), 0.445, 0.005);
}

TEST(Medium, FromAlbedoAndMeanFreePathAndBack) {
    const Medium medium = mediumFromAlbedo({0.9, 0.5, 1.0}, {2.0, 1.0, 0.5}, 1.4);
    EXPECT_NEAR(medium.reducedAlbedo().x, 0.9, 1e-12);
    EXPECT_NEAR(1.0 / medium.reducedExtinction().z, 0.5, 1e-12);
    EXPECT_EQ(medium.absorption.z, 0.0);
}

TEST(Medium, ImpossibleCoefficientsAreNamed) {
    Medium medium;
    medium.absorption.y = -0.1;
    try {
        validateMedium(medium);
        FAIL() << "negative absorption was accepted";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("green"), std::string::npos) << error.what();
    }
    medium = {};
    medium.reducedScattering.x = std::nan("");
    EXPECT_THROW(validateMedium(medium), UsageError);
    medium = {};
    medium.eta = 0.0;
    EXPECT_THROW(validateMedium(medium), UsageError);
    EXPECT_THROW(static_cast<void>(findMediumPreset("cheese")), UsageError);
}

TEST(NormalizedDiffusion, IntegratesToTheAlbedo) {
    for (const DiffusionFit fit :
         {DiffusionFit::Searchlight, DiffusionFit::Diffuse, DiffusionFit::Dmfp}) {
        const RadialCurves curves =
            normalizedDiffusionProfile({0.9, 0.5, 0.02}, {3.0, 1.0, 0.2}, fit);
        for (const RadialCurve& curve : curves) {
            EXPECT_NEAR(integrate(curve, 1e-9, 300.0) / curve.total, 1.0, 1e-5);
            EXPECT_NEAR(integrate(curve, 1e-9, 1.5) / curve.energyWithin(1.5), 1.0, 1e-5);
        }
    }
}

TEST(NormalizedDiffusion, ScaleIsThePublishedOne) {
    EXPECT_NEAR(normalizedDiffusionScale(0.8, DiffusionFit::Searchlight), 1.05, 1e-12);
    EXPECT_NEAR(normalizedDiffusionScale(0.8, DiffusionFit::Diffuse), 1.1, 1e-12);
    EXPECT_NEAR(normalizedDiffusionScale(0.33, DiffusionFit::Dmfp), 3.5, 1e-12);
}

TEST(ProfileFit, KeepsTheTotalOfSingularAndSmoothCurves) {
    std::vector<RadialCurves> all = {
        normalizedDiffusionProfile({0.95, 0.6, 0.2}, {4.0, 2.0, 0.5}),
        normalizedDiffusionProfile({0.95, 0.0, 1.0}, {4.0, 2.0, 0.01})};
    for (const MediumPreset& preset : mediumPresets()) {
        all.push_back(dipoleProfile(preset.medium));
    }
    for (const RadialCurves& curves : all) {
        for (const int segments : {4, 24, 32, 256}) {
            const FittedProfile fitted = fitProfile(curves, {segments});
            const glm::dvec3 albedo = diffuseAlbedo(fitted.view());
            for (int channel = 0; channel < 3; ++channel) {
                // Knots in single precision; a black channel holds the floor, some 1e-10.
                EXPECT_NEAR(albedo[channel], curves[static_cast<std::size_t>(channel)].total, 1e-5)
                    << segments << " segments, " << channelName(channel);
            }
        }
    }
}

TEST(ProfileFit, HoldsThatMuchEnergyAndFollowsTheCurve) {
    const RadialCurves curves = dipoleProfile(findMediumPreset("skin1"));
    const FittedProfile coarse = fitProfile(curves, {16});
    const FittedProfile fine = fitProfile(curves, {64});
    EXPECT_NEAR(curves[0].energyWithin(static_cast<double>(fine.maxRadiusMm)) / curves[0].total,
                0.999, 1e-6);
    EXPECT_LT(fine.rmsLogError.x, 0.01);
    EXPECT_LT(fine.rmsLogError.x, coarse.rmsLogError.x);
    const glm::dvec3 radius = effectiveRadiusMm(fine.view());
    // 0.1 % of the energy beyond r_s was given back inside.
    EXPECT_NEAR(radius.x / radiusHolding(curves[0], 0.95), 1.0, 0.01);
}

} // namespace
} // namespace celadon::subedit
