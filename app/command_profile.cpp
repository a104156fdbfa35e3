#include "app/command_profile.h"

#include "app/rgb_argument.h"
#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/models/dipole.h"
#include "subedit/models/half_space.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/pending_file.h"
#include "subedit/presets.h"
#include "subedit/radius_map.h"
#include "subedit/range_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace celadon {

namespace {

using namespace subedit;

constexpr double kLargestCoefficient = 1e6; ///< 1/mm
constexpr double kLargestLengthMm = 1e6;
constexpr int kCsvIntervals = 256;

struct MakeOptions {
    std::string model = "dipole";
    std::string preset;
    std::string absorption;
    std::string reducedScattering;
    std::string albedo;
    std::string meanFreePath;
    double eta = 1.3;
    bool etaIsGiven = false;
    std::string fit = "searchlight";
    int segments = 32;
    double maxRadiusMm = 0.0;
    std::string name;
    std::string output;
};

struct TableOptions {
    std::string material;
    double epsilon = 0.01;
    double energy = 0.95;
    std::string output;
};

void emit(const std::string& output, const std::string& text) {
    if (output.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
    } else {
        writeTextFile(output, text);
    }
}

/// Exactly one of the three ways to give a medium.
enum class MediumSource { Preset, Coefficients, Albedo };

MediumSource mediumSource(const MakeOptions& options) {
    const bool hasPreset = !options.preset.empty();
    const bool hasCoefficients = !options.absorption.empty() || !options.reducedScattering.empty();
    const bool hasAlbedo = !options.albedo.empty() || !options.meanFreePath.empty();
    if (hasPreset + hasCoefficients + hasAlbedo != 1) {
        throw UsageError("profile make",
                         hasPreset || hasCoefficients || hasAlbedo
                             ? "the medium is given in more than one way"
                             : "no medium is given",
                         "use one of --preset, --absorption with --reduced-scattering, or "
                         "--albedo with --mean-free-path");
    }
    if (hasCoefficients && (options.absorption.empty() || options.reducedScattering.empty())) {
        throw UsageError("profile make", options.absorption.empty()
                                             ? "--absorption is missing"
                                             : "--reduced-scattering is missing");
    }
    if (hasAlbedo && (options.albedo.empty() || options.meanFreePath.empty())) {
        throw UsageError("profile make", options.albedo.empty() ? "--albedo is missing"
                                                                : "--mean-free-path is missing");
    }
    return hasPreset ? MediumSource::Preset
                     : (hasCoefficients ? MediumSource::Coefficients : MediumSource::Albedo);
}

glm::dvec3 requireMeanFreePath(const MakeOptions& options) {
    return requireRgb("--mean-free-path", options.meanFreePath, 1e-6, kLargestLengthMm);
}

Medium makeMedium(const MakeOptions& options, MediumSource source) {
    Medium medium;
    if (source == MediumSource::Preset) {
        medium = findMediumPreset(options.preset);
        if (options.etaIsGiven) {
            medium.eta = options.eta;
        }
    } else if (source == MediumSource::Coefficients) {
        medium = {requireRgb("--absorption", options.absorption, 0.0, kLargestCoefficient),
                  requireRgb("--reduced-scattering", options.reducedScattering, 1e-9,
                             kLargestCoefficient),
                  options.eta};
    } else {
        medium = mediumFromAlbedo(requireRgb("--albedo", options.albedo, 1e-9, 1.0),
                                  requireMeanFreePath(options), options.eta);
    }
    validateMedium(medium);
    return medium;
}

RadialCurves makeNormalizedDiffusion(const MakeOptions& options, MediumSource source, double& eta) {
    const DiffusionFit fit = options.fit == "diffuse" ? DiffusionFit::Diffuse
                             : options.fit == "dmfp"  ? DiffusionFit::Dmfp
                                                      : DiffusionFit::Searchlight;
    if (source == MediumSource::Albedo) {
        return normalizedDiffusionProfile(requireRgb("--albedo", options.albedo, 0.0, 1.0),
                                          requireMeanFreePath(options), fit);
    }
    const Medium medium = makeMedium(options, source);
    eta = medium.eta;
    glm::dvec3 length = 1.0 / medium.reducedExtinction();
    if (fit == DiffusionFit::Dmfp) {
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
    return normalizedDiffusionProfile(halfSpaceTotal(medium), length, fit);
}

/// The model's own values; the row at r = 0 is left out where one is infinite.
std::string profileCsv(const RadialCurves& curves, double maxRadiusMm) {
    std::string csv = "r_mm,R,G,B\n";
    for (int i = 0; i <= kCsvIntervals; ++i) {
        const double r = maxRadiusMm * i / kCsvIntervals;
        const double red = curves[0].reflectance(r);
        const double green = curves[1].reflectance(r);
        const double blue = curves[2].reflectance(r);
        if (std::isfinite(red) && std::isfinite(green) && std::isfinite(blue)) {
            csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", r, red, green, blue);
        }
    }
    return csv;
}

void reportFit(const RadialCurves& curves, const FittedProfile& fitted) {
    const glm::dvec3 albedo = diffuseAlbedo(fitted.view());
    const glm::dvec3 radius = effectiveRadiusMm(fitted.view());
    fmt::print("r_s {:.4g} mm, {} segments\n", fitted.maxRadiusMm, fitted.segments);
    for (int channel = 0; channel < 3; ++channel) {
        fmt::print("{:5}: albedo {:.4f} (model {:.4f}), R_P {:.4g} mm, rms error of ln P {:.3g}\n",
                   channelName(channel), albedo[channel],
                   curves[static_cast<std::size_t>(channel)].total, radius[channel],
                   fitted.rmsLogError[channel]);
    }
}

void runMake(const MakeOptions& options) {
    const MediumSource source = mediumSource(options);
    double eta = options.eta;
    RadialCurves curves;
    if (options.model == "dipole") {
        const Medium medium = makeMedium(options, source);
        eta = medium.eta;
        curves = dipoleProfile(medium);
    } else {
        curves = makeNormalizedDiffusion(options, source, eta);
    }
    const FitSettings settings{options.segments, options.maxRadiusMm};
    const std::filesystem::path output(options.output);
    if (output.empty() || output.extension() == ".csv") {
        emit(options.output, profileCsv(curves, chooseMaxRadiusMm(curves, settings)));
        return;
    }
    if (!options.output.ends_with(".exr")) {
        throw UsageError(fmt::format("-o '{}'", options.output), "is of no known kind",
                         "end it in .csv or .subedit.exr");
    }
    const FittedProfile fitted = fitProfile(curves, settings);
    MaterialMap map;
    map.name = !options.name.empty()     ? options.name
               : !options.preset.empty() ? options.preset
                                         : output.stem().stem().string();
    map.width = map.height = 1;
    map.segments = fitted.segments;
    map.maxRadiusMm = fitted.maxRadiusMm;
    map.eta = static_cast<float>(eta);
    map.logProfile = fitted.logProfile;
    writeMaterial(map, output);
    reportFit(curves, fitted);
}

void runTable(const TableOptions& options) {
    const MaterialMap map = readMaterial(findMaterial(options.material));
    const MeanProfile mean = meanProfile(map, effectiveRadiusMap(map, options.energy));
    const RangeTable table = RangeTable::build(mean, options.epsilon);
    std::string csv = "r,meanProfile\n";
    const auto samples = mean.samples();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        csv += fmt::format("{:.9g},{:.9g}\n",
                           static_cast<double>(i) / static_cast<double>(samples.size() - 1),
                           samples[i]);
    }
    csv += "\nT,minimalRadius\n";
    for (std::size_t i = 0; i < table.values().size(); ++i) {
        csv += fmt::format("{:.9g},{:.9g}\n",
                           std::exp2(static_cast<double>(i) / kRangeTableEntriesPerOctave),
                           table.values()[i]);
    }
    emit(options.output, csv);
}

void addMake(CLI::App& profile) {
    const auto options = std::make_shared<MakeOptions>();
    CLI::App* make = profile.add_subcommand("make", "a scattering profile from a model");
    make->add_option("--model", options->model, "diffusion model")
        ->check(CLI::IsMember({"dipole", "normalized-diffusion"}))
        ->capture_default_str();
    make->add_option("--preset", options->preset,
                     "measured medium: marble, skin1, wholemilk, ... (Jensen et al. 2001)");
    make->add_option("--absorption", options->absorption, "sigma_a, R,G,B in 1/mm");
    make->add_option("--reduced-scattering", options->reducedScattering, "sigma_s', R,G,B in 1/mm");
    make->add_option("--albedo", options->albedo,
                     "R,G,B: surface albedo for normalized-diffusion, single scattering alpha' "
                     "for dipole");
    make->add_option("--mean-free-path", options->meanFreePath, "1/sigma_t', R,G,B in mm");
    CLI::Option* eta = make->add_option("--eta", options->eta, "relative index of refraction")
                           ->check(CLI::Range(0.5, 4.0))
                           ->capture_default_str();
    make->add_option("--fit", options->fit, "of normalized diffusion")
        ->check(CLI::IsMember({"searchlight", "diffuse", "dmfp"}))
        ->capture_default_str();
    make->add_option("--segments", options->segments, "of the stored profile")
        ->check(CLI::Range(1, kMaxSegments))
        ->capture_default_str();
    make->add_option("--max-radius", options->maxRadiusMm,
                     "r_s in mm (default: holds 99.9 % of the energy)")
        ->check(CLI::Range(1e-6, 1e6));
    make->add_option("--name", options->name, "of the material");
    make->add_option("-o,--output", options->output,
                     "FILE.csv (r_mm,R,G,B) or FILE.subedit.exr; CSV on stdout without it");
    make->callback([options, eta] {
        options->etaIsGiven = eta->count() > 0;
        runMake(*options);
    });
}

void addTable(CLI::App& profile) {
    const auto options = std::make_shared<TableOptions>();
    CLI::App* table = profile.add_subcommand(
        "table", "a material's mean profile and minimal effective rendering radii, as CSV");
    table->add_option("material", options->material, "file, or name of a shipped one")->required();
    table->add_option("--epsilon", options->epsilon, "error allowed in a ring's energy")
        ->check(CLI::Range(1e-6, 1.0))
        ->capture_default_str();
    table->add_option("--energy", options->energy, "that the effective radius holds")
        ->check(CLI::Range(0.01, 1.0))
        ->capture_default_str();
    table->add_option("-o,--output", options->output, "FILE.csv; stdout without it");
    table->callback([options] { runTable(*options); });
}

} // namespace

void addProfileCommand(CLI::App& app) {
    CLI::App* profile = app.add_subcommand("profile", "scattering profiles and their tables");
    profile->require_subcommand(1);
    addMake(*profile);
    addTable(*profile);
}

} // namespace celadon
