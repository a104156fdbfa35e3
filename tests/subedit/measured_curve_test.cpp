#include "subedit/errors.h"
#include "subedit/fit/measured_curve.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/dipole.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/models/photon_beam.h"
#include "subedit/presets.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace celadon::subedit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// `count` rows up to `to`; without r = 0 where the curve is infinite.
std::string csvOf(const RadialCurves& curves, double to, int count) {
    std::string csv = "r_mm,R,G,B\n";
    for (int i = std::isinf(curves[0].reflectance(0.0)) ? 1 : 0; i <= count; ++i) {
        const double r = to * i / count;
        csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", r, curves[0].reflectance(r),
                           curves[1].reflectance(r), curves[2].reflectance(r));
    }
    return csv;
}

TEST(MeasuredCurve, KeepsTheEnergyOfWhatWasSampled) {
    const RadialCurves nd = normalizedDiffusionProfile({0.9, 0.5, 0.1}, {2.0, 1.0, 0.5});
    const RadialCurves dipole = dipoleProfile(findMediumPreset("skin2"));
    const RadialCurves beam = photonBeamProfile(findMediumPreset("marble"));
    for (const RadialCurves& curves : {nd, dipole, beam}) {
        const double to = radiusHolding(curves[0], 0.999);
        const RadialCurves read = measuredCurves(parseProfileCsv(csvOf(curves, to, 256), "x"));
        for (std::size_t c = 0; c < 3; ++c) {
            // Channels whose range is eight times shorter are sampled that much less.
            EXPECT_NEAR(read[c].total / curves[c].energyWithin(to), 1.0, 6e-2) << c;
        }
        // The channel that the table was made for.
        EXPECT_NEAR(read[0].total / curves[0].energyWithin(to), 1.0, 2e-3);
    }
}

TEST(MeasuredCurve, EnergyIsTheIntegralOfP) {
    const RadialCurves nd = normalizedDiffusionProfile({0.9, 0.5, 0.1}, {2.0, 1.0, 0.5});
    const RadialCurve curve = measuredCurves(parseProfileCsv(csvOf(nd, 10.0, 40), "x"))[0];
    double sum = 0.0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double r = 7.0 * std::pow((i + 0.5) / kSteps, 2);
        const double dr = 7.0 * (2.0 * i + 1.0) / (static_cast<double>(kSteps) * kSteps);
        sum += 2.0 * std::numbers::pi * curve.reflectance(r) * r * dr;
    }
    EXPECT_NEAR(sum, curve.energyWithin(7.0), 1e-4 * sum);
    EXPECT_EQ(curve.reflectance(10.01), 0.0);
    EXPECT_EQ(curve.energyWithin(50.0), curve.total);
}

TEST(MeasuredCurve, TheCenterIsAsAsked) {
    const MeasuredProfile profile = parseProfileCsv("1,0.1\n2,0.05\n4,0.025\n", "x");
    const auto flat = measuredCurves(profile, CurveCenter::Flat)[0];
    EXPECT_NEAR(flat.reflectance(0.0), 0.1, 1e-12);
    EXPECT_NEAR(flat.energyWithin(1.0), 0.1 * std::numbers::pi, 1e-9);
    const auto singular = measuredCurves(profile, CurveCenter::Singular)[0];
    EXPECT_TRUE(std::isinf(singular.reflectance(0.0)));
    EXPECT_NEAR(singular.energyWithin(1.0), 0.2 * std::numbers::pi, 1e-9);
    // Halved at twice the radius, twice: 1/r.
    EXPECT_NEAR(measuredCurves(profile)[0].energyWithin(1.0), 0.2 * std::numbers::pi, 1e-9);
}

TEST(MeasuredCurve, ReadsWhatPeopleWrite) {
    const MeasuredProfile profile = parseProfileCsv(
        "# measured on a Tuesday\r\nradius;p\r\n0; 1e-3\r\n\r\n+1;1e-4\r\n2;0\r\n", "x");
    ASSERT_EQ(profile.radiiMm.size(), 3u);
    EXPECT_EQ(profile.value[1][2], 1e-4);
    EXPECT_GT(measuredCurves(profile)[0].total, 0.0);
    // Columns of standard errors are left out.
    EXPECT_EQ(parseProfileCsv("r_mm,R,G,B,R_error\n1,1,2,3,9\n2,1,2,3,9\n", "x").value[0][2], 3.0);
}

