#pragma once

#include <cstdint>

/// The hot loop of the CPU backend: samples onto a tile of pixels, sixteen pixels at a time. The
/// same meaning as shaders/raster_splat.frag, pair by pair. Compiled once for each instruction set
/// and chosen when the program runs. Plain data only: nothing inline from a library may be
/// instantiated in a file with other instruction sets, or the linker could pick that copy for all.
namespace celadon::gather {

inline constexpr int kTileSide = 8;
inline constexpr int kTilePixels = 64;
inline constexpr int kCodeTail = 32;   ///< codes that may be read past the last profile's end
inline constexpr int kTableSize = 264; ///< most knots of a profile, and what a vector reads past

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
    std::uint32_t profile = 0; ///< first code: [channel][segments + 1]
    Knots knots;
};

/// One sample and the distances at which it counts on this tile.
struct Candidate {
    const Sample* sample;
    const Sample* parent; ///< hierarchical: null where there is none
    float low, high;      ///< hierarchical: R^k, and R^(k+1) or 0; paper: [low, high)
};

/// A tile of one level of the splatting buffer; pixels that are not covered have knots.rangeMm 0.
struct Tile {
    int pixels; ///< a multiple of 16
    alignas(64) float x[kTilePixels], y[kTilePixels], z[kTilePixels];
    alignas(64) float perMm[kTilePixels], rangeMm[kTilePixels], lastSegment[kTilePixels];
    /// Codes of both ends of a segment, the far one in the upper half:
    /// [channel][segment][kTilePixels]. Null where all profiles of the solve are one.
    const std::uint32_t* segments;
    int segmentsPerChannel;
    alignas(64) float sums[3][kTilePixels]; ///< added to
};

struct Solve {
    CodeScale scale;
    const std::uint16_t* codes; ///< of all samples
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
