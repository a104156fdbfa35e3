#pragma once

#include "subedit/map/material_map.h"

#include <glm/vec3.hpp>

/// Between SubEdit materials and the few numbers that other renderers have for subsurface
/// scattering.
namespace celadon::subedit {

/// What the models of other renderers share. Both OpenPBR (subsurface_color, subsurface_radius
/// times subsurface_radius_scale) and a Principled shader (base color, Subsurface Radius times
/// Subsurface Scale) are read so: the color is the surface albedo after all orders of scattering,
/// the radius the mean free path 1 / sigma_t per channel.
struct SubsurfaceParameters {
    glm::dvec3 albedo{0.8};         ///< linear, in [0, 1]
    glm::dvec3 meanFreePathMm{1.0}; ///< 1 / sigma_t, > 0
    double anisotropy = 0.0;        ///< g; turned into reduced coefficients by similarity
    double eta = 1.4;
    double roughness = 0.3;
};

/// One texel: normalized diffusion (searchlight) with this albedo and 1 / sigma_t'.
[[nodiscard]] MaterialMap materialFromParameters(const SubsurfaceParameters& parameters,
                                                 int segments = 32);

/// What a material keeps as a few numbers.
struct NearestParameters {
    SubsurfaceParameters parameters; ///< means over the map; g = 0
    bool varies = false;             ///< over the map
    double albedoSpread = 0.0;       ///< largest minus smallest over the map, any channel
    double radiusSpread = 0.0;       ///< largest over smallest R_P
    double shapeError = 0.0;         ///< largest part of a channel's energy that lies elsewhere
};

/// Albedo is the mean over the texels, lengths those whose normalized diffusion has the texels'
/// mean effective radius (95 %), channel by channel.
[[nodiscard]] NearestParameters nearestParameters(const MaterialMap& map);

/// Mean free path 1/sigma_t' whose normalized diffusion (searchlight) has this effective radius;
/// the inverse of effectiveRadiusFromMeanFreePath().
[[nodiscard]] double meanFreePathFromEffectiveRadius(double albedo, double effectiveRadiusMm);

/// sigma_a of a medium with this surface albedo and 1/sigma_t', 1/mm, by albedo inversion.
[[nodiscard]] glm::dvec3 absorptionOf(const SubsurfaceParameters& parameters);

} // namespace celadon::subedit
