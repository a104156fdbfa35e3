#include "app/option_takers.h"
#include "app/overwriting.h"
#include "app/plot/chart.h"
#include "app/plot/write_plot.h"
#include "app/profile/profile_commands.h"
#include "app/profile/profile_output.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/map/range_table_file.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/radius_map.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <filesystem>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

struct TableOptions {
    std::vector<std::string> materials;
    double epsilon = 0.01;
    double energy = 0.95;
    double fromT = 1.0;
    double toT = std::exp2(kRangeTableMaxLog2);
    int entriesPerOctave = kRangeTableEntriesPerOctave;
    std::string output;
};

/// One material's mean profile, and the mean of several, each of which counts alike whatever its
/// number of texels.
MeanProfile meanOfMaterials(const std::vector<std::string>& materials, double energy) {
    std::vector<double> sum;
    for (const std::string& name : materials) {
        const MaterialMap map = readMaterial(findMaterial(name));
        const MeanProfile mean = meanProfile(map, effectiveRadiusMap(map, energy));
        sum.resize(mean.samples().size(), 0.0);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += mean.samples()[i];
        }
    }
    return MeanProfile(std::move(sum));
}

TableFile makeTable(const TableOptions& options) {
    const MeanProfile mean = meanOfMaterials(options.materials, options.energy);
    TableFile table;
    table.epsilon = options.epsilon;
    table.energy = options.energy;
    for (std::size_t i = 0; i < mean.samples().size(); ++i) {
        table.r.push_back(static_cast<double>(i) / static_cast<double>(mean.samples().size() - 1));
        table.meanProfile.push_back(mean.samples()[i]);
    }
    const double octaves = std::log2(options.toT / options.fromT);
    const int entries =
        std::max(1, static_cast<int>(std::lround(octaves * options.entriesPerOctave)));
    for (int i = 0; i <= entries; ++i) {
        table.T.push_back(options.fromT * std::exp2(octaves * i / entries));
    }
    table.minimalRadius.resize(table.T.size());
    tbb::parallel_for(std::size_t{0}, table.T.size(), [&](std::size_t i) {
        table.minimalRadius[i] = minimalRadius(mean, table.T[i], options.epsilon);
    });
    return table;
}

plot::Drawing drawTable(const TableOptions& options, const TableFile& table) {
    std::string names;
    for (const std::string& material : options.materials) {
        names +=
            (names.empty() ? "" : ", ") + std::filesystem::path(material).stem().stem().string();
    }
    plot::LineChart profile{fmt::format("Mean profile of {}", names),
                            {"r / Rₚ", false, 0.0, 1.0},
                            {"mean profile, integral of P r dr = 1", true},
                            {}};
    plot::Series mean{"", {}, plot::seriesColor(1)};
    for (std::size_t i = 0; i < table.r.size(); ++i) {
        mean.points.emplace_back(table.r[i], table.meanProfile[i]);
    }
    profile.series.push_back(mean);
    plot::LineChart radius{
        fmt::format("Minimal radius, ε = {:g}, energy {:g}", options.epsilon, options.energy),
        {"T, pixels per Rₚ", true, table.T.front(), table.T.back()},
        {"minimal effective rendering radius / Rₚ", false, 0.0, 1.0},
        {}};
    plot::Series series{"", {}, plot::seriesColor(2)};
    for (std::size_t i = 0; i < table.T.size(); ++i) {
        series.points.emplace_back(table.T[i], table.minimalRadius[i]);
    }
    radius.series.push_back(series);
    return plot::placeBeside({drawChart(profile), drawChart(radius)});
}

void runTable(const TableOptions& options) {
    if (options.materials.empty()) {
        throw UsageError("profile table", "no material is given",
                         "name files or shipped materials");
    }
    if (options.fromT >= options.toT) {
        throw UsageError("--t-range", "does not rise", "give FROM:TO, such as 1:4096");
    }
    checkOutput(options.output, {".csv", ".exr", ".png", ".svg"});
    std::vector<NamedFile> materials;
    for (const std::string& material : options.materials) {
        materials.push_back({"a material", findMaterial(material)});
    }
    refuseOverwriting({{"--output", options.output}}, materials);
    const TableFile table = makeTable(options);
    if (options.output.empty() || hasEnding(options.output, ".csv")) {
        emit(options.output, tableCsv(table));
    } else if (plot::isPlotFile(options.output)) {
        plot::writePlot(options.output, drawTable(options, table));
    } else {
        writeTableExr(table, options.output);
    }
}

void takeRange(const Argument& argument, TableOptions& options) {
    const std::size_t colon = argument.text.find(':');
    if (colon == std::string::npos) {
        throw UsageError(fmt::format("{} '{}'", argument.option, argument.text), "is no range",
                         "give FROM:TO, such as 1:4096");
    }
    const NumberRange range{1.0, 1e6, false};
    options.fromT = parseNumber({argument.option, argument.text.substr(0, colon)}, range);
    options.toT = parseNumber({argument.option, argument.text.substr(colon + 1)}, range);
}

} // namespace

Command addProfileTable(CLI::App& profile) {
    const auto options = std::make_shared<TableOptions>();
    TableOptions& o = *options;
    CLI::App* table = profile.add_subcommand(
        "table", "Computes the mean profile and the minimal rendering radii of materials");
    addPositionals(*table, "MATERIAL",
                   "A .subedit.exr file, or the name of a shipped material; of several, each "
                   "counts alike",
                   o.materials);
    const char* group = "Table";
    addOption(*table, "--epsilon",
              {group, "E", fmt::format("Error allowed in a ring's energy; default {}", o.epsilon)},
              takeNumber(o.epsilon, {1e-6, 1.0, false}));
    addOption(
        *table, "--energy",
        {group, "F", fmt::format("Energy that the effective radius holds; default {}", o.energy)},
        takeNumber(o.energy, {0.01, 1.0, false}));
    addOption(*table, "--t-range",
              {group, "FROM:TO", "Pixels per effective radius; default 1:4096"},
              [&o](const Argument& argument) { takeRange(argument, o); });
    addOption(*table, "--entries-per-octave",
              {group, "N", fmt::format("Rows a doubling of T; default {}", o.entriesPerOctave)},
              takeInteger(o.entriesPerOctave, 1, 1000));
    addOption(*table, "-o,--output",
              {group, "FILE",
               "FILE.csv, FILE.exr (both for render --table), FILE.png or .svg (a plot); default: "
               "CSV on stdout"},
              takeText(o.output));
    return {table, [options] { runTable(*options); }};
}

} // namespace celadon::app
