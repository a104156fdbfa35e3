#pragma once

#include "renderer/reference/medium_walk.h"
#include "renderer/reference/path_traced_settings.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/world.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

/// Radiative transfer in the body itself (DESIGN section 4): no profile, no half-space, no
/// diffusion. It judges the profile model and the form sqrt(P P) of eq. 8, not the splatting. No
/// GL.
///
/// What is estimated: B of a pixel, the flux that leaves the surface which the pixel shows, over
/// its area, of light that entered by refraction from the lights and has not left before. Light
/// reflected off the outside, and light that has left and meets the body again, are no part of it,
/// as in eq. 4.
///
/// How: paths start at the lights. Directional, point and spot lights meet a refracting boundary
/// in a single direction, which no path from the viewed side can hit by chance, so a path that
/// starts there would miss all light; from the lights, every path is possible, those reflected
/// within the boundary included. Wherever a path meets the boundary from within, the part that is
/// transmitted is counted in the pixel that sees the place, and the rest goes on: the step to the
/// view is exact at each event, with no chance in it. The estimate is unbiased for the mean over
/// the pixel; the references by eq. 4 take the pixel's center.
namespace celadon {

struct PathTracedResult {
    std::vector<glm::vec3> exitance;      ///< W/m^2, [y][x] from the bottom row
    std::vector<glm::vec3> standardError; ///< from the spread of independent batches
    double relativeError = 0.0;           ///< root mean square of it over that of the exitance
    std::uint64_t paths = 0;
    FluxBalance flux; ///< over all of the body, seen or not; with its own noise
};

class PathTraced {
public:
    /// @param world  referred to, must outlive this object; its materials play no part
    /// @throws Error when Embree cannot start or runs out of memory
    PathTraced(const World& world, const PathTracedSettings& settings);
    PathTraced(const PathTraced&) = delete; // the walk refers to the rays
    PathTraced& operator=(const PathTraced&) = delete;

    /// The same seed gives the same bits whatever the number of threads.
    /// @param cancel  set by another thread to stop early, with what there is by then; may be null
    [[nodiscard]] PathTracedResult solve(const CameraView& camera, glm::ivec2 size,
                                         std::span<const Light> lights,
                                         const std::atomic<bool>* cancel = nullptr) const;

private:
    PathTracedSettings mSettings;
    RayScene mRays;
    MediumWalk mWalk;
};

} // namespace celadon
