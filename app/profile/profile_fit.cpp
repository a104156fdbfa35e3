#include "app/log.h"
#include "app/option_takers.h"
#include "app/plot/write_plot.h"
#include "app/profile/medium_options.h"
#include "app/profile/profile_commands.h"
#include "app/profile/profile_figure.h"
#include "app/profile/profile_output.h"
#include "subedit/errors.h"
#include "subedit/fit/measured_curve.h"
#include "subedit/fit/stored_curve.h"
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

constexpr std::array<std::string_view, 3> kCenters{"auto", "flat", "singular"};
constexpr double kAlbedoTolerance = 1e-3;

struct FitOptions {
    std::string input;
    CurveCenter center = CurveCenter::Auto;
    double tolerance = 0.02;
    int segments = 0;
    double maxRadiusMm = 0.0;
    double eta = kDefaultEta;
    std::string name;
    std::string output;
};

/// Measurements may not add up: said, not mended.
void warnOfAlbedo(const std::string& input, const RadialCurves& curves) {
    for (int channel = 0; channel < 3; ++channel) {
        const double total = curves[static_cast<std::size_t>(channel)].total;
        if (total > 1.0 + kAlbedoTolerance) {
            log::warning("'{}': {} has an albedo of {:.4g}: it gives more light than it takes; is "
                         "P in 1/mm^2 per unit of flux?",
                         input, channelName(channel), total);
        }
    }
}

/// Half precision would cost what the fit has gained: one texel is small in any case.
void writeFit(const FitOptions& options, const RadialCurves& curves, const FittedProfile& fitted,
              const std::string& name) {
    const MaterialMap map = oneTexel(fitted, options.eta, name);
    if (plot::isPlotFile(options.output)) {
        FigureSettings settings;
        settings.title = fmt::format("{}, fitted with {} segments", name, fitted.segments);
        settings.showsRatio = true;
        plot::writePlot(
            options.output,
            drawProfiles(
                {{"given", curves, static_cast<double>(fitted.maxRadiusMm), {}},
                 {"fitted", storedCurves(map), static_cast<double>(fitted.maxRadiusMm), {}}},
                settings));
    } else if (!options.output.empty()) {
        writeMaterial(map, options.output, StoredPrecision::Float);
    }
}

void runFit(const FitOptions& options) {
    if (options.input.empty()) {
        throw UsageError("profile fit", "no table is given", "name a CSV of rows r_mm,R,G,B");
    }
    checkOutput(options.output, {".subedit.exr", ".exr", ".png", ".svg"});
    const MeasuredProfile measured = readProfileCsv(options.input);
    const RadialCurves curves = measuredCurves(measured, options.center);
    warnOfAlbedo(options.input, curves);
    FitSettings settings;
    settings.maxRadiusMm = options.maxRadiusMm;
    FittedProfile fitted;
    if (options.segments > 0) {
        settings.segments = options.segments;
        fitted = fitProfile(curves, settings);
    } else {
        fitted = fitProfileWithin(curves, options.tolerance, settings);
    }
    const FitError error = measureFit(curves, fitted);
    for (int channel = 0; channel < 3; ++channel) {
        const double total = curves[static_cast<std::size_t>(channel)].total;
        if (std::abs(error.albedo[channel]) > kAlbedoTolerance * std::max(total, 1e-6)) {
            log::warning("'{}': the albedo of {} is off by {:.2g}", options.input,
                         channelName(channel), error.albedo[channel]);
        }
    }
    const std::string name =
        options.name.empty() ? std::filesystem::path(options.input).stem().string() : options.name;
    writeFit(options, curves, fitted, name);
    reportFit(options.output, curves, fitted);
}

} // namespace

Command addProfileFit(CLI::App& profile) {
    const auto options = std::make_shared<FitOptions>();
    FitOptions& o = *options;
    CLI::App* fit = profile.add_subcommand(
        "fit", "Fits a stored profile to a measured or computed curve, and reports the error");
    addPositional(*fit, "CSV", "Rows r_mm,R,G,B or r_mm,P, with P in 1/mm^2", o.input);
    const char* group = "Fit";
    addOption(*fit, "--center",
              {group, "auto|flat|singular",
               "Between r = 0 and the first row: as the first rows rise, flat, or like 1/r; "
               "default auto"},
              takeChoice(o.center, kCenters));
    addOption(*fit, "--tolerance",
              {group, "E",
               fmt::format("Largest rms error of ln P for which segments are added; default {}",
                           o.tolerance)},
              takeNumber(o.tolerance, {1e-4, 1.0, false}));
    addOption(
        *fit, "--segments",
        {group, "N",
         fmt::format("Segments, 1 to {}; default: as few as meet the tolerance", kMaxSegments)},
        takeInteger(o.segments, 1, kMaxSegments));
    addOption(*fit, "--max-radius", {group, "MM", "r_s; default: holds 99.9 % of the energy"},
              takeNumber(o.maxRadiusMm, {1e-6, 1e6, false}));
    group = "Result";
    addOption(*fit, "-o,--output",
              {group, "FILE",
               "FILE.subedit.exr, or FILE.png or .svg: curve and fit; default: the report alone, "
               "on stdout"},
              takeText(o.output));
    addOption(*fit, "--eta",
              {group, "N", fmt::format("Relative index of refraction; default {}", o.eta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
    addOption(*fit, "--name", {group, "NAME", "Of the material; default: the file's"},
              takeText(o.name));
    return {fit, [options] { runFit(*options); }};
}

} // namespace celadon::app
