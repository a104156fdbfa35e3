#pragma once

#include <cstdint>

/// The hot loop of the CPU backend: samples onto a tile of pixels. The same meaning as
/// shaders/raster_splat.frag, pair by pair. Compiled once for each instruction set and chosen when
/// the program runs. Plain data only: nothing inline from a library may be instantiated in a file
/// with other instruction sets, or the linker could pick that copy for all.
namespace celadon::gather {

inline constexpr int kTilePixels = 64;
/// A ring fades in and out about its radius between these, in units of it.
inline constexpr float kRingLow = 0.8f;
inline constexpr float kRingHigh = 1.2f;
inline constexpr int kKnotCodes = 4; ///< codes of a knot: R, G, B, one unused
inline constexpr int kRunKnots = 4;  ///< neighboring knots that are read at once
/// Runs begin within a profile and may end behind it; what stands there is read and not used.
inline constexpr int kCodesBehind = kRunKnots * kKnotCodes;

/// Profiles as 16-bit codes: ln P = offset + step * code, so that
/// log2 sqrt(P_i P_o) = exponentOffset + exponentStep * (code_i + code_o).
struct CodeScale {
    float offset = 0.0f, step = 0.0f;
    float exponentOffset = 0.0f, exponentStep = 0.0f;
};

/// Where a profile's knots lie.
struct Knots {
    float perMm = 0.0f; ///< segments / r_s
    int segments = 0;
    float rangeMm = 0.0f; ///< r_s
};

/// What stands for a piece of lit surface: its mean position, its spread, and what it brings.
struct Sample {
    float position[3] = {};    ///< mm
    float variance = 0.0f;     ///< trace of the covariance, mm^2
    float diagonal[3] = {};    ///< covariance: xx, yy, zz
    float offDiagonal[3] = {}; ///< xy, xz, yz
    float flux[3] = {};        ///< 1e-6 W; what lies beyond R_cut given back
    float steepness = 0.0f;    ///< of -ln P over the first segment, steepest channel, 1/mm
    float ball = 0.0f;         ///< hierarchical: mm
    std::uint32_t profile = 0; ///< first code: [segments + 1][kKnotCodes]
    Knots knots;
};

/// One sample and the distances at which it counts, mm: all that is asked before it does.
struct Candidate {
    const Sample* sample;
    float position[3]; ///< the sample's
    float least, most; ///< it counts from here, where its ball and its ring begin, to there
    float parent[3];   ///< hierarchical: its parent's position,
    float parentReach; ///<   and within which distance of that it counts; 0: there is none
    float low, high;   ///< hierarchical: R^k, and R^(k+1) or 0
};

/// A tile of one level of the splatting buffer; pixels that are not covered have rangeMm 0.
struct Tile {
    alignas(64) float x[kTilePixels], y[kTilePixels], z[kTilePixels];
    alignas(64) float perMm[kTilePixels], rangeMm[kTilePixels], lastSegment[kTilePixels];
    /// Codes of the pixels' profiles: [kTilePixels][profileStride], and kCodesBehind more. Null
    /// where all profiles are one.
    const std::uint16_t* profiles;
    int profileStride;
    alignas(64) float sums[kTilePixels][4]; ///< added to
};

/// How much the profiles of a solve have in common.
enum class Profiles : std::uint8_t {
    One,       ///< all are the one at code 0
    SameKnots, ///< as many segments and the same r_s
    Any
};

struct Solve {
    CodeScale scale;
    const std::uint16_t* codes; ///< of all samples, and kCodesBehind more
    Profiles profiles;
    bool hierarchical;
    float fade; ///< b
};

/// Adds candidates to the tile. @return pairs that counted
using PairFunction = std::uint64_t (*)(Tile& tile, const Candidate* candidates, int count,
                                       const Solve& solve);

/// The fastest one that this processor runs.
[[nodiscard]] PairFunction choosePairFunction();

std::uint64_t addPairsPortable(Tile&, const Candidate*, int, const Solve&);
#ifdef CELADON_GATHER_X86
std::uint64_t addPairsAvx2(Tile&, const Candidate*, int, const Solve&);
std::uint64_t addPairsAvx512(Tile&, const Candidate*, int, const Solve&);
#endif

} // namespace celadon::gather
