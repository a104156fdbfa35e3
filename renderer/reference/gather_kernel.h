#pragma once

#include <cstdint>

/// The hot loop of patch_gather, compiled twice: for any processor, and for AVX2 with FMA. Plain
/// data only: nothing inline from a library may be instantiated in a file with other instruction
/// sets, or the linker could pick that copy for everyone.
namespace celadon::gather {

inline constexpr int kPatchBlock = 64; ///< patches a block at most, a multiple of kLanes
inline constexpr int kLanes = 8;

/// The profiles of a block's points, all of one material.
/// Half of log2 P, so that the sum of both ends is the log2 of sqrt(P_i P_o).
struct Profiles {
    const float* logKnots;  ///< [point][segments + 1][4], the fourth unused
    const float* steepness; ///< [point][segments]: max |d(ln P / 2)/dr| from there on, 1/mm
    int segments;
    int pointStride;  ///< in knots: segments + 1, or 0 where all points share one profile
    float knotsPerMm; ///< segments / r_s
};

struct PatchBlock {
    Profiles profiles;
    int count;
    float low[3], high[3]; ///< bounds of the positions, mm
    float largestSpread;   ///< root of the largest trace of a covariance, mm
    alignas(32) float x[kPatchBlock], y[kPatchBlock], z[kPatchBlock];
    alignas(32) float xx[kPatchBlock], xy[kPatchBlock], xz[kPatchBlock];
    alignas(32) float yy[kPatchBlock], yz[kPatchBlock], zz[kPatchBlock];
    alignas(32) float variance[kPatchBlock]; ///< trace of the covariance
    alignas(32) float flux[kPatchBlock][4];
    const float* corners; ///< [count][3][3] of triangular patches, mm; null: others
};

struct ExitBlock {
    Profiles profiles;
    int count;
    const float* positions; ///< [count][3], mm
    double* sums;           ///< [count][3], added to: sum of K times flux
};

/// Adds the block of patches to the exit points.
/// @param reachMm  the smaller of both r_s
/// @return         pairs within reach
using GatherFunction = std::uint64_t (*)(const ExitBlock&, const PatchBlock&, float reachMm,
                                         bool pointSamples);

std::uint64_t gatherPortable(const ExitBlock& exits, const PatchBlock& patches, float reachMm,
                             bool pointSamples);
#ifdef CELADON_GATHER_AVX2
std::uint64_t gatherAvx2(const ExitBlock& exits, const PatchBlock& patches, float reachMm,
                         bool pointSamples);
#endif

} // namespace celadon::gather
