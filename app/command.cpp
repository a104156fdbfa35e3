#include "app/command.h"

#include <CLI/CLI.hpp>

#include <utility>
#include <vector>

namespace celadon::app {
namespace {

/// "--output" for "-o,--output": what messages call an option.
std::string spokenName(const std::string& names) {
    const std::size_t longName = names.find("--");
    return longName == std::string::npos ? names
                                         : names.substr(longName, names.find(',', longName));
}

CLI::Option* decorate(CLI::Option* option, const OptionText& text) {
    return option->group(text.group)->option_text(text.value);
}

} // namespace

CLI::Option* addOption(CLI::App& app, const std::string& names, const OptionText& text,
                       std::function<void(const Argument&)> take) {
    const std::string name = spokenName(names);
    CLI::Option* option = app.add_option_function<std::string>(
        names,
        [name, take = std::move(take)](const std::string& value) {
            take({name, value});
        },
        text.help);
    return decorate(option, text)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

CLI::Option* addRepeatable(CLI::App& app, const std::string& names, const OptionText& text,
                           std::function<void(const Argument&)> take) {
    const std::string name = spokenName(names);
    CLI::Option* option = app.add_option_function<std::vector<std::string>>(
        names,
        [name, take = std::move(take)](const std::vector<std::string>& values) {
            for (const std::string& value : values) {
                take({name, value});
            }
        },
        text.help);
    // One value an occurrence: what follows belongs to something else.
    return decorate(option, text)->allow_extra_args(false);
}

CLI::Option* addFlag(CLI::App& app, const std::string& names, const std::string& group,
                     const std::string& help, bool& flag) {
    return app.add_flag(names, flag, help)->group(group);
}

CLI::Option* addPositional(CLI::App& app, const std::string& name, const std::string& help,
                           std::string& text) {
    return app.add_option(name, text, help)->option_text(" ");
}

} // namespace celadon::app
