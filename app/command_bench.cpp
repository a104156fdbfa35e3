#include "app/command_bench.h"

#include "app/bench/bench_report.h"
#include "app/log.h"
#include "app/option_takers.h"
#include "app/progress.h"
#include "renderer/output/atomic_file.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace celadon::app {

namespace {

struct BenchCommand {
    BenchOptions bench;
    gl::ContextKind context = gl::ContextKind::Auto;
    std::optional<std::filesystem::path> output, plots;
    bool table = false;
};

constexpr glm::ivec2 kPaperSize(800, 600);
constexpr glm::ivec2 kPaperTruthSize(240, 180);

void run(BenchCommand command) {
    const std::vector<BenchScene> scenes = benchScenes(command.bench.suite);
    if (command.bench.suite == "table1") {
        command.bench.size = kPaperSize;
        command.bench.truthSize = kPaperTruthSize;
    }
    if (command.output) {
        checkWritable(*command.output);
    }
    const std::unique_ptr<gl::Context> context = gl::createContext(command.context);
    BenchReport report{command.bench,       gl::contextKindName(context->kind()),
                       context->renderer(), context->version(),
                       describeProcessor(), {}};
    Progress progress("scenes", scenes.size());
    for (const BenchScene& scene : scenes) {
        report.scenes.push_back(runScene(*context, scene, command.bench));
        if (report.scenes.back().isStandIn) {
            log::warning("{}: no '{}' below the folder that CELADON_MODELS names; '{}' stands in",
                         scene.name, scene.model, report.scenes.back().model);
        }
        progress.update(report.scenes.size());
    }
    const std::string json = toJson(report);
    if (command.output) {
        writeFileAtomically(*command.output, std::string_view(json));
    }
    if (command.plots) {
        writePlots(report, *command.plots);
    }
    if (command.table) {
        std::fputs(toMarkdown(report).c_str(), stdout);
    } else if (!command.output) {
        std::fputs(json.c_str(), stdout);
    }
}

} // namespace

Command addBenchCommand(CLI::App& root) {
    const auto command = std::make_shared<BenchCommand>();
    BenchCommand& c = *command;
    CLI::App* app =
        root.add_subcommand("bench", "Measures speed and quality, side by side in one run");
    const char* what = "What is measured";
    addOption(
        *app, "--suite",
        {what, "quick|table1",
         "Builtins in under two minutes, or the scenes of Chen et al. 2012, Table 1, with the "
         "models of the folder that CELADON_MODELS names; default quick"},
        [&c](const Argument& a) { c.bench.suite = parseText(a); });
    addOption(*app, "--repeats", {what, "N", "Frames a fast method; the median counts; default 5"},
              takeInteger(c.bench.repeats, 1, 1000));
    addFlag(*app, "--surface-truth", what,
            "Errors against the integral over the surface too, which takes minutes",
            c.bench.surfaceTruth);
    addFlag(*app, "--fast-only", what,
            "Leaves out the columns of the paper, which take minutes; no speed-ups then",
            c.bench.slowMethods, false);
    addOption(*app, "--context", {what, "auto|glfw|egl|osmesa", "OpenGL context; default auto"},
              [&c](const Argument& a) { c.context = gl::parseContextKind(a.text); });
    const char* results = "Results";
    addOption(*app, "-o,--output", {results, "FILE", "JSON into a file, not to stdout"},
              [&c](const Argument& a) { c.output = parsePath(a); });
    addOption(*app, "--plot", {results, "DIR", "Charts into this folder, as SVG"},
              [&c](const Argument& a) { c.plots = parsePath(a); });
    addFlag(*app, "--table", results, "The table as Markdown on stdout", c.table);
    return {app, [command] { run(*command); }};
}

} // namespace celadon::app
