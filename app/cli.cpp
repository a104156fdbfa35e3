#include "app/cli.h"

#include "app/command.h"
#include "app/command_bench.h"
#include "app/command_compare.h"
#include "app/command_edit.h"
#include "app/command_info.h"
#include "app/command_material.h"
#include "app/command_profile.h"
#include "app/command_render.h"
#include "app/log.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
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

/// "celadon profile make"
std::string fullName(const CLI::App& app) {
    const CLI::App* parent = app.get_parent();
    return parent == nullptr ? app.get_name() : fullName(*parent) + ' ' + app.get_name();
}

std::string helpRemedy(const CLI::App& app) {
    return fmt::format("see '{} --help'", fullName(app));
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

std::vector<std::string> commandNames(const std::vector<Command>& commands) {
    std::vector<std::string> names;
    for (const Command& command : commands) {
        names.push_back(command.options->get_name());
    }
    return names;
}

/// The first word that nothing took, if any, becomes an error that names it.
void refuseLeftOver(const CLI::App& app, const std::vector<Command>& subcommands) {
    std::vector<std::string> rest = app.remaining();
    // After "--", which CLI11 leaves over as well, no word is an option or a command.
    const auto marker = std::find(rest.begin(), rest.end(), "--");
    const bool isMarked = marker != rest.end();
    const auto plain = isMarked ? rest.erase(marker) : marker;
    if (rest.empty()) {
        return;
    }
    // An unknown option explains the words after it better than the other way round.
    const auto found = std::find_if(rest.begin(), plain, [](const std::string& word) {
        return word.starts_with('-') && word != "-";
    });
    const bool isOption = found != plain;
    const bool isPlain = isMarked && !isOption;
    const bool isCommand = !subcommands.empty() && !isOption && !isPlain;
    const std::string full = isOption ? *found : rest.front();
    const std::string word = isOption ? full.substr(0, full.find('=')) : full;
    const std::string near =
        isPlain ? "" : closest(word, isCommand ? commandNames(subcommands) : optionNames(app));
    const std::string suggestion = near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
    const char* what = isOption    ? "unknown option"
                       : isCommand ? "unknown command"
                                   : "unexpected argument";
    throw UsageError(fmt::format("'{}'", word), what, suggestion + helpRemedy(app));
}

/// What all commands have in common, at every depth.
void addCommonOptions(const Command& command, bool& verbose) {
    CLI::App& app = *command.options;
    app.group("Commands")->allow_extras(); // unknown words are refused here, in our words
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    app.set_help_flag("-h,--help", "Shows this help")->group("General");
    if (command.subcommands.empty()) {
        addFlag(app, "--verbose", "General", "Tells on stderr what is being done and chosen",
                verbose);
    } else {
        app.footer(
            fmt::format("'{} COMMAND --help' lists the options of a command.", fullName(app)));
    }
    for (const Command& subcommand : command.subcommands) {
        addCommonOptions(subcommand, verbose);
    }
}

/// The command that was named, looked for from `command` down.
const Command& chosenCommand(const Command& command) {
    const auto chosen =
        std::find_if(command.subcommands.begin(), command.subcommands.end(),
                     [](const Command& subcommand) { return subcommand.options->parsed(); });
    const bool isNamed = chosen != command.subcommands.end();
    // The innermost command explains what it does not know; those around it come after.
    const Command& result = isNamed ? chosenCommand(*chosen) : command;
    refuseLeftOver(*command.options, command.subcommands);
    return result;
}

const CLI::App& innermostParsed(const CLI::App& app) {
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    return parsed.empty() ? app : innermostParsed(*parsed.front());
}

} // namespace

int runCommandLine(int argc, const char* const* argv) {
    CLI::App app(kDescription, "celadon");
    bool verbose = false;
    const Command root{&app,
                       {},
                       {addEditCommand(app), addRenderCommand(app), addProfileCommand(app),
                        addMaterialCommand(app), addCompareCommand(app), addBenchCommand(app),
                        addInfoCommand(app)}};
    addCommonOptions(root, verbose);
    app.set_version_flag("--version", "celadon " CELADON_VERSION, "Shows the version")
        ->group("General");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(helpText(app).c_str(), stdout);
        return 0;
    } catch (const CLI::CallForVersion& version) {
        std::puts(version.what());
        return 0;
    } catch (const CLI::ParseError& error) {
        throw misunderstood(error, innermostParsed(app));
    }

    const Command& chosen = chosenCommand(root);
    if (!chosen.run) {
        throw UsageError(
            &chosen == &root ? "command line" : fullName(*chosen.options), "no command is given",
            fmt::format("choose {}; {}", fmt::join(commandNames(chosen.subcommands), ", "),
                        helpRemedy(*chosen.options)));
    }
    log::setVerbose(verbose);
    chosen.run();
    return 0;
}

} // namespace celadon::app
