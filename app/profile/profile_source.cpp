#include "app/profile/profile_source.h"

#include "app/option_takers.h"
#include "app/progress.h"
#include "subedit/errors.h"
#include "subedit/models/better_dipole.h"
#include "subedit/models/dipole.h"
#include "subedit/models/half_space.h"
#include "subedit/models/monte_carlo.h"
#include "subedit/models/photon_beam.h"
#include "subedit/models/quantized_diffusion.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>

namespace celadon::app {

using namespace subedit;

namespace {

constexpr int kMostWalks = 2'000'000'000;

RadialCurves normalizedDiffusion(const Medium& medium, std::optional<DiffusionFit> fit) {
    if (!fit) {
        return normalizedDiffusionProfile(medium);
    }
    glm::dvec3 length = 1.0 / medium.reducedExtinction();
    if (*fit == DiffusionFit::Dmfp) {
        for (int channel = 0; channel < 3; ++channel) {
            if (medium.absorption[channel] <= 0.0) {
                throw UsageError("--fit dmfp",
                                 fmt::format("{} does not absorb: its diffuse mean free path is "
                                             "infinite",
                                             channelName(channel)),
                                 "use --fit searchlight");
            }
            length[channel] = 1.0 / std::sqrt(3.0 * medium.absorption[channel] *
                                              medium.reducedExtinction()[channel]);
        }
    }
    return normalizedDiffusionProfile(halfSpaceTotal(medium), length, *fit);
}

/// The medium with which a model returns as much light as is wanted: alpha' by regula falsi
/// that halves the weight of the end that stays, all channels at once. What a model
/// cannot return stays what alpha' = 1 gives.
/// @param medium of the same mean free paths
Medium mediumReturning(const ModelOptions& model, const Medium& medium, const glm::dvec3& wanted) {
    constexpr int kMostSteps = 40;
    constexpr double kTolerance = 1e-5;
    constexpr double kSmallest = 1e-9; // alpha' that a medium may have
    const glm::dvec3 length = 1.0 / medium.reducedExtinction();
    const auto missOf = [&](const glm::dvec3& albedo) {
        const MadeProfile made = makeProfile(model, mediumFromAlbedo(albedo, length, medium.eta));
        return glm::dvec3(made.curves[0].total, made.curves[1].total, made.curves[2].total) -
               wanted;
    };
    glm::dvec3 low(kSmallest);
    glm::dvec3 high(1.0);
    glm::dvec3 missLow = missOf(low);
    glm::dvec3 missHigh = missOf(high);
    glm::dvec3 best = glm::mix(high, low, glm::greaterThanEqual(missLow, glm::dvec3(0.0)));
    for (int step = 0; step < kMostSteps; ++step) {
        for (int c = 0; c < 3; ++c) {
            if (missLow[c] < 0.0 && missHigh[c] > 0.0) {
                best[c] =
                    (low[c] * missHigh[c] - high[c] * missLow[c]) / (missHigh[c] - missLow[c]);
            }
        }
        const glm::dvec3 miss = missOf(best);
        bool isFound = true;
        for (int c = 0; c < 3; ++c) {
            if (!(missLow[c] < 0.0 && missHigh[c] > 0.0) || std::abs(miss[c]) < kTolerance) {
                continue;
            }
            isFound = false;
            if (miss[c] < 0.0) {
                low[c] = best[c];
                missLow[c] = miss[c];
                missHigh[c] *= 0.5;
            } else {
                high[c] = best[c];
                missHigh[c] = miss[c];
                missLow[c] *= 0.5;
            }
        }
        if (isFound) {
            break;
        }
    }
    Medium found = mediumFromAlbedo(best, length, medium.eta);
    found.anisotropy = medium.anisotropy;
    return found;
}

RandomWalkResult walkWithProgress(const Medium& medium, RandomWalkSettings settings) {
    constexpr std::size_t kSteps = 1000;
    Progress progress("random walks", kSteps);
    settings.onProgress = [&](double part) {
        progress.update(static_cast<std::size_t>(part * kSteps));
    };
    return simulateRandomWalk(medium, settings);
}

void checkModelOptions(const ModelOptions& options) {
    if (options.walk.entry == LightEntry::Diffuse && options.model != ProfileModel::MonteCarlo) {
        throw UsageError("--entry diffuse", "only monte-carlo takes light that enters diffusely",
                         "choose --model monte-carlo, or --model normalized-diffusion with --fit "
                         "diffuse");
    }
    if (options.fit && options.model != ProfileModel::NormalizedDiffusion) {
        throw UsageError("--fit", "belongs to normalized diffusion",
                         "add --model normalized-diffusion");
    }
}

} // namespace

void addModelOptions(CLI::App& app, ModelOptions& o) {
    const char* group = "Model";
    addOption(app, "--model",
              {group, "NAME",
               "dipole, better-dipole, quantized, photon-beam, normalized-diffusion or "
               "monte-carlo; default dipole"},
              takeChoice(o.model, kProfileModels));
    addOption(app, "--fit",
              {group, "searchlight|diffuse|dmfp",
               "Of normalized diffusion: its published scales; with dmfp, --mean-free-path is "
               "1/sigma_tr. Default: searchlight for --albedo; for coefficients, the range that "
               "photon-beam has, which the scales fall short of for --eta above 1"},
              [&o](const Argument& argument) {
                  o.fit = static_cast<DiffusionFit>(parseChoice(argument, kDiffusionFits));
              });
    addOption(app, "--samples",
              {group, "N", fmt::format("Random walks of monte-carlo; default {}", o.walk.walks)},
              takeInteger(o.walk.walks, 1, kMostWalks));
    addOption(app, "--seed", {group, "N", fmt::format("Of monte-carlo; default {}", o.walk.seed)},
              takeInteger(o.walk.seed, 0, 2147483647));
    addOption(app, "--entry",
              {group, "pencil|diffuse", "How light enters in monte-carlo; default pencil"},
              takeChoice(o.walk.entry, kLightEntries));
}

MadeProfile makeProfile(const ModelOptions& options, const Medium& medium) {
    checkModelOptions(options);
    MadeProfile made;
    made.eta = medium.eta;
    switch (options.model) {
    case ProfileModel::Dipole:
        if (medium.eta > kLargestDipoleEta) {
            throw UsageError(
                "--eta", fmt::format("the dipole's Fresnel term holds up to {}", kLargestDipoleEta),
                "choose another --model");
        }
        made.curves = dipoleProfile(medium);
        break;
    case ProfileModel::BetterDipole:
        made.curves = betterDipoleProfile(medium);
        break;
    case ProfileModel::Quantized:
        made.curves = quantizedDiffusionProfile(medium);
        break;
    case ProfileModel::PhotonBeam:
        made.curves = photonBeamProfile(medium);
        break;
    case ProfileModel::NormalizedDiffusion:
        made.curves = normalizedDiffusion(medium, options.fit);
        break;
    case ProfileModel::MonteCarlo:
        made.walk = walkWithProgress(medium, options.walk);
        made.curves = monteCarloProfile(*made.walk);
        break;
    }
    return made;
}

MadeProfile makeProfile(const ModelOptions& options, const MediumOptions& medium,
                        const std::string& command) {
    const MediumSource source = mediumSource(medium, command);
    const bool hasSurfaceAlbedo =
        source == MediumSource::Albedo || source == MediumSource::SurfaceAlbedo;
    if (options.model == ProfileModel::NormalizedDiffusion && hasSurfaceAlbedo) {
        checkModelOptions(options);
        return {normalizedDiffusionProfile(givenAlbedo(medium), givenMeanFreePath(medium),
                                           options.fit.value_or(DiffusionFit::Searchlight)),
                medium.eta.value_or(kDefaultEta),
                {}};
    }
    const Medium made = makeMedium(medium, source);
    // A random walk returns what a half space does but for its noise.
    const bool isInverted =
        source == MediumSource::SurfaceAlbedo && options.model != ProfileModel::MonteCarlo;
    return makeProfile(options,
                       isInverted ? mediumReturning(options, made, givenAlbedo(medium)) : made);
}

} // namespace celadon::app