TEST(MeasuredCurve, HostileTablesAreRefusedWithTheLine) {
    const auto expectRefused = [](const char* text, const testing::Matcher<std::string>& says) {
        try {
            static_cast<void>(parseProfileCsv(text, "f.csv"));
            FAIL() << text;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("'f.csv'"), says));
        }
    };
    expectRefused("", HasSubstr("0 rows"));
    expectRefused("r,P\n", HasSubstr("0 rows"));
    expectRefused("1,2\n", HasSubstr("1 rows"));
    expectRefused("0,2\n1,2\n", HasSubstr("1 rows"));
    expectRefused("2,1\n1,1\n", AllOf(HasSubstr("line 2"), HasSubstr("does not rise")));
    expectRefused("1,1\n1,1\n", HasSubstr("does not rise"));
    expectRefused("1,1\n2,-1\n", AllOf(HasSubstr("line 2"), HasSubstr("-1")));
    expectRefused("1,1\n2,nan\n", HasSubstr("column 2"));
    expectRefused("1,1\n2,inf\n", HasSubstr("column 2"));
    expectRefused("1,1\n2,1e999\n", HasSubstr("column 2"));
    expectRefused("1,1\n2,1e30\n", HasSubstr("above 1e+17"));
    expectRefused("1,1\n2,x\n", HasSubstr("'x'"));
    expectRefused("1,1\n2,\x01\xff\n", HasSubstr("'?\?'"));
    expectRefused("1,1,1\n2,1,1\n", HasSubstr("3 columns"));
    expectRefused("1\n2\n", HasSubstr("1 columns"));
}

TEST(ProfileFit, ChoosesSegmentsAndKeepsTheAlbedo) {
    const RadialCurves dipole = dipoleProfile(findMediumPreset("marble"));
    const RadialCurves beam = photonBeamProfile(findMediumPreset("marble"));
    int coarse = 0;
    for (const RadialCurves& curves : {dipole, beam}) {
        const FittedProfile fitted = fitProfileWithin(curves, 0.05);
        const FitError error = measureFit(curves, fitted);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LT(std::abs(error.albedo[c]), 1e-3 * curves[static_cast<std::size_t>(c)].total);
            EXPECT_LT(error.rmsLogOutside[c], 0.05);
            EXPECT_LT(error.misplaced[c], 0.05);
        }
        coarse = fitted.segments;
        EXPECT_GE(fitProfileWithin(curves, 0.01).segments, coarse);
        EXPECT_LT(coarse, 128);
    }
}

TEST(ProfileFit, BlackIsNoError) {
    const RadialCurves black = measuredCurves(parseProfileCsv("0,0\n1,0\n2,0\n", "x"));
    const FitError error = measureFit(black, fitProfile(black, {8}));
    EXPECT_EQ(error.misplaced, glm::dvec3(0.0));
    EXPECT_LT(std::abs(error.albedo.x), 1e-9);
}

TEST(ProfileFit, MisplacedEnergyIsSeen) {
    // A fit of another curve: the measure can fail.
    const RadialCurves one = normalizedDiffusionProfile(glm::dvec3(0.8), glm::dvec3(1.0));
    const RadialCurves two = normalizedDiffusionProfile(glm::dvec3(0.8), glm::dvec3(2.0));
    const FittedProfile fitted = fitProfile(one, {64});
    EXPECT_LT(measureFit(one, fitted).misplaced.x, 0.03);
    EXPECT_GT(measureFit(two, fitted).misplaced.x, 0.2);
}

TEST(ProfileFit, PeaksDoNotBendTheOtherKnots) {
    const RadialCurves curves = normalizedDiffusionProfile(glm::dvec3(0.8), glm::dvec3(1.0));
    const FittedProfile fitted = fitProfile(curves, {32});
    const double h = static_cast<double>(fitted.maxRadiusMm) / 32.0;
    for (const int k : {1, 2, 3, 8}) {
        EXPECT_NEAR(
            std::exp(static_cast<double>(fitted.logProfile[static_cast<std::size_t>(k) * 3])) /
                curves[0].reflectance(k * h),
            1.0, 0.07)
            << k;
    }
}

} // namespace
} // namespace celadon::subedit
