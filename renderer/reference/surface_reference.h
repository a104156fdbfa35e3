#pragma once

#include "renderer/reference/patch_gather.h"
#include "renderer/reference/ray_scene.h"
#include "renderer/scene/world.h"

#include <cstdint>
#include <span>
#include <vector>

/// Eq. 4 of Chen et al. 2012 over the surface itself (DESIGN section 4): the surface is cut into
/// small patches of about equal area, each traced towards the lights. No light view at all, so it
/// tells what a light view costs. No GL.
namespace celadon {

struct SurfaceReferenceOptions {
    int samples = 1 << 20; ///< patches of both halves together, see samplePatches
    std::uint64_t seed = 1;
    GatherOptions gather{};
};

struct SurfaceReferenceResult {
    std::vector<glm::vec3> exitance;      ///< W/m^2: the mean of two independent halves
    std::vector<glm::vec3> standardError; ///< half of the difference of the halves, per point
    double relativeError = 0.0;           ///< root mean square of it over that of the exitance
    glm::dvec3 litFlux{0.0};              ///< that enters the surface, seen or not; W
    std::uint64_t pairs = 0;
    bool cancelled = false;
};

/// For gatherExitance: patches, and GatherOptions::triangles.
struct SurfacePatches {
    std::vector<Patch> patches;
    std::vector<PatchTriangle> triangles;
};

class SurfaceReference {
public:
    /// @param world  referred to, must outlive this object
    /// @throws Error when Embree cannot start or runs out of memory
    explicit SurfaceReference(const World& world) : mRays(world) {}

    /// Lit patches. Every triangle is cut at random into cells of equal area, each a patch with the
    /// cell's mean position and covariance; a place within the cell, chosen at random, decides its
    /// flux. Another seed gives other cells.
    /// @param count  patches over the whole scattering surface, lit or not, >= 1; about, and at
    /// least
    ///               one a triangle. Those that are lit come back.
    [[nodiscard]] SurfacePatches samplePatches(std::span<const Light> lights, int count,
                                               std::uint64_t seed) const;

    /// Exitance from two independent sets of half of the samples each. Their difference estimates
    /// the error that chance makes (shadow borders, cells); what both halves share is of second
    /// order in the patches' size and shows when the samples are doubled.
    [[nodiscard]] SurfaceReferenceResult solve(std::span<const ExitPoint> exitPoints,
                                               std::span<const Light> lights,
                                               const SurfaceReferenceOptions& options = {}) const;

    [[nodiscard]] const RayScene& rays() const { return mRays; }

private:
    RayScene mRays;
};

} // namespace celadon
