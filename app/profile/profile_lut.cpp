#include "app/log.h"
#include "app/option_takers.h"
#include "app/profile/profile_commands.h"
#include "app/profile/profile_output.h"
#include "app/profile/profile_source.h"
#include "renderer/output/image.h"
#include "renderer/output/image_io.h"
#include "subedit/effective_radius.h"
#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

struct LutOptions {
    ModelOptions model;
    glm::ivec2 size{64, 32};
    int segments = 32;
    double fromMm = 0.1;
    double toMm = 10.0;
    double eta = kDefaultEta;
    std::string output;
};

constexpr double kLargestAlbedo = 0.9999;
constexpr double kSmallestAlbedo = 1e-4;
constexpr double kHeldEnergy = 0.999;

/// One column: the profile of an albedo at a mean free path of 1 mm. Lengths only scale a profile,
/// P(r; l) = P(r / l; 1) / l^2, so that a column is one fit.
struct Column {
    std::vector<double> logP; ///< at knots k r_s / n
    double maxRadius = 0.0;   ///< r_s per mean free path
    double total = 0.0;
    double radius95 = 0.0; ///< per mean free path
};

Column makeColumn(const LutOptions& options, double albedo) {
    RadialCurve curve;
    if (options.model.model == ProfileModel::NormalizedDiffusion) {
        const DiffusionFit fit = options.model.fit.value_or(DiffusionFit::Searchlight);
        curve = normalizedDiffusionCurve(albedo, 1.0 / normalizedDiffusionScale(albedo, fit));
    } else {
        curve = makeProfile(options.model,
                            mediumFromAlbedo(glm::dvec3(albedo), glm::dvec3(1.0), options.eta))
                    .curves[0];
    }
    Column column;
    column.total = curve.total;
    column.maxRadius = radiusHolding(curve, kHeldEnergy);
    column.radius95 = radiusHolding(curve, 0.95);
    column.logP.resize(static_cast<std::size_t>(options.segments) + 1);
    static_cast<void>(fitChannel(curve, options.segments, column.maxRadius, column.logP.data()));
    return column;
}

std::vector<std::string> channelNames(int segments) {
    std::vector<std::string> names;
    for (int k = 0; k <= segments; ++k) {
        names.push_back(fmt::format("P{:03}", k));
    }
    names.insert(names.end(), {"maxRadius", "radius95", "total"});
    return names;
}

ImageAttributes describeMapping(const LutOptions& options) {
    return {
        {"celadon:model",
         std::string(kProfileModels[static_cast<std::size_t>(options.model.model)])},
        {"celadon:albedo", "(x + 1/2) / width"},
        {"celadon:meanFreePath", fmt::format("{} mm * {}^((y + 1/2) / height)", options.fromMm,
                                             options.toMm / options.fromMm)},
        {"celadon:profile",
         fmt::format("channel Pkkk is ln P in 1/mm^2 at r = k / {} * maxRadius, linear between, "
                     "P is 0 beyond maxRadius",
                     options.segments)},
        {"celadon:segments", std::to_string(options.segments)},
        {"celadon:eta", fmt::format("{}", options.eta)}};
}

void runLut(const LutOptions& options) {
    if (options.output.empty()) {
        throw UsageError("profile lut", "-o is missing", "name the .exr to write");
    }
    if (options.fromMm >= options.toMm) {
        throw UsageError("--mean-free-path", "does not rise", "give FROM:TO in mm, such as 0.1:10");
    }
    if (options.model.model == ProfileModel::MonteCarlo) {
        throw UsageError("--model monte-carlo", "is too noisy and slow for a table",
                         "choose another model");
    }
    checkOutput(options.output, {".exr"});
    FloatImage image{options.size.x, options.size.y, channelNames(options.segments), {}};
    image.pixels.resize(static_cast<std::size_t>(options.size.x) *
                        static_cast<std::size_t>(options.size.y) * image.channelCount());
    for (int x = 0; x < options.size.x; ++x) {
        const double albedo =
            std::clamp((x + 0.5) / options.size.x, kSmallestAlbedo, kLargestAlbedo);
        const Column column = makeColumn(options, albedo);
        for (int y = 0; y < options.size.y; ++y) {
            const double length = options.fromMm * std::pow(options.toMm / options.fromMm,
                                                            (y + 0.5) / options.size.y);
            int channel = 0;
            for (const double logP : column.logP) {
                image.at(x, y, channel++) = static_cast<float>(logP - 2.0 * std::log(length));
            }
            image.at(x, y, channel++) = static_cast<float>(column.maxRadius * length);
            image.at(x, y, channel++) = static_cast<float>(column.radius95 * length);
            image.at(x, y, channel) = static_cast<float>(column.total);
        }
    }
    ExrSettings settings;
    settings.attributes = describeMapping(options);
    writeExr(options.output, image, settings);
    for (const auto& [name, value] : settings.attributes) {
        log::info("{}: {}", name.substr(name.find(':') + 1), value);
    }
}

} // namespace

Command addProfileLut(CLI::App& profile) {
    const auto options = std::make_shared<LutOptions>();
    LutOptions& o = *options;
    o.model.model = ProfileModel::NormalizedDiffusion;
    CLI::App* lut = profile.add_subcommand(
        "lut", "Writes profiles over albedo and mean free path as a texture for engines");
    const char* group = "Texture";
    addOption(*lut, "-o,--output",
              {group, "FILE",
               "FILE.exr: albedo along x, mean free path along y (logarithmic); channels P000.. "
               "hold ln P at equal steps up to maxRadius. The mapping is in its attributes"},
              takeText(o.output));
    addOption(*lut, "--size", {group, "WxH", "Texels; default 64x32"},
              [&o](const Argument& argument) { o.size = parseSize(argument, 1024, 1 << 18); });
    addOption(*lut, "--segments",
              {group, "N", fmt::format("Steps of the profiles; default {}", o.segments)},
              takeInteger(o.segments, 1, 256));
    addOption(*lut, "--mean-free-path",
              {group, "FROM:TO", fmt::format("1/sigma_t' in mm; default {}:{}", o.fromMm, o.toMm)},
              [&o](const Argument& argument) {
                  const std::size_t colon = argument.text.find(':');
                  if (colon == std::string::npos) {
                      throw UsageError(fmt::format("--mean-free-path '{}'", argument.text),
                                       "is no range", "give FROM:TO in mm, such as 0.1:10");
                  }
                  const NumberRange range{1e-6, 1e6, false};
                  o.fromMm = parseNumber({argument.option, argument.text.substr(0, colon)}, range);
                  o.toMm = parseNumber({argument.option, argument.text.substr(colon + 1)}, range);
              });
    group = "Model";
    addOption(*lut, "--model",
              {group, "NAME",
               "As of profile make; default normalized-diffusion, whose albedo is that of the "
               "surface; alpha' for the others"},
              takeChoice(o.model.model, kProfileModels));
    addOption(*lut, "--fit",
              {group, "searchlight|diffuse|dmfp", "Of normalized diffusion; default searchlight"},
              [&o](const Argument& argument) {
                  o.model.fit = static_cast<DiffusionFit>(parseChoice(argument, kDiffusionFits));
              });
    addOption(*lut, "--eta",
              {group, "N", fmt::format("Relative index of refraction; default {}", o.eta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
    return {lut, [options] { runLut(*options); }};
}

} // namespace celadon::app
