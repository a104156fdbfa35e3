#include "app/log.h"
#include "app/option_takers.h"
#include "app/plot/write_plot.h"
#include "app/profile/profile_commands.h"
#include "app/profile/profile_output.h"
#include "app/profile/profile_source.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/medium.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr int kCsvIntervals = 256;

struct MakeOptions {
    MediumOptions medium;
    ModelOptions model;
    int segments = 32;
    double maxRadiusMm = 0.0;
    std::string name;
    std::string output;
};

/// The model's own values, denser towards the center, where they vary most; the row at r = 0 is
/// left out where one is infinite.
std::string profileCsv(const RadialCurves& curves, double maxRadiusMm) {
    std::string csv = "r_mm,R,G,B\n";
    for (int i = 0; i <= kCsvIntervals; ++i) {
        const double t = static_cast<double>(i) / kCsvIntervals;
        const double r = maxRadiusMm * t * t;
        const double red = curves[0].reflectance(r);
        const double green = curves[1].reflectance(r);
        const double blue = curves[2].reflectance(r);
        if (std::isfinite(red) && std::isfinite(green) && std::isfinite(blue)) {
            csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", r, red, green, blue);
        }
    }
    return csv;
}

/// Rings of the random walks, as they were counted, with their standard errors.
std::string walkCsv(const RandomWalkResult& walk, double maxRadiusMm) {
    std::string csv = "r_mm,R,G,B,R_error,G_error,B_error\n";
    for (std::size_t bin = 0; bin < walk.bins() && walk.radiusMm(bin) <= maxRadiusMm; ++bin) {
        csv += fmt::format("{:.9g}", walk.radiusMm(bin));
        for (int channel = 0; channel < 3; ++channel) {
            csv += fmt::format(",{:.9g}", walk.reflectance(channel, bin));
        }
        for (int channel = 0; channel < 3; ++channel) {
            csv += fmt::format(",{:.3g}", walk.reflectanceError(channel, bin));
        }
        csv += '\n';
    }
    return csv;
}

std::string profileName(const MakeOptions& options) {
    if (!options.name.empty()) {
        return options.name;
    }
    return options.medium.preset.empty()
               ? std::filesystem::path(options.output).stem().stem().string()
               : options.medium.preset;
}

void writeFigure(const MakeOptions& options, const MadeProfile& made, double maxRadiusMm) {
    NamedProfile profile{profileName(options), made.curves, maxRadiusMm, {}};
    if (made.walk) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            for (std::size_t bin = 0; bin < made.walk->bins(); ++bin) {
                profile.samples[channel].push_back(
                    {made.walk->radiusMm(bin),
                     made.walk->reflectance(static_cast<int>(channel), bin),
                     made.walk->reflectanceError(static_cast<int>(channel), bin)});
            }
        }
    }
    FigureSettings settings;
    settings.title = fmt::format("{}, {}", profile.name,
                                 kProfileModels[static_cast<std::size_t>(options.model.model)]);
    plot::writePlot(options.output, drawProfiles({profile}, settings));
}

/// Diffusion models may return more light than they take where next to nothing absorbs.
void warnOfExcess(const MadeProfile& made) {
    for (int channel = 0; channel < 3; ++channel) {
        const double total = made.curves[static_cast<std::size_t>(channel)].total;
        // A random walk's total is known to its standard error only.
        if (!made.walk && total > 1.0 + 1e-3) {
            log::warning(
                "the model returns {:.4g} of the {} light: more than it takes; monte-carlo "
                "and normalized-diffusion do not",
                total, channelName(channel));
        }
    }
}

void runMake(const MakeOptions& options) {
    checkOutput(options.output, {".csv", ".subedit.exr", ".exr", ".png", ".svg"});
    const MadeProfile made = makeProfile(options.model, options.medium, "profile make");
    warnOfExcess(made);
    const FitSettings settings{options.segments, options.maxRadiusMm};
    const double maxRadiusMm = chooseMaxRadiusMm(made.curves, settings);
    if (options.output.empty() || hasEnding(options.output, ".csv")) {
        emit(options.output,
             made.walk ? walkCsv(*made.walk, maxRadiusMm) : profileCsv(made.curves, maxRadiusMm));
    } else if (plot::isPlotFile(options.output)) {
        writeFigure(options, made, maxRadiusMm);
    } else {
        const FittedProfile fitted = fitProfile(made.curves, settings);
        writeMaterial(oneTexel(fitted, made.eta, profileName(options)), options.output,
                      StoredPrecision::Float);
        reportFit(options.output, made.curves, fitted);
        if (made.walk) {
            for (int channel = 0; channel < 3; ++channel) {
                log::info("{:5}: total {:.5f} +- {:.1g} (standard error)", channelName(channel),
                          made.walk->channels[static_cast<std::size_t>(channel)].total,
                          made.walk->channels[static_cast<std::size_t>(channel)].totalError);
            }
        }
    }
}

} // namespace

Command addProfileMake(CLI::App& profile) {
    const auto options = std::make_shared<MakeOptions>();
    MakeOptions& o = *options;
    CLI::App* make = profile.add_subcommand("make", "Computes a scattering profile from a model");
    addMediumOptions(*make, o.medium);
    addModelOptions(*make, o.model);
    const char* group = "Result";
    addOption(*make, "-o,--output",
              {group, "FILE",
               "FILE.csv (r_mm,R,G,B; monte-carlo: and standard errors), FILE.subedit.exr (one "
               "texel), FILE.png or .svg (a plot); default: CSV on stdout"},
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

} // namespace celadon::app
