#pragma once

#include "app/argument.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

/// What a command of the program is: options that it registers, and what it does once the whole
/// command line has been understood.
namespace celadon::app {

struct Command {
    CLI::App* options = nullptr;
    std::function<void()> run = {};        ///< throws celadon::Error
    std::vector<Command> subcommands = {}; ///< one of which is then to be named, instead of `run`
};

/// How an option appears in the help.
struct OptionText {
    std::string group; ///< heading
    std::string value; ///< "WxH"
    std::string help;  ///< unit and default included
};

/// An option with a value; of several the last one counts. `take` may throw UsageError.
CLI::Option* addOption(CLI::App& app, const std::string& names, const OptionText& text,
                       std::function<void(const Argument&)> take);

/// An option that may be repeated; `take` is called for each, in order.
CLI::Option* addRepeatable(CLI::App& app, const std::string& names, const OptionText& text,
                           std::function<void(const Argument&)> take);

/// A word on its own, which sets `flag` to `value`.
CLI::Option* addFlag(CLI::App& app, const std::string& name, const std::string& group,
                     const std::string& help, bool& flag, bool value = true);

/// A positional; whether it is needed is for the command to say.
CLI::Option* addPositional(CLI::App& app, const std::string& name, const std::string& help,
                           std::string& text);

/// Any number of positionals.
CLI::Option* addPositionals(CLI::App& app, const std::string& name, const std::string& help,
                            std::vector<std::string>& texts);

} // namespace celadon::app
