#include "subedit/exchange/subsurface_parameters.h"

#include "subedit/fit/profile_fit.h"
#include "subedit/fit/stored_curve.h"
#include "subedit/models/half_space.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/radius_map.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace celadon::subedit {

namespace {

/// 1 / sigma_t' from 1 / sigma_t: sigma_t' = sigma_t (1 - g alpha), alpha of single scattering. The
/// surface albedo gives alpha', and alpha' = alpha (1 - g) / (1 - g alpha).
double reducedLength(double lengthMm, double albedo, double g, double eta) {
    if (g == 0.0) {
        return lengthMm;
    }
    const double reduced = reducedAlbedoFromTotal(albedo, eta);
    const double alpha = reduced / (1.0 - g + g * reduced);
    return lengthMm / (1.0 - g * alpha);
}

} // namespace

MaterialMap materialFromParameters(const SubsurfaceParameters& p, int segments) {
    glm::dvec3 length;
    for (int c = 0; c < 3; ++c) {
        length[c] = reducedLength(p.meanFreePathMm[c], p.albedo[c], p.anisotropy, p.eta);
    }
    const FittedProfile fitted =
        fitProfile(normalizedDiffusionProfile(p.albedo, length), {segments});
    MaterialMap map;
    map.width = map.height = 1;
    map.segments = fitted.segments;
    map.maxRadiusMm = fitted.maxRadiusMm;
    map.eta = static_cast<float>(p.eta);
    map.logProfile = fitted.logProfile;
    map.roughness = {static_cast<float>(p.roughness)};
    return map;
}

double meanFreePathFromEffectiveRadius(double albedo, double effectiveRadiusMm) {
    static const double unitRadius = normalizedDiffusionRadius(0.95);
    return effectiveRadiusMm / unitRadius *
           normalizedDiffusionScale(albedo, DiffusionFit::Searchlight);
}

NearestParameters nearestParameters(const MaterialMap& map) {
    NearestParameters nearest;
    SubsurfaceParameters& p = nearest.parameters;
    p.albedo = glm::dvec3(0.0);
    p.eta = static_cast<double>(map.eta);
    glm::dvec3 radius(0.0);
    glm::dvec3 least(std::numeric_limits<double>::infinity());
    glm::dvec3 most(0.0);
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const ProfileView profile = profileAt(map, x, y);
            const glm::dvec3 albedo = diffuseAlbedo(profile);
            const glm::dvec3 here = effectiveRadiusMm(profile);
            p.albedo += albedo;
            radius += here;
            least = glm::min(least, albedo);
            most = glm::max(most, albedo);
            const double longest = std::max({here.x, here.y, here.z});
            smallest = std::min(smallest, longest);
            largest = std::max(largest, longest);
        }
    }
    const double texels = static_cast<double>(map.width) * map.height;
    p.albedo = glm::clamp(p.albedo / texels, 0.0, 1.0);
    radius /= texels;
    for (int c = 0; c < 3; ++c) {
        // A black channel has no radius: any does.
        const double r = radius[c] > 0.0 ? radius[c] : std::max(largest, 1e-3);
        p.meanFreePathMm[c] = meanFreePathFromEffectiveRadius(p.albedo[c], r);
    }
    const glm::dvec3 spread = most - least;
    nearest.albedoSpread = std::max({spread.x, spread.y, spread.z});
    nearest.radiusSpread = smallest > 0.0 ? largest / smallest : 1.0;
    nearest.varies = nearest.albedoSpread > 0.01 || nearest.radiusSpread > 1.02;
    if (!map.roughness.empty()) {
        double sum = 0.0;
        for (const float value : map.roughness) {
            sum += static_cast<double>(value);
        }
        p.roughness = sum / texels;
    }
    // Of the middle texel, measured as energies within a radius.
    const RadialCurves stored = storedCurves(map, map.width / 2, map.height / 2);
    const RadialCurves model = normalizedDiffusionProfile(p.albedo, p.meanFreePathMm);
    for (std::size_t c = 0; c < 3; ++c) {
        if (stored[c].total < 1e-6 || model[c].total < 1e-6) {
            continue;
        }
        for (int i = 1; i < 64; ++i) {
            const double r = static_cast<double>(map.maxRadiusMm) * i * i / 4096.0;
            if (r * map.segments < static_cast<double>(map.maxRadiusMm)) {
                continue; // within the first segment energies are kept, radii are not
            }
            nearest.shapeError =
                std::max(nearest.shapeError, std::abs(stored[c].energyWithin(r) / stored[c].total -
                                                      model[c].energyWithin(r) / model[c].total));
        }
    }
    return nearest;
}

glm::dvec3 absorptionOf(const SubsurfaceParameters& p) {
    glm::dvec3 absorption;
    for (int c = 0; c < 3; ++c) {
        absorption[c] = (1.0 - reducedAlbedoFromTotal(p.albedo[c], p.eta)) / p.meanFreePathMm[c];
    }
    return absorption;
}

} // namespace celadon::subedit
