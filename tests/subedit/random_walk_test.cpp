#include "subedit/effective_radius.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/half_space.h"
#include "subedit/models/monte_carlo.h"
#include "subedit/models/random_walk.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>

namespace celadon::subedit {
namespace {

/// Three single scattering albedos in one walk, index-matched, isotropic.
Medium matchedMedium() {
    return {{0.5, 0.1, 0.01}, {0.5, 0.9, 0.99}, 1.0, 0.0};
}

/// What an index-matched half space of isotropic scattering returns of light that falls at a cosine
/// mu, 1 - H(mu) sqrt(1 - w) (Chandrasekhar 1960, chapter V), averaged over cosines 2 mu dmu.
double diffuseTotal(double albedo) {
    constexpr int kSteps = 400;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double mu = (i + 0.5) / kSteps;
        sum += 2.0 * mu * chandrasekharH(mu, albedo) / kSteps;
    }
    return 1.0 - sum * std::sqrt(1.0 - albedo);
}

TEST(RandomWalk, PencilReturnsChandrasekharsTotal) {
    const RandomWalkResult result = simulateRandomWalk(matchedMedium(), {400'000, 11});
    const double albedos[] = {0.5, 0.9, 0.99};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double albedo = albedos[channel];
        const double exact = 1.0 - chandrasekharH(1.0, albedo) * std::sqrt(1.0 - albedo);
        const RadialHistogram& histogram = result.channels[channel];
        EXPECT_NEAR(histogram.total, exact, 3.0 * histogram.totalError) << albedo;
        EXPECT_LT(histogram.totalError, 0.004 * exact); // a test that could fail
    }
}

TEST(RandomWalk, DiffuseEntryReturnsChandrasekharsTotal) {
    const RandomWalkResult result =
        simulateRandomWalk(matchedMedium(), {400'000, 12, LightEntry::Diffuse});
    const double albedos[] = {0.5, 0.9, 0.99};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double exact = diffuseTotal(albedos[channel]);
        const RadialHistogram& histogram = result.channels[channel];
        EXPECT_NEAR(histogram.total, exact, 3.0 * histogram.totalError) << albedos[channel];
        EXPECT_LT(histogram.totalError, 0.004 * exact);
    }
}

TEST(RandomWalk, RefractionReturnsTheExactTotal) {
    Medium medium = matchedMedium();
    for (const double eta : {1.4, 0.8}) {
        medium.eta = eta;
        const RandomWalkResult result = simulateRandomWalk(medium, {200'000, 13});
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const RadialHistogram& histogram = result.channels[channel];
            const double exact =
                halfSpaceTotal(medium.reducedAlbedo()[static_cast<int>(channel)], eta);
            EXPECT_NEAR(histogram.total, exact, 3.0 * histogram.totalError) << eta;
        }
    }
}

TEST(RandomWalk, NothingIsLostWhereNothingAbsorbs) {
    const RandomWalkResult result =
        simulateRandomWalk({glm::dvec3(0.0), glm::dvec3(1.0, 2.0, 5.0), 1.3, 0.0}, {20'000, 5});
    for (const RadialHistogram& histogram : result.channels) {
        EXPECT_NEAR(histogram.total, 1.0, 3.0 * histogram.totalError + 2e-4);
        EXPECT_LT(histogram.totalError, 0.02);
    }
}

TEST(RandomWalk, SameSeedSameBitsWhateverTheThreads) {
    const Medium medium{{0.05, 0.1, 0.2}, {1.0, 1.0, 1.0}, 1.4, 0.5};
    const RandomWalkResult many = simulateRandomWalk(medium, {20'000, 3});
    RandomWalkResult one;
    {
        const oneapi::tbb::global_control control(
            oneapi::tbb::global_control::max_allowed_parallelism, 1);
        one = simulateRandomWalk(medium, {20'000, 3});
    }
    EXPECT_EQ(one.edgesMm, many.edgesMm);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_EQ(one.channels[channel].energy, many.channels[channel].energy);
        EXPECT_EQ(one.channels[channel].error, many.channels[channel].error);
    }
    const RandomWalkResult other = simulateRandomWalk(medium, {20'000, 4});
    EXPECT_NE(other.channels[0].total, one.channels[0].total);
}

TEST(RandomWalk, ErrorsAreWhatRepetitionsShow) {
    const Medium medium{glm::dvec3(0.1), glm::dvec3(1.0), 1.3, 0.0};
    double sum = 0.0;
    double squares = 0.0;
    double claimed = 0.0;
    constexpr int kRuns = 40;
    for (int run = 0; run < kRuns; ++run) {
        const RandomWalkResult result =
            simulateRandomWalk(medium, {2000, static_cast<std::uint64_t>(run) + 100});
        sum += result.channels[0].total;
        squares += result.channels[0].total * result.channels[0].total;
        claimed += result.channels[0].totalError / kRuns;
    }
    const double spread = std::sqrt((squares - sum * sum / kRuns) / (kRuns - 1));
    // 40 runs know their spread to 11 %.
    EXPECT_NEAR(spread / claimed, 1.0, 0.35);
}

TEST(RandomWalk, ForwardScatteringIsSimilarToItsReducedMedium) {
    // Far from the beam only sigma_s' counts.
    const Medium isotropic{glm::dvec3(0.02), glm::dvec3(1.0), 1.3, 0.0};
    Medium forward = isotropic;
    forward.anisotropy = 0.7;
    const RadialCurves a = monteCarloProfile(simulateRandomWalk(isotropic, {200'000, 1}));
    const RadialCurves b = monteCarloProfile(simulateRandomWalk(forward, {200'000, 2}));
    EXPECT_NEAR(b[0].total / a[0].total, 1.0, 0.05);
    EXPECT_NEAR(b[0].reflectance(6.0) / a[0].reflectance(6.0), 1.0, 0.1);
    EXPECT_NE(b[0].total, a[0].total);
}

TEST(RandomWalk, ScalingLengthsScalesTheProfile) {
    const Medium medium{glm::dvec3(0.1), glm::dvec3(1.0), 1.3, 0.3};
    const Medium scaled{glm::dvec3(0.05), glm::dvec3(0.5), 1.3, 0.3};
    const RandomWalkResult one = simulateRandomWalk(medium, {5000, 7});
    const RandomWalkResult two = simulateRandomWalk(scaled, {5000, 7});
    ASSERT_EQ(one.bins(), two.bins());
    for (std::size_t bin = 0; bin < one.bins(); ++bin) {
        EXPECT_NEAR(two.edgesMm[bin], 2.0 * one.edgesMm[bin], 1e-12 * two.edgesMm[bin]);
        EXPECT_NEAR(two.reflectance(0, bin) * 4.0, one.reflectance(0, bin),
                    1e-9 * one.reflectance(0, bin));
    }
}

TEST(MonteCarlo, AFewWalksStillGiveACurve) {
    const Medium medium{{0.061, 0.97, 1.45}, {0.18, 0.07, 0.03}, 1.3, 0.0};
    for (const int walks : {1, 2, 10}) {
        const RadialCurves curves = monteCarloProfile(simulateRandomWalk(medium, {walks, 1}));
        const FittedProfile fitted = fitProfile(curves, {8});
        EXPECT_LT(fitted.maxRadiusMm, 1e4f);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(diffuseAlbedo(fitted.view())[channel],
                        curves[static_cast<std::size_t>(channel)].total, 1e-3);
        }
    }
}

TEST(MonteCarlo, CurveHoldsTheEnergyOfTheRings) {
    const RandomWalkResult result =
        simulateRandomWalk({{0.02, 0.1, 0.5}, glm::dvec3(1.0), 1.3, 0.0}, {100'000, 21});
    const RadialCurves curves = monteCarloProfile(result);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double within = 0.0;
        for (std::size_t bin = 0; bin < result.bins(); ++bin) {
            within += result.channels[channel].energy[bin];
            const double r = result.edgesMm[bin + 1];
            EXPECT_NEAR(curves[channel].energyWithin(r), within,
                        0.01 * result.channels[channel].total);
        }
        EXPECT_EQ(curves[channel].total, result.channels[channel].total);
    }
    const FittedProfile fitted = fitProfile(curves, {48});
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(diffuseAlbedo(fitted.view())[channel],
                    curves[static_cast<std::size_t>(channel)].total, 1e-3);
    }
}

} // namespace
} // namespace celadon::subedit
