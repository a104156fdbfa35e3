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
    return makeProfile(options, makeMedium(medium, source));
}

} // namespace celadon::app
