#include "subedit/radius_map.h"
#include "subedit/range_table.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

namespace celadon::subedit {
namespace {

MeanProfile homogeneousMean() {
    const MaterialMap map = test::exponentialMaterial(32, 30.0f, {3.0f, 2.5f, 2.0f});
    return meanProfile(map, effectiveRadiusMap(map));
}

TEST(MeanProfile, IsNormalized) {
    const MeanProfile mean = homogeneousMean();
    EXPECT_NEAR(mean.energyBeyond(0.0), 1.0, 1e-12);
    EXPECT_EQ(mean.energyBeyond(1.0), 0.0);
    double sum = 0.0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
        const double r = (i + 0.5) / kSteps;
        sum += mean.value(r) * r / kSteps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(MeanProfile, OfOneTexelIsItsProfileInUnitsOfItsRadius) {
    const MaterialMap map = test::exponentialMaterial(32, 30.0f, {3.0f, 3.0f, 3.0f});
    const std::vector<float> radius = effectiveRadiusMap(map);
    const MeanProfile mean = meanProfile(map, radius);
    for (const double r : {0.0, 0.2, 0.7, 1.0}) {
        const double expected = std::exp(-r * static_cast<double>(radius[0]) / 3.0);
        // Rounding of repeated products in single precision.
        EXPECT_NEAR(mean.value(r) / mean.value(0.0) / expected, 1.0, 1e-4);
    }
}

TEST(MeanProfile, DoesNotDependOnBrightnessOrScale) {
    MaterialMap map = test::varyingMaterial(9, 8, 32); // one shape, cut at r_s, at many sizes
    const MeanProfile before = meanProfile(map, effectiveRadiusMap(map));
    for (std::size_t i = 0; i < map.logProfile.size() / 2; ++i) {
        map.logProfile[i] -= 1.0f;
    }
    const MeanProfile after = meanProfile(map, effectiveRadiusMap(map));
    for (int i = 0; i <= 10; ++i) {
        EXPECT_NEAR(after.value(i * 0.1), before.value(i * 0.1), 1e-3 * before.value(0.0));
    }
}

TEST(RangeTable, SatisfiesTheInequalityThatDefinesIt) {
    const MeanProfile mean = homogeneousMean();
    for (const double epsilon : {0.001, 0.01, 0.05}) {
        for (const double T : {3.0, 10.0, 37.5, 100.0, 777.0}) {
            const double r = minimalRadius(mean, T, epsilon);
            ASSERT_GE(r, 0.0);
            ASSERT_LE(r, 1.0);
            // Above R every r' is good; just below it one is not.
            constexpr int kSteps = 3000;
            for (int i = 0; i <= kSteps; ++i) {
                const double rPrime = r + (1.0 - 1.0 / T - r) * i / kSteps;
                if (rPrime >= r && r < 1.0 - 1.0 / T) {
                    // Between the r' that were looked at the error moves by little: 2 % slack.
                    EXPECT_LT(samplingError(mean, T, rPrime), epsilon * 1.02)
                        << "T " << T << " r' " << rPrime;
                }
            }
            if (r > 0.0 && r < 1.0) {
                double worst = 0.0;
                for (int i = 0; i < 100; ++i) {
                    worst = std::max(worst, samplingError(mean, T, r - 0.15 / T * i / 100.0));
                }
                EXPECT_GE(worst, epsilon * 0.98) << "T " << T << ": R is not the smallest";
            }
        }
    }
}

TEST(RangeTable, FallsFromOneToZeroAsPixelsGetFiner) {
    const RangeTable table = RangeTable::build(homogeneousMean(), 0.01);
    EXPECT_EQ(table.minimalRadius(0.0f), 1.0f);
    EXPECT_EQ(table.minimalRadius(1.0f), 1.0f);
    EXPECT_EQ(table.minimalRadius(-5.0f), 1.0f);
    EXPECT_LT(table.minimalRadius(40.0f), 0.6f);
    EXPECT_LT(table.minimalRadius(4096.0f), 0.05f);
    EXPECT_EQ(table.minimalRadius(1e9f), table.values().back());
    for (int i = kRangeTableEntriesPerOctave; i < kRangeTableEntries; ++i) {
        const auto now = static_cast<std::size_t>(i);
        const auto octaveBefore = static_cast<std::size_t>(i - kRangeTableEntriesPerOctave);
        EXPECT_LE(table.values()[now], table.values()[octaveBefore] + 0.02f);
    }
}

TEST(RangeTable, LargerErrorsAllowSmallerRadii) {
    const MeanProfile mean = homogeneousMean();
    const RangeTable strict = RangeTable::build(mean, 0.001);
    const RangeTable loose = RangeTable::build(mean, 0.01);
    for (int i = 0; i < kRangeTableEntries; ++i) {
        EXPECT_LE(loose.values()[static_cast<std::size_t>(i)],
                  strict.values()[static_cast<std::size_t>(i)]);
    }
}

} // namespace
} // namespace celadon::subedit
