#pragma once

#include "renderer/reference/medium_walk.h"
#include "renderer/reference/random.h"
#include "renderer/reference/ray_scene.h"

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <vector>

/// Where light enters a medium: rays from the lights, chosen so that each carries about the same
/// flux, refracted where they first meet a surface. No light view, no samples of the surface. No
/// GL.
namespace celadon {

class LightSource {
public:
    /// @param rays, lights  referred to; positions in mm
    /// @param eta           of the medium
    LightSource(const RayScene& rays, std::span<const Light> lights, double eta);

    /// Light that one ray brings; the mean over many is the flux that all lights send in.
    /// Nothing where the ray meets nothing, an opaque part or a surface that takes no light
    /// (DESIGN section 1: it must face the light by geometry and by its shading normal).
    /// @param choice  in [0, 1), of the light @param place in [0, 1)^2, of the ray
    [[nodiscard]] std::optional<LightEntry> sample(double choice, glm::dvec2 place) const;

private:
    /// Rays of one light: a parallel beam, or a cone from a point.
    struct Beam {
        const Light* light;
        glm::dvec3 axis;      ///< unit, along the light
        glm::dvec3 tangent;   ///< unit, across
        glm::dvec3 bitangent; ///< unit, across both
        double cosCone;       ///< least cosine with the axis (point, spot)
        double measure;       ///< m^2 across the beam, or sr
        double probability;
    };
    const RayScene& mRays;
    double mEta;
    std::vector<Beam> mBeams;

    [[nodiscard]] Beam makeBeam(const Light& light) const;
};

} // namespace celadon
