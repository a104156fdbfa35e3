#include "app/cli.h"

#include "app/command.h"
#include "app/command_compare.h"
#include "app/command_info.h"
#include "app/command_material.h"
#include "app/command_profile.h"
#include "app/command_render.h"
#include "app/log.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace celadon::app {
namespace {

constexpr const char* kDescription =
    "Celadon paints translucency: subsurface scattering by multiresolution splatting.";

/// Levenshtein's distance, for "did you mean".
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

std::string closest(std::string_view word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t bestDistance = word.size() / 3 + 1; // a third of the letters may be wrong
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance <= bestDistance && (best.empty() || distance < bestDistance)) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

std::string helpRemedy(const CLI::App& app) {
    const bool isCommand = app.get_parent() != nullptr;
    return fmt::format("see 'celadon {}--help'", isCommand ? app.get_name() + " " : "");
}

/// CLI11 leaves two blank lines between groups.
std::string helpText(const CLI::App& app) {
    return CLI::detail::find_and_replace(app.help(), "\n\n\n", "\n\n");
}

/// What CLI11 could not take apart, in our words where they are clearer.
UsageError misunderstood(const CLI::ParseError& error, const CLI::App& app) {
    const std::string text = error.what();
    const bool isMismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr;
    if (isMismatch && text.find("missing") != std::string::npos) {
        return {text.substr(0, text.find(':')), "its value is missing", helpRemedy(app)};
    }
    if (isMismatch && text.find("flag override") != std::string::npos) {
        return {"--" + text.substr(0, text.find(' ')), "takes no value", helpRemedy(app)};
    }
    return {"command line", text, helpRemedy(app)};
}

/// The first word that nothing took, if any, becomes an error that names it.
void refuseLeftOver(const CLI::App& app, const std::vector<std::string>& commandNames) {
    const std::vector<std::string> rest = app.remaining();
    if (rest.empty()) {
        return;
    }
    // An unknown option explains the words after it better than the other way round.
    const auto option = std::find_if(rest.begin(), rest.end(), [](const std::string& word) {
        return word.starts_with('-') && word != "-";
    });
    const bool isCommand = app.get_parent() == nullptr && option == rest.end();
    const std::string full = option != rest.end() ? *option : rest.front();
    const std::string word = option != rest.end() ? full.substr(0, full.find('=')) : full;
    const std::string near = closest(word, isCommand ? commandNames : optionNames(app));
    const std::string suggestion = near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
    const char* what = option != rest.end() ? "unknown option"
                       : isCommand          ? "unknown command"
                                            : "unexpected argument";
    throw UsageError(fmt::format("'{}'", word), what, suggestion + helpRemedy(app));
}

} // namespace

int runCommandLine(int argc, const char* const* argv) {
    CLI::App root(kDescription, "celadon");
    root.set_help_flag("-h,--help", "Shows this help");
    root.set_version_flag("--version", "celadon " CELADON_VERSION, "Shows the version");
    root.get_formatter()->label("SUBCOMMAND", "COMMAND");
    root.allow_extras();
    bool verbose = false;

    const std::array commands{addRenderCommand(root), addCompareCommand(root),
                              addInfoCommand(root)};
    std::vector<std::string> commandNames;
    for (const Command& command : commands) {
        commandNames.push_back(command.options->get_name());
        command.options->group("Commands")->allow_extras();
        command.options->set_help_flag("-h,--help", "Shows this help")->group("General");
        addFlag(*command.options, "--verbose", "General",
                "Tells on stderr what is being done and chosen", verbose);
    }

    root.footer("'celadon COMMAND --help' lists the options of a command.");
    root.allow_extras(false); // these two refuse unknown words themselves
    addProfileCommand(root);
    addMaterialCommand(root);
    root.allow_extras();
    try {
        root.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(helpText(root).c_str(), stdout);
        return 0;
    } catch (const CLI::CallForVersion& version) {
        std::puts(version.what());
        return 0;
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> parsed = root.get_subcommands();
        throw misunderstood(error, parsed.empty() ? root : *parsed.front());
    }

    const auto chosen = std::find_if(commands.begin(), commands.end(), [](const Command& command) {
        return command.options->parsed();
    });
    if (chosen != commands.end()) {
        refuseLeftOver(*chosen->options, commandNames);
    }
    if (root.got_subcommand("profile") || root.got_subcommand("material")) {
        return 0; // done while parsing
    }
    refuseLeftOver(root, commandNames);
    if (chosen == commands.end()) {
        std::fputs(helpText(root).c_str(), stderr);
        throw UsageError("command line", "no command is given",
                         fmt::format("choose {}", fmt::join(commandNames, ", ")));
    }
    log::setVerbose(verbose);
    chosen->run();
    return 0;
}

} // namespace celadon::app
