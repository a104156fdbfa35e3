#pragma once

#include "renderer/reference/random.h"
#include "renderer/reference/ray_scene.h"
#include "subedit/medium.h"

#include <glm/vec3.hpp>

#include <functional>

/// One light path in a homogeneous medium that the scattering meshes bound: radiative transfer
/// itself, with exact Fresnel reflectance at the boundary from within. No GL.
namespace celadon {

/// Light that has just been refracted into the medium.
struct LightEntry {
    SurfacePoint point;
    glm::dvec3 direction{0.0}; ///< unit, within the medium
    glm::dvec3 flux{0.0};      ///< transmitted, W per channel
};

/// What became of flux, W per channel. Expectations add up: entered = left + absorbed + lost.
struct FluxBalance {
    glm::dvec3 entered{0.0};
    glm::dvec3 left{0.0};
    glm::dvec3 lost{0.0}; ///< went out through holes of the mesh
    FluxBalance& operator+=(const FluxBalance& other);
};

/// Takes the part of the flux that is transmitted outwards where a path meets the boundary.
using ExitVisitor = std::function<void(const SurfacePoint&, const glm::dvec3& flux)>;

class MediumWalk {
public:
    /// @param rays    referred to; closed meshes, fronts outwards; overlapping ones are one body
    /// @param medium  valid by validateMedium()
    MediumWalk(const RayScene& rays, const subedit::Medium& medium);

    /// Follows a path to its end and visits every place where a part of it leaves; what has left
    /// does not come back (eq. 4 has no such light either). Opaque parts absorb.
    ///
    /// One of the channels, chosen by chance, draws the distances; the others take the same path
    /// by the balance heuristic over all three (Wilkie et al. 2014), which keeps each channel
    /// unbiased whatever the ratio of their coefficients. Absorption is a weight, and so are the
    /// parts that leave and stay; light paths end by Russian roulette.
    /// Where a path crosses the surface is decided by the geometry; Fresnel term and direction are
    /// the shading normal's unless it would send the path to the other side.
    FluxBalance follow(const LightEntry& entry, Random& random, const ExitVisitor& visit) const;

    [[nodiscard]] const subedit::Medium& medium() const { return mMedium; }

private:
    class Path;
    const RayScene& mRays;
    subedit::Medium mMedium;
    glm::dvec3 mScattering; ///< sigma_s, 1/mm
    glm::dvec3 mExtinction; ///< sigma_t, 1/mm
    glm::dvec3 mCenter;
    double mReachMm; ///< beyond it a path has left through a hole
};

/// Direction of a ray refracted into the denser or thinner side, unit; null in total reflection.
/// @param toSource unit, on the normal's side @param eta index beyond the boundary over before it
[[nodiscard]] std::optional<glm::dvec3> refracted(glm::dvec3 toSource, glm::dvec3 normal,
                                                  double eta);

} // namespace celadon
