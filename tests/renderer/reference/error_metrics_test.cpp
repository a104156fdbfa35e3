#include "renderer/reference/error_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace celadon {
namespace {

TEST(ErrorMetrics, EqualSetsHaveNoError) {
    const std::vector<glm::vec3> a{{1, 2, 3}, {0, 0, 0}};
    const ErrorMetrics metrics = compareExitance(a, a);
    EXPECT_EQ(metrics.relativeRmse, 0.0);
    EXPECT_EQ(metrics.meanRatio, 1.0);
    EXPECT_TRUE(metrics.finite);
}

TEST(ErrorMetrics, AScaledSetIsOffByItsScale) {
    const std::vector<glm::vec3> a{{1, 2, 3}, {4, 1, 0}};
    std::vector<glm::vec3> b = a;
    for (glm::vec3& v : b) {
        v *= 1.25f;
    }
    const ErrorMetrics metrics = compareExitance(b, a);
    EXPECT_NEAR(metrics.relativeRmse, 0.25, 1e-7);
    EXPECT_NEAR(metrics.meanRatio, 1.25, 1e-7);
    EXPECT_NEAR(metrics.largestError, 1.0 / std::sqrt(31.0 / 6.0), 1e-6);
}

TEST(ErrorMetrics, AgainstNothingAnErrorIsInfinite) {
    const std::vector<glm::vec3> zero(2, glm::vec3(0));
    const std::vector<glm::vec3> one(2, glm::vec3(1));
    EXPECT_TRUE(std::isinf(compareExitance(one, zero).relativeRmse));
    EXPECT_EQ(compareExitance(zero, zero).relativeRmse, 0.0);
    EXPECT_EQ(compareExitance(zero, one).relativeRmse, 1.0);
}

TEST(ErrorMetrics, NotANumberIsNoted) {
    const std::vector<glm::vec3> good(2, glm::vec3(1));
    std::vector<glm::vec3> bad = good;
    bad[1].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(compareExitance(bad, good).finite);
    EXPECT_FALSE(compareExitance(good, bad).finite);
}

} // namespace
} // namespace celadon
