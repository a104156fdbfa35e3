#include "app/command_profile.h"

#include "app/option_takers.h"
#include "app/rgb_argument.h"
#include "renderer/output/atomic_file.h"
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

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr double kLargestCoefficient = 1e6; ///< 1/mm
constexpr double kLargestLengthMm = 1e6;
constexpr int kCsvIntervals = 256;
constexpr double kEta = 1.3; ///< of the media that Jensen et al. 2001 measured

enum class Model { Dipole, NormalizedDiffusion };
constexpr std::array<std::string_view, 2> kModels{"dipole", "normalized-diffusion"};
/// In the order of DiffusionFit.
constexpr std::array<std::string_view, 3> kFits{"searchlight", "diffuse", "dmfp"};

struct MakeOptions {
    Model model = Model::Dipole;
    std::string preset;
    std::string absorption;
    std::string reducedScattering;
    std::string albedo;
    std::string meanFreePath;
    std::optional<double> eta;
    DiffusionFit fit = DiffusionFit::Searchlight;
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
        medium.eta = options.eta.value_or(medium.eta);
    } else if (source == MediumSource::Coefficients) {
        medium = {requireRgb("--absorption", options.absorption, 0.0, kLargestCoefficient),
                  requireRgb("--reduced-scattering", options.reducedScattering, 1e-9,
                             kLargestCoefficient),
                  options.eta.value_or(kEta)};
    } else {
        medium = mediumFromAlbedo(requireRgb("--albedo", options.albedo, 1e-9, 1.0),
                                  requireMeanFreePath(options), options.eta.value_or(kEta));
    }
    validateMedium(medium);
    return medium;
}

RadialCurves makeNormalizedDiffusion(const MakeOptions& options, MediumSource source, double& eta) {
    if (source == MediumSource::Albedo) {
        return normalizedDiffusionProfile(requireRgb("--albedo", options.albedo, 0.0, 1.0),
                                          requireMeanFreePath(options), options.fit);
    }
    const Medium medium = makeMedium(options, source);
    eta = medium.eta;
    glm::dvec3 length = 1.0 / medium.reducedExtinction();
    if (options.fit == DiffusionFit::Dmfp) {
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
    return normalizedDiffusionProfile(halfSpaceTotal(medium), length, options.fit);
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

/// Before the work, not after.
void checkMakeOutput(const std::string& output) {
    if (output.empty()) {
        return;
    }
    if (!output.ends_with(".csv") && !output.ends_with(".exr")) {
        throw UsageError(fmt::format("-o '{}'", output), "is of no known kind",
                         "end it in .csv or .subedit.exr");
    }
    checkWritable(output);
}

void runMake(const MakeOptions& options) {
    checkMakeOutput(options.output);
    const MediumSource source = mediumSource(options);
    double eta = options.eta.value_or(kEta);
    RadialCurves curves;
    if (options.model == Model::Dipole) {
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
    if (options.material.empty()) {
        throw UsageError("profile table", "no material is given",
                         "name a file or a shipped material");
    }
    if (!options.output.empty()) {
        checkWritable(options.output);
    }
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

Command addMake(CLI::App& profile) {
    const auto options = std::make_shared<MakeOptions>();
    MakeOptions& o = *options;
    CLI::App* make = profile.add_subcommand("make", "Computes a scattering profile from a model");
    const char* group = "Medium";
    addOption(
        *make, "--preset",
        {group, "NAME", "A measured medium: marble, skin1, wholemilk, ... (Jensen et al. 2001)"},
        takeText(o.preset));
    addOption(*make, "--absorption", {group, "R,G,B", "sigma_a in 1/mm"}, takeText(o.absorption));
    addOption(*make, "--reduced-scattering", {group, "R,G,B", "sigma_s' in 1/mm"},
              takeText(o.reducedScattering));
    addOption(*make, "--albedo",
              {group, "R,G,B",
               "Surface albedo for normalized-diffusion, single scattering alpha' for dipole"},
              takeText(o.albedo));
    addOption(*make, "--mean-free-path", {group, "R,G,B", "1/sigma_t' in mm"},
              takeText(o.meanFreePath));
    addOption(*make, "--eta",
              {group, "N",
               fmt::format("Relative index of refraction; default: the preset's, else {}", kEta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
    group = "Model";
    addOption(*make, "--model", {group, "NAME", "dipole or normalized-diffusion; default dipole"},
              takeChoice(o.model, kModels));
    addOption(*make, "--fit",
              {group, "searchlight|diffuse|dmfp", "Of normalized diffusion; default searchlight"},
              takeChoice(o.fit, kFits));
    group = "Result";
    addOption(*make, "-o,--output",
              {group, "FILE",
               "FILE.csv (r_mm,R,G,B) or FILE.subedit.exr (one texel); default: CSV on stdout"},
              takeText(o.output));
    addOption(*make, "--segments",
              {group, "N",
               fmt::format("Segments of the stored profile, 1 to {}; default {}", kMaxSegments,
                           o.segments)},
              takeInteger(o.segments, 1, kMaxSegments));
    addOption(*make, "--max-radius", {group, "MM", "r_s; default: holds 99.9 % of the energy"},
              takeNumber(o.maxRadiusMm, {1e-6, 1e6, false}));
    addOption(*make, "--name", {group, "NAME", "Of the material; default: the preset's or file's"},
              takeText(o.name));
    return {make, [options] { runMake(*options); }};
}

Command addTable(CLI::App& profile) {
    const auto options = std::make_shared<TableOptions>();
    TableOptions& o = *options;
    CLI::App* table = profile.add_subcommand(
        "table", "Computes a material's mean profile and minimal rendering radii, as CSV");
    addPositional(*table, "MATERIAL", "A .subedit.exr file, or the name of a shipped material",
                  o.material);
    const char* group = "Table";
    addOption(*table, "--epsilon",
              {group, "E", fmt::format("Error allowed in a ring's energy; default {}", o.epsilon)},
              takeNumber(o.epsilon, {1e-6, 1.0, false}));
    addOption(
        *table, "--energy",
        {group, "F", fmt::format("Energy that the effective radius holds; default {}", o.energy)},
        takeNumber(o.energy, {0.01, 1.0, false}));
    addOption(*table, "-o,--output", {group, "FILE", "FILE.csv; default: stdout"},
              takeText(o.output));
    return {table, [options] { runTable(*options); }};
}

} // namespace

Command addProfileCommand(CLI::App& root) {
    CLI::App* profile =
        root.add_subcommand("profile", "Computes scattering profiles and their tables");
    return {profile, {}, {addMake(*profile), addTable(*profile)}};
}

} // namespace celadon::app
