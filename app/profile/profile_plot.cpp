#include "app/option_takers.h"
#include "app/plot/write_plot.h"
#include "app/profile/profile_commands.h"
#include "app/profile/profile_figure.h"
#include "app/profile/profile_output.h"
#include "subedit/errors.h"
#include "subedit/fit/measured_curve.h"
#include "subedit/fit/stored_curve.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

namespace celadon::app {

namespace {

using namespace subedit;

struct PlotOptions {
    std::vector<std::string> inputs;
    FigureSettings figure;
    glm::dvec2 texel{0.5, 0.5};
    bool hidesEnergy = false;
    std::string output;
};

/// "LABEL=FILE" or "FILE"; a name of a material has no '='.
std::pair<std::string, std::string> splitLabel(const std::string& input) {
    const std::size_t equals = input.find('=');
    if (equals == std::string::npos || equals == 0) {
        std::string stem = std::filesystem::path(input).stem().string();
        if (stem.ends_with(".subedit")) {
            stem.resize(stem.size() - std::string_view(".subedit").size());
        }
        return {stem, input};
    }
    return {input.substr(0, equals), input.substr(equals + 1)};
}

NamedProfile readProfile(const std::string& input, const glm::dvec2& texel) {
    const auto [label, file] = splitLabel(input);
    if (hasEnding(file, ".csv")) {
        const MeasuredProfile measured = readProfileCsv(file);
        return {label, measuredCurves(measured), measured.radiiMm.back(), {}};
    }
    const MaterialMap map = readMaterial(findMaterial(file));
    const auto index = [](double t, int size) {
        return std::min(static_cast<int>(t * size), size - 1);
    };
    return {label,
            storedCurves(map, index(texel.x, map.width), index(texel.y, map.height)),
            static_cast<double>(map.maxRadiusMm),
            {}};
}

void takeChannels(const Argument& argument, std::array<bool, 3>& channels) {
    channels = {false, false, false};
    for (const char letter : parseText(argument)) {
        const std::size_t index = std::string_view("rgb").find(letter);
        if (index == std::string_view::npos) {
            throw UsageError(fmt::format("{} '{}'", argument.option, argument.text), "is unknown",
                             "give some of the letters r, g, b");
        }
        channels[index] = true;
    }
}

void runPlot(PlotOptions options) {
    if (options.inputs.empty()) {
        throw UsageError("profile plot", "no profile is given",
                         "name tables (.csv), materials (.subedit.exr) or shipped materials");
    }
    if (options.output.empty()) {
        throw UsageError("profile plot", "-o is missing", "name the .png or .svg to write");
    }
    checkOutput(options.output, {".png", ".svg"});
    if (options.figure.fromRadiusMm && options.figure.toRadiusMm &&
        *options.figure.fromRadiusMm >= *options.figure.toRadiusMm) {
        throw UsageError("--from", "is not below --to");
    }
    options.figure.showsEnergy = !options.hidesEnergy;
    std::vector<NamedProfile> profiles;
    for (const std::string& input : options.inputs) {
        profiles.push_back(readProfile(input, options.texel));
    }
    if (options.figure.title.empty() && profiles.size() == 1) {
        options.figure.title = profiles.front().name;
    }
    plot::writePlot(options.output, drawProfiles(profiles, options.figure));
}

} // namespace

Command addProfilePlot(CLI::App& profile) {
    const auto options = std::make_shared<PlotOptions>();
    PlotOptions& o = *options;
    CLI::App* plot = profile.add_subcommand(
        "plot", "Draws profiles on a logarithmic scale, with energies and effective radii");
    addPositionals(*plot, "PROFILE",
                   "FILE.csv, FILE.subedit.exr or a shipped material; LABEL=FILE names its curve",
                   o.inputs);
    const char* group = "Figure";
    addOption(*plot, "-o,--output", {group, "FILE", "FILE.png or FILE.svg"}, takeText(o.output));
    addOption(*plot, "--energy",
              {group, "F",
               fmt::format("Energy that the effective radius holds; default {}", o.figure.energy)},
              takeNumber(o.figure.energy, {0.01, 1.0, false}));
    addOption(*plot, "--channels", {group, "rgb", "Which of the channels are drawn; default rgb"},
              [&o](const Argument& argument) { takeChannels(argument, o.figure.channels); });
    addOption(*plot, "--from", {group, "MM", "Smallest radius drawn"},
              takeNumber(o.figure.fromRadiusMm, {0.0, 1e6, true}));
    addOption(*plot, "--to", {group, "MM", "Largest radius drawn; default: where the longest ends"},
              takeNumber(o.figure.toRadiusMm, {1e-6, 1e6, false}));
    addFlag(*plot, "--log-radius", group, "Logarithmic radii as well", o.figure.isLogRadius);
    addFlag(*plot, "--ratio", group, "Adds a panel of all profiles relative to the first",
            o.figure.showsRatio);
    addFlag(*plot, "--no-energy", group, "Leaves out the panel of energies", o.hidesEnergy);
    addOption(*plot, "--uv", {group, "U,V", "Which texel of a material; default 0.5,0.5"},
              [&o](const Argument& argument) {
                  const std::size_t comma = argument.text.find(',');
                  const NumberRange unit{0.0, 1.0, false};
                  if (comma == std::string::npos) {
                      throw UsageError(fmt::format("--uv '{}'", argument.text),
                                       "is not U,V, each from 0 to 1");
                  }
                  o.texel = {parseNumber({"--uv", argument.text.substr(0, comma)}, unit),
                             parseNumber({"--uv", argument.text.substr(comma + 1)}, unit)};
              });
    addOption(*plot, "--title", {group, "TEXT", "Over the first panel"}, takeText(o.figure.title));
    return {plot, [options] { runPlot(*options); }};
}

} // namespace celadon::app
