#include "app/log.h"
#include "app/material/material_commands.h"
#include "app/material/response_table.h"
#include "app/option_takers.h"
#include "app/profile/profile_output.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/medium.h"
#include "subedit/radius_map.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr int kMaxSide = 512;
constexpr double kMostUnknowns = 4e6;

struct FitOptions {
    std::string table;
    std::string images;
    ResponseImages imageSettings;
    ResponseFitSettings fit;
    double eta = 1.4;
    std::string name;
    std::string output;
};

void report(const ResponseFit& fit) {
    log::info("{} x {} texels, {} segments to r_s = {:.4g} mm; {} samples used, {} left out",
              fit.map.width, fit.map.height, fit.map.segments, fit.map.maxRadiusMm, fit.used,
              fit.leftOut);
    for (int channel = 0; channel < 3; ++channel) {
        log::info("{:5}: rms error of ln R_d {:.3g}, relative error of R_d {:.2f} %",
                  channelName(channel), fit.rmsLogError[channel],
                  100.0 * fit.relativeError[channel]);
    }
    if (fit.texelsWithout > 0) {
        log::warning("{} of {} texels have no sample: they continue their neighbors; a smaller "
                     "--size has fewer",
                     fit.texelsWithout, fit.map.width * fit.map.height);
    }
    if (fit.clamped > 0) {
        log::warning("{} profiles came out with an albedo above 1 and were scaled to 1; is R_d in "
                     "1/mm^2 per unit of flux?",
                     fit.clamped);
    }
}

void runFit(const FitOptions& options) {
    if (options.table.empty() == options.images.empty()) {
        throw UsageError("material fit",
                         options.table.empty() ? "no responses are given"
                                               : "a table and images are both given",
                         "name a CSV of point pairs, or --images LIST");
    }
    if (!options.images.empty() && options.imageSettings.extentMm <= 0.0) {
        throw UsageError("material fit", "--extent is missing",
                         "say how many mm wide the images are");
    }
    if (static_cast<double>(options.fit.width) * options.fit.height * (options.fit.segments + 1) >
        kMostUnknowns) {
        throw UsageError("material fit", "more profiles than can be solved for at once",
                         "give a smaller --size or fewer --segments");
    }
    checkMaterialOutput("material fit", options.output);
    const std::vector<ResponseSample> samples =
        options.images.empty() ? parseResponseCsv(readTextFile(options.table), options.table)
                               : readResponseImages(options.images, options.imageSettings);
    ResponseFit fit = fitResponses(samples, options.fit);
    fit.map.eta = static_cast<float>(options.eta);
    fit.map.name = options.name.empty()
                       ? std::filesystem::path(options.output).stem().stem().string()
                       : options.name;
    writeMaterial(fit.map, options.output, StoredPrecision::Float);
    report(fit);
}

} // namespace

Command addMaterialFit(CLI::App& material) {
    const auto options = std::make_shared<FitOptions>();
    FitOptions& o = *options;
    CLI::App* fit = material.add_subcommand(
        "fit", "Factors measured responses R_d(x_i, x_o) into a map of profiles");
    addPositional(*fit, "CSV",
                  "Pairs of points, with a header: u_in,v_in,u_out,v_out,r_mm,R,G,B in 1/mm^2, or "
                  "x_in,y_in,z_in,x_out,y_out,z_out in mm for r_mm",
                  o.table);
    const char* group = "Images";
    addOption(
        *fit, "--images",
        {group, "LIST",
         "Instead: a CSV file,u,v of pictures of a flat sample, lit at the point (u, v) each"},
        takeText(o.images));
    addOption(*fit, "--extent", {group, "MM", "Width of what the pictures show"},
              takeNumber(o.imageSettings.extentMm, {1e-6, 1e6, false}));
    addOption(*fit, "--image-scale",
              {group, "S", "R_d in 1/mm^2 that a linear pixel value of 1 stands for; default 1"},
              takeNumber(o.imageSettings.scale, {1e-12, 1e12, false}));
    addOption(*fit, "--darkest",
              {group, "F",
               fmt::format("Pixels below this part of the brightest are noise; default {}",
                           o.imageSettings.darkest)},
              takeNumber(o.imageSettings.darkest, {0.0, 1.0, false}));
    group = "Fit";
    addOption(*fit, "--size", {group, "N|WxH", "Texels of the map; default 16"},
              [&o](const Argument& argument) {
                  if (argument.text.find('x') == std::string::npos) {
                      o.fit.width = o.fit.height = parseInteger(argument, 1, kMaxSide);
                  } else {
                      const glm::ivec2 size = parseSize(argument, kMaxSide, kMaxSide * kMaxSide);
                      o.fit.width = size.x;
                      o.fit.height = size.y;
                  }
              });
    addOption(*fit, "--segments",
              {group, "N", fmt::format("Of the profiles; default {}", o.fit.segments)},
              takeInteger(o.fit.segments, 1, kMaxSegments));
    addOption(*fit, "--max-radius",
              {group, "MM", "r_s; default: the largest distance of the samples"},
              takeNumber(o.fit.maxRadiusMm, {1e-6, 1e6, false}));
    addOption(
        *fit, "--smoothness",
        {group, "W", fmt::format("Weight of smooth profiles; default {}", o.fit.radialSmoothness)},
        takeNumber(o.fit.radialSmoothness, {0.0, 1e3, false}));
    addOption(
        *fit, "--spatial-smoothness",
        {group, "W", fmt::format("Weight of neighbors alike; default {}", o.fit.spatialSmoothness)},
        takeNumber(o.fit.spatialSmoothness, {0.0, 1e3, false}));
    group = "Result";
    addOption(*fit, "-o,--output", {group, "FILE", "The material, NAME.subedit.exr"},
              takeText(o.output));
    addOption(*fit, "--eta",
              {group, "N", fmt::format("Relative index of refraction; default {}", o.eta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
    addOption(*fit, "--name", {group, "NAME", "Of the material; default: the file's"},
              takeText(o.name));
    return {fit, [options] { runFit(*options); }};
}

} // namespace celadon::app
