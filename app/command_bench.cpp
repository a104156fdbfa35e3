#include "app/command_bench.h"

#include "app/bench/figures_suite.h"
#include "app/bench/scaling_suite.h"
#include "app/bench/table_report.h"
#include "app/bench/turntable_suite.h"
#include "app/log.h"
#include "app/option_takers.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "renderer/splatting/splatting_solver.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>

namespace celadon::app {

namespace {

constexpr std::array<std::string_view, 5> kSuites{"quick", "table1", "figures", "turntable",
                                                  "scaling"};
enum class Suite { Quick, Table1, Figures, Turntable, Scaling };

struct BenchCommand {
    Suite suite = Suite::Quick;
    std::vector<std::string> methods, scenes;
    std::vector<SplatBackendKind> backends;
    std::optional<int> repeats, truthBlocks;
    std::optional<glm::ivec2> size;
    bool surfaceTruth = false; ///< where it is not the default
    bool imageTruthOnly = false;
    bool modelError = false;
    bool fastOnly = false;
    gl::ContextKind context = gl::ContextKind::Auto;
    std::optional<std::filesystem::path> output, folder;
    bool table = false;
};

/// The scenes of a suite; those asked for, if some are.
std::vector<BenchScene> scenesOf(const BenchCommand& command) {
    const bool isQuick = command.suite == Suite::Quick;
    std::vector<BenchScene> all = benchScenes(isQuick ? "quick" : "table1");
    std::vector<std::string> wanted = command.scenes;
    if (wanted.empty() && command.suite == Suite::Figures) {
        wanted = {"bunny", "buddha", "elephant"};
    } else if (wanted.empty() && command.suite == Suite::Turntable) {
        wanted = {"bunny", "buddha"};
    }
    if (wanted.empty()) {
        return all;
    }
    std::vector<BenchScene> chosen;
    for (const std::string& name : wanted) {
        const auto found = std::ranges::find(all, name, &BenchScene::name);
        if (found == all.end()) {
            std::vector<std::string> names;
            for (const BenchScene& scene : all) {
                names.push_back(scene.name);
            }
            throw UsageError(fmt::format("--scenes '{}'", name), "the suite has no such scene",
                             fmt::format("choose of {}", fmt::join(names, ", ")));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

/// A scene whose model is absent is measured with a builtin in its place, and said.
void warnOfStandIns(const std::vector<BenchScene>& scenes) {
    for (const BenchScene& scene : scenes) {
        if (isModelMissing(scene)) {
            log::warning("{}: no '{}' {}; 'builtin:{}' stands in", scene.name, scene.model,
                         modelFolderMessage(), scene.standIn);
        }
    }
}

BenchDocument runTable(const gl::Context& context, const BenchCommand& command,
                       const std::vector<BenchScene>& scenes) {
    TableOptions options;
    options.suite = kSuites.at(static_cast<std::size_t>(command.suite));
    if (command.suite == Suite::Table1) {
        options.size = {800, 600}; // the paper's
        options.truthBlocks = 25;
    } else {
        options.surfaceTruth = command.surfaceTruth;
        options.size = {320, 240}; // all of it within two minutes on two cores
        options.budget.secondsAMethod = 2;
    }
    options.size = command.size.value_or(options.size);
    options.truthBlocks = command.truthBlocks.value_or(options.truthBlocks);
    options.surfaceTruth = options.surfaceTruth && !command.imageTruthOnly;
    options.modelError = command.modelError;
    options.budget.repeats = command.repeats.value_or(options.budget.repeats);
    options.methods = command.methods;
    if (command.fastOnly && options.methods.empty()) {
        options.methods = {"hierarchical", "draft", "final"};
    }
    options.backends = command.backends;
    Progress progress("scenes", scenes.size());
    std::vector<SceneResult> results;
    for (const BenchScene& scene : scenes) {
        results.push_back(runScene(context, scene, options));
        progress.update(results.size());
    }
    return tableDocument(describeMachine(context), options, results);
}

BenchDocument runSuite(const gl::Context& context, const BenchCommand& command,
                       const std::vector<BenchScene>& scenes) {
    switch (command.suite) {
    case Suite::Quick:
    case Suite::Table1:
        break;
    case Suite::Figures: {
        FiguresOptions options;
        options.size = command.size.value_or(options.size);
        options.backend = command.backends.front();
        options.budget.repeats = command.repeats.value_or(options.budget.repeats);
        return runFigures(context, scenes, options);
    }
    case Suite::Turntable: {
        TurntableOptions options;
        options.size = command.size.value_or(options.size);
        options.truthBlocks = command.truthBlocks.value_or(options.truthBlocks);
        options.surfaceTruth = !command.imageTruthOnly;
        options.pictures = command.folder.has_value();
        return runTurntable(context, scenes, options);
    }
    case Suite::Scaling: {
        ScalingOptions options;
        options.size = command.size.value_or(options.size);
        options.backend = command.backends.front();
        options.budget.repeats = command.repeats.value_or(options.budget.repeats);
        return runScaling(context, options);
    }
    }
    return runTable(context, command, scenes);
}

void run(BenchCommand command) {
    const std::vector<BenchScene> scenes = scenesOf(command);
    if (command.output) {
        checkWritable(*command.output);
    }
    if (command.suite != Suite::Scaling) {
        warnOfStandIns(scenes);
    }
    const std::unique_ptr<gl::Context> context = gl::createContext(command.context);
    if (command.backends.empty()) {
        command.backends = {SplatBackendKind::Auto};
    }
    for (SplatBackendKind& backend : command.backends) {
        backend = resolveBackend(backend, *context);
    }
    const BenchDocument document = runSuite(*context, command, scenes);
    const std::string json =
        document.json.dump(2, ' ', false, BenchJson::error_handler_t::replace) + "\n";
    if (command.output) {
        writeFileAtomically(*command.output, std::string_view(json));
    }
    if (command.folder) {
        writeFolder(document, *command.folder);
    }
    if (command.table) {
        std::fputs(document.markdown.c_str(), stdout);
    } else if (!command.output) {
        std::fputs(json.c_str(), stdout);
    }
}

/// "a,b" into the list.
void takeWords(std::vector<std::string>& list, const Argument& argument) {
    const std::string text = parseText(argument) + ",";
    for (std::size_t start = 0, comma = 0; start < text.size(); start = comma + 1) {
        comma = text.find(',', start);
        list.push_back(text.substr(start, comma - start));
    }
}

void takeBackends(std::vector<SplatBackendKind>& list, const Argument& argument) {
    std::vector<std::string> words;
    takeWords(words, argument);
    for (const std::string& word : words) {
        list.push_back(parseBackend({argument.option, word}));
    }
}

void takeMethods(std::vector<std::string>& list, const Argument& argument) {
    takeWords(list, argument);
    std::vector<std::string> known;
    for (const BenchMethod& method : benchMethods()) {
        known.push_back(method.name);
    }
    for (const std::string& name : list) {
        if (std::ranges::find(known, name) == known.end()) {
            throw UsageError(fmt::format("{} '{}'", argument.option, name), "is no method",
                             fmt::format("choose of {}", fmt::join(known, ", ")));
        }
    }
}

} // namespace

Command addBenchCommand(CLI::App& root) {
    const auto command = std::make_shared<BenchCommand>();
    BenchCommand& c = *command;
    CLI::App* app =
        root.add_subcommand("bench", "Measures speed and quality, side by side in one run");
    const char* what = "What is measured";
    addOption(*app, "--suite",
              {what, "NAME",
               "quick: builtins, in under two minutes\n"
               "table1: the scenes of Chen et al. 2012, Table 1, with the models of the folder "
               "that CELADON_MODELS names\n"
               "figures: its Figs. 4 to 6 and a slab of two materials, as pictures\n"
               "turntable: a light that goes around, and flicker beyond truth\n"
               "scaling: exponents of cost over range, pixels, texels, triangles\n"
               "Default quick"},
              takeChoice(c.suite, kSuites));
    addOption(*app, "--scenes", {what, "NAME[,NAME...]", "Some of the suite's scenes; default all"},
              [&c](const Argument& a) { takeWords(c.scenes, a); });
    addOption(*app, "--methods",
              {what, "NAME[,NAME...]",
               "table1, quick: none, multires, adaptive, paper (the columns of Table 1), "
               "hierarchical, draft, final; default all"},
              [&c](const Argument& a) { takeMethods(c.methods, a); });
    addOption(*app, "--backend",
              {what, "auto|raster|cpu[,...]",
               "What splats; speed-ups are over 'none' by the same one. table1, quick: one after "
               "the other; else the first. Default auto"},
              [&c](const Argument& a) { takeBackends(c.backends, a); });
    addOption(*app, "--size", {what, "WxH", "Of the frames; default 800x600 (table1), else less"},
              [&c](const Argument& a) { c.size = parseSize(a, 4096, 1LL << 24); });
    addOption(*app, "--repeats",
              {what, "N", "Frames at most, of which the median counts; slow ones once; default 5"},
              [&c](const Argument& a) { c.repeats = parseInteger(a, 1, 1000); });
    addOption(*app, "--truth-blocks",
              {what, "N",
               "Truth on one in N of the picture's blocks of 8x8 pixels; FLIP needs 1; default 25 "
               "(table1), 4 (turntable), 1 (quick)"},
              [&c](const Argument& a) { c.truthBlocks = parseInteger(a, 1, 10000); });
    addFlag(*app, "--surface-truth", what,
            "quick: errors against the integral over the surface too; table1 and turntable have "
            "them anyway",
            c.surfaceTruth);
    addFlag(*app, "--no-surface-truth", what,
            "Errors against image-reference only, which is quicker", c.imageTruthOnly);
    addFlag(*app, "--model-error", what,
            "table1, quick: surface-reference against light traced in a homogeneous medium, which "
            "takes minutes",
            c.modelError);
    addFlag(*app, "--fast-only", what,
            "Leaves out the columns of the paper, which take minutes; no speed-ups then",
            c.fastOnly);
    addOption(*app, "--context", {what, "auto|glfw|egl|osmesa", "OpenGL context; default auto"},
              [&c](const Argument& a) { c.context = gl::parseContextKind(a.text); });
    const char* results = "Results";
    addOption(*app, "-o,--output", {results, "FILE", "JSON into a file, not to stdout"},
              [&c](const Argument& a) { c.output = parsePath(a); });
    addOption(*app, "--plot", {results, "DIR", "Charts (SVG) and pictures (PNG) into this folder"},
              [&c](const Argument& a) { c.folder = parsePath(a); });
    addFlag(*app, "--table", results, "The table as Markdown on stdout", c.table);
    return {app, [command] { run(*command); }};
}

} // namespace celadon::app
