#include "ui/model_profile.h"

#include "subedit/edit/profile_editor.h"
#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/better_dipole.h"
#include "subedit/models/dipole.h"
#include "subedit/models/half_space.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/models/photon_beam.h"
#include "subedit/models/quantized_diffusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace celadon::ui {

using namespace subedit;

namespace {

constexpr std::array<ModelName, 5> kModels{{
    {"normalized-diffusion", "Normalized diffusion",
     "Christensen, Burley 2015: a sum of two exponentials, fitted to random walks"},
    {"photon-beam", "Photon beam diffusion",
     "Habel et al. 2013: closest to a random walk, with single scattering"},
    {"quantized", "Quantized diffusion", "d'Eon, Irving 2011: sharp near the entry"},
    {"better-dipole", "Better dipole", "d'Eon 2012: right at high absorption"},
    {"dipole", "Dipole", "Jensen et al. 2001: the classic, soft near the entry"},
}};

RadialCurves curvesOf(std::string_view model, const Medium& medium) {
    if (model == "dipole") {
        return dipoleProfile(medium);
    }
    if (model == "better-dipole") {
        return betterDipoleProfile(medium);
    }
    if (model == "quantized") {
        return quantizedDiffusionProfile(medium);
    }
    if (model == "photon-beam") {
        return photonBeamProfile(medium);
    }
    if (model == "normalized-diffusion") {
        return normalizedDiffusionProfile(medium);
    }
    throw UsageError(fmt::format("model '{}'", model), "there is no such model",
                     "choose dipole, better-dipole, quantized, photon-beam or "
                     "normalized-diffusion");
}

} // namespace

std::span<const ModelName> profileModels() {
    return kModels;
}

StoredProfile modelProfile(std::string_view model, const glm::dvec3& albedo,
                           const glm::dvec3& radiusMm, double eta) {
    constexpr double kLeast = 1e-3;
    constexpr int kSegments = 32;
    glm::dvec3 reduced;
    for (int c = 0; c < 3; ++c) {
        reduced[c] =
            std::max(reducedAlbedoFromTotal(std::clamp(albedo[c], kLeast, 0.999), eta), kLeast);
    }
    // A profile is as wide as its mean free path: once to learn how wide, once as wide as wanted.
    glm::dvec3 length(1.0);
    const RadialCurves unit = curvesOf(model, mediumFromAlbedo(reduced, length, eta));
    for (int c = 0; c < 3; ++c) {
        const double radius = radiusHolding(unit[static_cast<std::size_t>(c)], 0.95);
        length[c] = std::max(radiusMm[c], 1e-3) / std::max(radius, 1e-6);
    }
    const FittedProfile fitted =
        fitProfile(curvesOf(model, mediumFromAlbedo(reduced, length, eta)), {kSegments});
    ProfileEditor editor({fitted.segments, fitted.maxRadiusMm});
    editor.load(fitted.logProfile.data());
    for (int c = 0; c < 3; ++c) {
        editor.setAlbedo(c, std::clamp(static_cast<float>(albedo[c]), 0.0f, kLargestAlbedo));
    }
    const std::size_t values = fitted.logProfile.size();
    return {fitted.segments, fitted.maxRadiusMm,
            std::vector<float>(editor.result(), editor.result() + values)};
}

} // namespace celadon::ui
