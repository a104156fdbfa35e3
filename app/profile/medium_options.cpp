#include "app/profile/medium_options.h"

#include "app/option_takers.h"
#include "app/rgb_argument.h"
#include "subedit/errors.h"
#include "subedit/models/half_space.h"
#include "subedit/presets.h"

#include <fmt/format.h>
#include <glm/common.hpp>

namespace celadon::app {

using namespace subedit;

namespace {

constexpr double kLargestCoefficient = 1e6; ///< 1/mm
constexpr double kLargestLengthMm = 1e6;
constexpr double kSmallestAlbedo = 1e-9;

void requireBoth(const std::string& command, const std::string& first, const char* firstName,
                 const std::string& second, const char* secondName) {
    if (first.empty() != second.empty()) {
        throw UsageError(command,
                         fmt::format("{} is missing", first.empty() ? firstName : secondName));
    }
}

} // namespace

void addMediumOptions(CLI::App& app, MediumOptions& o) {
    const char* group = "Medium";
    addOption(app, "--preset",
              {group, "NAME", "A measured medium: marble, skin1, wholemilk, ... (profile list)"},
              takeText(o.preset));
    addOption(app, "--absorption", {group, "R,G,B", "sigma_a in 1/mm"}, takeText(o.absorption));
    addOption(app, "--reduced-scattering", {group, "R,G,B", "sigma_s' in 1/mm"},
              takeText(o.reducedScattering));
    addOption(app, "--scattering",
              {group, "R,G,B", "sigma_s in 1/mm, with --g, instead: sigma_s' = sigma_s (1 - g)"},
              takeText(o.scattering));
    addOption(
        app, "--albedo",
        {group, "R,G,B",
         "alpha', of a single scattering; of --model normalized-diffusion the surface's, which "
         "--surface-albedo is for all"},
        takeText(o.albedo));
    addOption(app, "--surface-albedo",
              {group, "R,G,B",
               "Surface albedo for every model: alpha' is found with which the model returns as "
               "much light"},
              takeText(o.surfaceAlbedo));
    addOption(app, "--mean-free-path", {group, "R,G,B", "1/sigma_t' in mm"},
              takeText(o.meanFreePath));
    addOption(app, "--eta",
              {group, "N",
               fmt::format("Relative index of refraction, 0.5 to 4; default: the preset's, else {}",
                           kDefaultEta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
    addOption(
        app, "--g",
        {group, "G",
         "Mean cosine of scattering (Henyey-Greenstein), -0.999 to 0.999; monte-carlo follows it, "
         "the others know sigma_s' only; default 0"},
        takeNumber(o.anisotropy, {-0.999, 0.999, false}));
}

MediumSource mediumSource(const MediumOptions& o, const std::string& command) {
    const bool hasPreset = !o.preset.empty();
    const bool hasCoefficients =
        !o.absorption.empty() || !o.reducedScattering.empty() || !o.scattering.empty();
    const bool hasAlbedo = !o.albedo.empty();
    const bool hasSurfaceAlbedo = !o.surfaceAlbedo.empty();
    const bool hasLength = !o.meanFreePath.empty();
    const int ways = hasPreset + hasCoefficients + hasAlbedo + hasSurfaceAlbedo;
    if (ways != 1) {
        if (ways == 0 && hasLength) {
            throw UsageError(command, "--albedo is missing");
        }
        throw UsageError(
            command, ways > 1 ? "the medium is given in more than one way" : "no medium is given",
            "use one of --preset, --absorption with --reduced-scattering, or "
            "--albedo with --mean-free-path");
    }
    if (hasLength && (hasPreset || hasCoefficients)) {
        throw UsageError(command, "the medium is given in more than one way",
                         "--mean-free-path goes with --albedo");
    }
    if (hasCoefficients) {
        if (!o.reducedScattering.empty() && !o.scattering.empty()) {
            throw UsageError(command, "--scattering and --reduced-scattering are both given",
                             "give sigma_s with --g, or sigma_s'");
        }
        const std::string& scattering = o.scattering.empty() ? o.reducedScattering : o.scattering;
        requireBoth(command, o.absorption, "--absorption", scattering, "--reduced-scattering");
        return MediumSource::Coefficients;
    }
    if (hasPreset) {
        return MediumSource::Preset;
    }
    requireBoth(command, o.albedo + o.surfaceAlbedo, "--albedo", o.meanFreePath,
                "--mean-free-path");
    return hasAlbedo ? MediumSource::Albedo : MediumSource::SurfaceAlbedo;
}

Medium makeMedium(const MediumOptions& o, MediumSource source) {
    Medium medium;
    const double eta = o.eta.value_or(kDefaultEta);
    switch (source) {
    case MediumSource::Preset:
        medium = findMediumPreset(o.preset);
        medium.eta = o.eta.value_or(medium.eta);
        break;
    case MediumSource::Coefficients: {
        medium.absorption = requireRgb("--absorption", o.absorption, 0.0, kLargestCoefficient);
        medium.reducedScattering =
            o.scattering.empty()
                ? requireRgb("--reduced-scattering", o.reducedScattering, 1e-9, kLargestCoefficient)
                : requireRgb("--scattering", o.scattering, 1e-9, kLargestCoefficient) *
                      (1.0 - o.anisotropy);
        medium.eta = eta;
        break;
    }
    case MediumSource::Albedo:
        medium = mediumFromAlbedo(
            glm::max(requireRgb("--albedo", o.albedo, 0.0, 1.0), glm::dvec3(kSmallestAlbedo)),
            givenMeanFreePath(o), eta);
        break;
    case MediumSource::SurfaceAlbedo: {
        glm::dvec3 albedo = givenAlbedo(o);
        for (int channel = 0; channel < 3; ++channel) {
            albedo[channel] =
                std::max(reducedAlbedoFromTotal(albedo[channel], eta), kSmallestAlbedo);
        }
        medium = mediumFromAlbedo(albedo, givenMeanFreePath(o), eta);
        break;
    }
    }
    medium.anisotropy = o.anisotropy;
    validateMedium(medium);
    return medium;
}

glm::dvec3 givenAlbedo(const MediumOptions& o) {
    return o.surfaceAlbedo.empty() ? requireRgb("--albedo", o.albedo, 0.0, 1.0)
                                   : requireRgb("--surface-albedo", o.surfaceAlbedo, 0.0, 1.0);
}

glm::dvec3 givenMeanFreePath(const MediumOptions& o) {
    return requireRgb("--mean-free-path", o.meanFreePath, 1e-6, kLargestLengthMm);
}

} // namespace celadon::app
