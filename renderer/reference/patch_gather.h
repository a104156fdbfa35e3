#pragma once

#include "renderer/reference/patch.h"
#include "renderer/scene/world.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Eq. 5 of Chen et al. 2012 by brute force: every lit patch onto every exit point, in full
/// precision, with no truncation before r_s. The truth that the solvers are measured against
/// (DESIGN section 4); image-reference and surface-reference differ only in where the patches come
/// from. No GL, no hierarchy.
namespace celadon {

struct GatherOptions {
    /// Kernel at the distance of the mean positions, as in the paper. Otherwise its mean over the
    /// patch's footprint: a disc with the patch's covariance, seen in the direction of the pair.
    bool pointSamples = false;

    /// One per patch, or none: patches that are triangles are then integrated as such by exit
    /// points so near that their shape matters, as the covariance alone cannot.
    std::span<const PatchTriangle> triangles = {};

    /// The plain instruction set even where AVX2 and FMA are present; for tests.
    bool forcePortable = false;

    /// Called from worker threads, one call at a time, with the part done in [0, 1], rising.
    std::function<void(double)> progress = nullptr;

    /// Set by another thread to stop early.
    const std::atomic<bool>* cancel = nullptr;
};

struct GatherResult {
    std::vector<glm::vec3> exitance; ///< B in W/m^2, one per exit point; meaningless if cancelled
    std::uint64_t pairs = 0;         ///< (patch, exit point) pairs within reach of both profiles
    bool cancelled = false;
};

/// B(x_o) = sum over patches of sqrt(P_i(d) P_o(d)) flux_i (eqs. 5 and 8), where ln P is bilinear
/// at each end's texture coordinate and P = 0 beyond either profile's r_s.
/// Patches without flux cost nothing. The result depends neither on the number of threads nor on
/// which other exit points are asked for.
/// @param materials  as in World; each that is used not null
[[nodiscard]] GatherResult gatherExitance(std::span<const ExitPoint> exitPoints,
                                          std::span<const Patch> patches,
                                          std::span<const MaterialPointer> materials,
                                          const GatherOptions& options = {});

} // namespace celadon
