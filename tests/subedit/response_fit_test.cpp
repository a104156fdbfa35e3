#include "subedit/errors.h"
#include "subedit/fit/response_fit.h"
#include "subedit/radius_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace celadon::subedit {
namespace {

/// An exponential profile of albedo 0.5 whose length varies with u.
double trueProfile(double u, double r) {
    const double length = 2.0 + std::sin(2.0 * std::numbers::pi * u);
    return 0.5 * std::exp(-r / length) / (2.0 * std::numbers::pi * length * length);
}

/// Pairs on a flat sample of 100 mm that repeats.
std::vector<ResponseSample> measure(int count, double noise) {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::normal_distribution<double> normal(0.0, noise);
    std::vector<ResponseSample> samples;
    for (int i = 0; i < count; ++i) {
        const double u = uniform(generator);
        const double v = uniform(generator);
        const double r = 15.0 * uniform(generator);
        const double angle = 2.0 * std::numbers::pi * uniform(generator);
        const double uOut = u + 0.01 * r * std::cos(angle);
        const double vOut = v + 0.01 * r * std::sin(angle);
        const double response = std::sqrt(trueProfile(u, r) * trueProfile(uOut, r)) *
                                std::exp(noise > 0.0 ? normal(generator) : 0.0);
        samples.push_back({{u, v},
                           {uOut, vOut},
                           static_cast<float>(r),
                           glm::vec3(response, 0.5 * response, 0.0)});
    }
    return samples;
}

TEST(ResponseFit, FindsTheProfilesThatMadeTheResponses) {
    ResponseFitSettings settings;
    settings.width = 16;
    settings.height = 2;
    const ResponseFit fit = fitResponses(measure(20'000, 0.02), settings);
    EXPECT_EQ(fit.used, 20'000u);
    EXPECT_EQ(fit.texelsWithout, 0);
    EXPECT_LT(fit.relativeError.x, 0.03); // the noise is 0.02
    EXPECT_GT(fit.relativeError.x, 0.01);
    for (int x = 0; x < 16; ++x) {
        const double u = (x + 0.5) / 16.0;
        const glm::dvec3 albedo = diffuseAlbedo(profileAt(fit.map, x, 0));
        // Cut at 15 mm, which is 5 lengths or more.
        EXPECT_NEAR(albedo.x, 0.5, 0.03) << x;
        EXPECT_NEAR(albedo.y, 0.25, 0.02) << x;
        EXPECT_LT(albedo.z, 1e-6);
        const double logP = static_cast<double>(fit.map.logKnot(x, 0, 8).x); // 5 mm
        EXPECT_NEAR(logP, std::log(trueProfile(u, 5.0)), 0.1) << x;
    }
}

TEST(ResponseFit, OneTexelIsAHomogeneousProfile) {
    std::vector<ResponseSample> samples;
    for (int i = 0; i < 200; ++i) {
        const float r = 0.1f * static_cast<float>(i);
        samples.push_back({{0.2f, 0.3f}, {0.7f, 0.1f}, r, glm::vec3(0.01f * std::exp(-r / 3.0f))});
    }
    ResponseFitSettings settings;
    settings.width = settings.height = 1;
    settings.radialSmoothness = 1e-3;
    const ResponseFit fit = fitResponses(samples, settings);
    for (int k = 0; k <= 24; ++k) {
        const float r = fit.map.maxRadiusMm * static_cast<float>(k) / 24.0f;
        EXPECT_NEAR(fit.map.logKnot(0, 0, k).x, std::log(0.01f) - r / 3.0f, 0.02f);
    }
}

TEST(ResponseFit, AlbedoAboveOneIsScaledAndCounted) {
    std::vector<ResponseSample> samples = measure(2000, 0.0);
    for (ResponseSample& sample : samples) {
        sample.response *= 10.0f;
    }
    ResponseFitSettings settings;
    settings.width = settings.height = 2;
    const ResponseFit fit = fitResponses(samples, settings);
    EXPECT_EQ(fit.clamped, 4);
    for (const float albedo : albedoMap(fit.map)) {
        EXPECT_LE(albedo, 1.0001f);
    }
}

TEST(ResponseFit, WhatNothingReachesFollowsItsNeighbors) {
    std::vector<ResponseSample> samples;
    for (int i = 0; i < 400; ++i) { // only around u = 0.1
        const float r = 0.05f * static_cast<float>(i);
        samples.push_back({{0.1f, 0.5f}, {0.12f, 0.5f}, r, glm::vec3(std::exp(-r))});
    }
    ResponseFitSettings settings;
    settings.width = 8;
    settings.height = 1;
    const ResponseFit fit = fitResponses(samples, settings);
    EXPECT_GT(fit.texelsWithout, 3);
    EXPECT_NEAR(fit.map.logKnot(4, 0, 6).x, fit.map.logKnot(0, 0, 6).x, 0.5f);
}

TEST(ResponseFit, NothingUsableIsRefused) {
    const std::vector<ResponseSample> dark{{{0, 0}, {1, 1}, 1.0f, glm::vec3(0.0f)}};
    EXPECT_THROW(static_cast<void>(fitResponses(dark, {})), InputError);
    EXPECT_THROW(static_cast<void>(fitResponses({}, {})), InputError);
    const std::vector<ResponseSample> far{{{0, 0}, {1, 1}, 9.0f, glm::vec3(1.0f)}};
    ResponseFitSettings settings;
    settings.maxRadiusMm = 5.0;
    EXPECT_THROW(static_cast<void>(fitResponses(far, settings)), InputError);
}

} // namespace
} // namespace celadon::subedit
