#include "subedit/document/document.h"
#include "subedit/effective_radius.h"
#include "subedit/errors.h"
#include "subedit/radius_map.h"

#include <gtest/gtest.h>

#include <cmath>

// Operators that look at other texels: heterogeneity, clone, transfer of patterns.
namespace celadon::subedit {
namespace {

constexpr int kSize = 64;
constexpr int kSegments = 16;

/// Exponentials of 1.5 mm; ln P is shifted by `shift(x, y)`.
template<typename Shift>
MaterialMap shifted(const Shift& shift) {
    MaterialMap map;
    map.width = map.height = kSize;
    map.segments = kSegments;
    map.maxRadiusMm = 15.0f;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            for (int k = 0; k <= kSegments; ++k) {
                const float r = 15.0f * static_cast<float>(k) / kSegments;
                map.logProfile.insert(map.logProfile.end(), 3,
                                      std::log(0.02f) - r / 1.5f + shift(x, y));
            }
        }
    }
    return map;
}

/// 1 mm a texel; the left half has waves, the right half is plain and darker.
float wavesLeft(int x, int y) {
    return x < kSize / 2 ? 0.3f * std::sin(1.1f * static_cast<float>(x)) *
                               std::cos(0.9f * static_cast<float>(y))
                         : -0.7f;
}

StrokePoint point(float x, float y) {
    return {{x, -y, 0.0f}, {0.0f, 0.0f, 1.0f}, {}, 1.0f};
}

double meanOf(const MaterialMap& map, int x0, int x1) {
    double sum = 0.0;
    for (int y = 16; y < 48; ++y) {
        for (int x = x0; x < x1; ++x) {
            sum += static_cast<double>(map.logKnot(x, y, 2).y);
        }
    }
    return sum / (32.0 * (x1 - x0));
}

double deviationOf(const MaterialMap& map, int x0, int x1) {
    const double mean = meanOf(map, x0, x1);
    double sum = 0.0;
    for (int y = 16; y < 48; ++y) {
        for (int x = x0; x < x1; ++x) {
            sum += std::pow(static_cast<double>(map.logKnot(x, y, 2).y) - mean, 2.0);
        }
    }
    return std::sqrt(sum / (32.0 * (x1 - x0)));
}

TEST(Heterogeneity, SharpensAndSmoothsAboutTheLocalMean) {
    const MaterialMap original = shifted(wavesLeft);
    const double before = deviationOf(original, 8, 24);
    for (const float amount : {-1.0f, -0.5f, 0.5f, 1.0f}) {
        Document document(original,
                          std::make_shared<Surface>(makeFlatSurface(kSize, kSize, 64.0f)));
        document.execute(ApplyCommand{Heterogeneity{amount, 8.0f}});
        const MaterialMap& after = document.material();
        const double expected = 1.0 + static_cast<double>(amount);
        EXPECT_NEAR(deviationOf(after, 8, 24) / before, expected, 0.12) << "amount " << amount;
        EXPECT_NEAR(meanOf(after, 8, 24), meanOf(original, 8, 24), 0.02);
        // What is uniform over the whole neighborhood stays.
        EXPECT_NEAR(after.logKnot(52, 32, 3).x, original.logKnot(52, 32, 3).x, 1e-4f);
    }
}

TEST(Clone, CopiesTheProfilesOfAnotherPlace) {
    const MaterialMap original = shifted(wavesLeft);
    Document document(original, std::make_shared<Surface>(makeFlatSurface(kSize, kSize, 64.0f)));
    // 30 texels to the right, 2 down.
    document.execute(StrokeCommand{Clone{{point(10.5f, 20.5f), point(40.5f, 22.5f), 0.0f}},
                                   {.radiusMm = 8.0f, .hardness = 1.0f},
                                   {},
                                   {point(44.5f, 30.5f)}});
    for (int d = -5; d <= 5; ++d) {
        for (int k = 0; k <= kSegments; ++k) {
            EXPECT_EQ(document.material().logKnot(44 + d, 30, k), original.logKnot(14 + d, 28, k));
        }
    }
    EXPECT_EQ(document.material().logKnot(60, 30, 0), original.logKnot(60, 30, 0));
}

TEST(Clone, TurnsWhatItLaysDown) {
    const MaterialMap original = shifted([](int x, int) { return x == 20 ? 0.5f : 0.0f; });
    Document document(original, std::make_shared<Surface>(makeFlatSurface(kSize, kSize, 64.0f)));
    // A vertical line becomes a horizontal one.
    document.execute(StrokeCommand{Clone{{point(20.5f, 20.5f), point(44.5f, 40.5f), 90.0f}},
                                   {.radiusMm = 8.0f, .hardness = 1.0f},
                                   {},
                                   {point(44.5f, 40.5f)}});
    for (int d = -4; d <= 4; ++d) {
        EXPECT_NEAR(document.material().logKnot(44 + d, 40, 2).x - original.logKnot(44, 40, 2).x,
                    0.5f, 1e-4f);
        if (d != 0) {
            EXPECT_NEAR(document.material().logKnot(44, 40 + d, 2).x, original.logKnot(44, 40, 2).x,
                        1e-4f);
        }
    }
}

TEST(TransferPattern, LaysThePatternOnTheBaseThatIsThere) {
    const MaterialMap original = shifted(wavesLeft);
    Document document(original, std::make_shared<Surface>(makeFlatSurface(kSize, kSize, 64.0f)));
    document.execute(SelectCommand{SelectStroke{{.radiusMm = 7.0f, .hardness = 1.0f},
                                                {},
                                                {point(50.0f, 20.0f), point(50.0f, 44.0f)}},
                                   SelectMode::Replace});
    document.execute(ApplyCommand{
        TransferPattern{{point(16.0f, 32.0f), point(50.0f, 32.0f), 0.0f}, 6.0f, 1.0f}});
    const MaterialMap& after = document.material();
    EXPECT_NEAR(meanOf(after, 46, 54), meanOf(original, 46, 54), 0.05); // the base
    EXPECT_NEAR(deviationOf(after, 46, 54) / deviationOf(original, 12, 20), 1.0, 0.15);
    EXPECT_NEAR(deviationOf(original, 46, 54), 0.0, 1e-6);
}

TEST(Clone, RefusesAPlaceThatIsNotOnTheSurface) {
    Document document(shifted(wavesLeft),
                      std::make_shared<Surface>(makeFlatSurface(kSize, kSize, 64.0f)));
    const std::vector<float> before = document.material().logProfile;
    EXPECT_THROW(
        document.execute(ApplyCommand{Clone{{point(-80.0f, 0.0f), point(10.0f, 10.0f), 0.0f}}}),
        InputError);
    EXPECT_EQ(document.material().logProfile, before);
    EXPECT_FALSE(document.canUndo());
}

} // namespace
} // namespace celadon::subedit
