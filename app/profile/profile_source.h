#pragma once

#include "app/profile/medium_options.h"
#include "app/profile/profile_figure.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/models/random_walk.h"

#include <optional>
#include <string>
#include <string_view>

/// From a model's name and a medium to curves: what `profile make` and `profile lut` share.
namespace celadon::app {

enum class ProfileModel {
    Dipole,
    BetterDipole,
    Quantized,
    PhotonBeam,
    NormalizedDiffusion,
    MonteCarlo
};
/// In the order of ProfileModel.
inline constexpr std::array<std::string_view, 6> kProfileModels{
    "dipole", "better-dipole", "quantized", "photon-beam", "normalized-diffusion", "monte-carlo"};
/// In the order of DiffusionFit, and of LightEntry.
inline constexpr std::array<std::string_view, 3> kDiffusionFits{"searchlight", "diffuse", "dmfp"};
inline constexpr std::array<std::string_view, 2> kLightEntries{"pencil", "diffuse"};

struct ModelOptions {
    ProfileModel model = ProfileModel::Dipole;
    std::optional<subedit::DiffusionFit> fit;
    subedit::RandomWalkSettings walk;
};

struct MadeProfile {
    subedit::RadialCurves curves;
    double eta = kDefaultEta;
    std::optional<subedit::RandomWalkResult> walk; ///< of monte-carlo
};

void addModelOptions(CLI::App& app, ModelOptions& options);

/// @throws UsageError for options that do not go with the model
[[nodiscard]] MadeProfile makeProfile(const ModelOptions& model, const MediumOptions& medium,
                                      const std::string& command);

/// The same from a medium. @throws UsageError: normalized diffusion by `dmfp` without absorption
[[nodiscard]] MadeProfile makeProfile(const ModelOptions& model, const subedit::Medium& medium);

} // namespace celadon::app
