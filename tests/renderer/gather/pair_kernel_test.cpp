// The pair loop has one text and several instruction sets; each is the formula.
#include "renderer/gather/pair_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace celadon::gather {
namespace {

struct Kernel {
    const char* name;
    PairFunction function;
    bool runs;
};

std::vector<Kernel> kernels() {
    std::vector<Kernel> all{{"portable", addPairsPortable, true}};
#ifdef CELADON_GATHER_X86
    all.push_back(
        {"avx2", addPairsAvx2, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")});
    all.push_back({"avx512", addPairsAvx512,
                   __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                       __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")});
#endif
    return all;
}

/// Exponential profiles of a few lengths, coded.
struct CodedProfiles {
    Knots knots;
    CodeScale scale;
    std::vector<std::uint16_t> codes;

    explicit CodedProfiles(int segments) {
        knots = {static_cast<float>(segments) / 20.0f, segments, 20.0f};
        scale.offset = -30.0f;
        scale.step = 34.0f / 65535.0f;
        scale.exponentOffset = 1.44269504f * scale.offset;
        scale.exponentStep = 0.72134752f * scale.step;
        for (int p = 0; p < 4; ++p) {
            for (int k = 0; k <= segments; ++k) {
                for (int c = 0; c < kKnotCodes; ++c) {
                    const double r = k / static_cast<double>(knots.perMm);
                    const double logP = 1.0 - 0.2 * p - r / (2.0 + p + c);
                    codes.push_back(static_cast<std::uint16_t>(
                        std::lround((logP + 30.0) / static_cast<double>(scale.step))));
                }
            }
        }
        codes.resize(codes.size() + kCodesBehind);
    }
    [[nodiscard]] int stride() const { return kKnotCodes * (knots.segments + 1); }
    [[nodiscard]] std::uint32_t start(int p) const {
        return static_cast<std::uint32_t>(p * stride());
    }
    [[nodiscard]] double logP(int p, int c, double r) const {
        const double position = r * static_cast<double>(knots.perMm);
        const int k = std::min(static_cast<int>(position), knots.segments - 1);
        const std::size_t i = start(p) + static_cast<std::size_t>(k * kKnotCodes + c);
        const double code = codes[i] + (position - k) * (codes[i + kKnotCodes] - codes[i]);
        return -30.0 + static_cast<double>(scale.step) * code;
    }
};

struct TileCase {
    Tile tile{};
    std::vector<std::uint16_t> pixelCodes;
    std::vector<Sample> samples;
    std::vector<Candidate> candidates;
};

TileCase makeSetup(const CodedProfiles& profiles, bool shared, float spread, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    TileCase setup;
    const int n = profiles.knots.segments;
    for (int i = 0; i < kTilePixels; ++i) {
        setup.tile.x[i] = 2.0f * unit(random);
        setup.tile.y[i] = 2.0f * unit(random);
        setup.tile.z[i] = unit(random);
        setup.tile.perMm[i] = profiles.knots.perMm;
        setup.tile.rangeMm[i] = i % 7 == 3 ? 0.0f : profiles.knots.rangeMm; // some not covered
        setup.tile.lastSegment[i] = static_cast<float>(n - 1);
    }
    setup.tile.profileStride = profiles.stride();
    for (int i = 0; i < kTilePixels && !shared; ++i) {
        const auto* first = profiles.codes.data() + profiles.start(i % 4);
        setup.pixelCodes.insert(setup.pixelCodes.end(), first, first + profiles.stride());
    }
    setup.pixelCodes.resize(setup.pixelCodes.size() + kCodesBehind);
    setup.tile.profiles = shared ? nullptr : setup.pixelCodes.data();
    for (int i = 0; i < 40; ++i) {
        Sample sample;
        for (float& p : sample.position) {
            p = 20.0f * unit(random) - 8.0f;
        }
        for (float& d : sample.diagonal) {
            d = spread * unit(random);
            sample.variance += d;
        }
        for (float& f : sample.flux) {
            f = 0.5f + unit(random);
        }
        sample.profile = shared ? 0 : profiles.start(i % 4);
        sample.steepness = 1.0f / (2.0f + static_cast<float>(shared ? 0 : i % 4));
        sample.knots = profiles.knots;
        sample.ball = i % 3 == 0 ? 0.0f : 2.0f * unit(random);
        setup.samples.push_back(sample);
    }
    return setup;
}

constexpr float kFade = 0.6f;

Candidate candidateOf(const Sample& sample, const Sample* parent, float low, float high,
                      bool hierarchical) {
    Candidate candidate{};
    candidate.sample = &sample;
    std::copy_n(sample.position, 3, candidate.position);
    candidate.low = low;
    candidate.high = high;
    candidate.least = hierarchical ? std::max(sample.ball, kRingLow * low) : low;
    const float end = hierarchical ? kRingHigh * high : high;
    candidate.most = end > 0.0f ? std::min(end, sample.knots.rangeMm) : sample.knots.rangeMm;
    if (parent != nullptr) {
        std::copy_n(parent->position, 3, candidate.parent);
        candidate.parentReach = (1.0f + kFade) * parent->ball;
    }
    return candidate;
}

/// Points may lie on either side of a hard border: the lists say which rings are used.
void useRings(TileCase& setup, bool hierarchical) {
    setup.candidates.clear();
    for (std::size_t i = 0; i + 1 < setup.samples.size(); ++i) {
        setup.candidates.push_back(candidateOf(
            setup.samples[i], hierarchical && i % 2 == 0 ? &setup.samples[i + 1] : nullptr,
            i % 4 == 0 ? 0.0f : 2.0f, i % 5 == 0 && hierarchical ? 0.0f : 15.0f, hierarchical));
    }
}

class PairKernel : public testing::TestWithParam<int> {};

TEST_P(PairKernel, InstructionSetsAgree) {
    const CodedProfiles profiles(GetParam());
    for (const Profiles kind : {Profiles::One, Profiles::SameKnots, Profiles::Any}) {
        const bool shared = kind == Profiles::One;
        for (const bool hierarchical : {false, true}) {
            for (const float spread : {0.0f, 0.5f, 30.0f}) { // narrow, three distances, wide
                TileCase setup = makeSetup(profiles, shared, spread, 7);
                useRings(setup, hierarchical);
                const Solve solve{profiles.scale, profiles.codes.data(), kind, hierarchical, kFade};
                Tile expected = setup.tile;
                const std::uint64_t pairs =
                    addPairsPortable(expected, setup.candidates.data(),
                                     static_cast<int>(setup.candidates.size()), solve);
                EXPECT_GT(pairs, 500u);
                for (const Kernel& kernel : kernels()) {
                    if (!kernel.runs) {
                        continue;
                    }
                    Tile tile = setup.tile;
                    const std::uint64_t got =
                        kernel.function(tile, setup.candidates.data(),
                                        static_cast<int>(setup.candidates.size()), solve);
                    EXPECT_NEAR(static_cast<double>(got), static_cast<double>(pairs), 2.0);
                    for (int c = 0; c < 3; ++c) {
                        for (int i = 0; i < kTilePixels; ++i) {
                            EXPECT_NEAR(tile.sums[i][c], expected.sums[i][c],
                                        1e-4f * expected.sums[i][c])
                                << kernel.name << " pixel " << i;
                        }
                    }
                }
            }
        }
    }
}

// Points without spread and without rings: eq. 12 of the paper, pair by pair, in double precision.
TEST_P(PairKernel, IsTheSumOverPoints) {
    const CodedProfiles profiles(GetParam());
    TileCase setup = makeSetup(profiles, false, 0.0f, 3);
    useRings(setup, false);
    const Solve same{profiles.scale, profiles.codes.data(), Profiles::SameKnots, false, kFade};
    const Solve any{profiles.scale, profiles.codes.data(), Profiles::Any, false, kFade};
    for (const Solve& solve : {same, any})
        for (const Kernel& kernel : kernels()) {
            if (!kernel.runs) {
                continue;
            }
            // Two 16-bit codes are added up rounded to half a step.
            const double rounding = solve.profiles == Profiles::Any
                                        ? 2e-5
                                        : 0.5 * static_cast<double>(profiles.scale.step);
            Tile tile = setup.tile;
            kernel.function(tile, setup.candidates.data(),
                            static_cast<int>(setup.candidates.size()), solve);
            for (int i = 0; i < kTilePixels; ++i) {
                for (int c = 0; c < 3; ++c) {
                    double sum = 0.0;
                    for (std::size_t j = 0; j < setup.candidates.size(); ++j) {
                        const Sample& sample = *setup.candidates[j].sample;
                        const double r =
                            std::hypot(static_cast<double>(tile.x[i] - sample.position[0]),
                                       static_cast<double>(tile.y[i] - sample.position[1]),
                                       static_cast<double>(tile.z[i] - sample.position[2]));
                        if (tile.rangeMm[i] > 0.0f &&
                            r >= static_cast<double>(setup.candidates[j].low) &&
                            r < static_cast<double>(setup.candidates[j].high)) {
                            sum += static_cast<double>(sample.flux[c]) *
                                   std::exp(0.5 * (profiles.logP(static_cast<int>(j % 4), c, r) +
                                                   profiles.logP(i % 4, c, r)));
                        }
                    }
                    EXPECT_NEAR(static_cast<double>(tile.sums[i][c]), sum, rounding * sum + 1e-9)
                        << kernel.name;
                }
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Segments, PairKernel, testing::Values(1, 24, 32, 100, 256));

} // namespace
} // namespace celadon::gather
