#include "app/command.h"

#include <CLI/CLI.hpp>

#include <algorithm>
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

/// Help is set in lines that fit beside the option names on a terminal of 100 columns; CLI11
/// indents what follows a line break. Line breaks in the text stay.
std::string wrap(const std::string& help) {
    constexpr std::size_t kColumns = 68;
    std::string result;
    std::size_t lineLength = 0;
    for (std::size_t begin = 0; begin < help.size();) {
        const std::size_t end = std::min(help.find_first_of(" \n", begin), help.size());
        const std::size_t length = end - begin;
        if (lineLength > 0) {
            const bool fits = help[begin - 1] == ' ' && lineLength + 1 + length <= kColumns;
            result += fits ? ' ' : '\n';
            lineLength = fits ? lineLength + 1 : 0;
        }
        result.append(help, begin, length);
        lineLength += length;
        begin = end + 1;
    }
    return result;
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
        wrap(text.help));
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
        wrap(text.help));
    // One value an occurrence: what follows belongs to something else.
    return decorate(option, text)->allow_extra_args(false);
}

CLI::Option* addFlag(CLI::App& app, const std::string& name, const std::string& group,
                     const std::string& help, bool& flag, bool value) {
    return app
        .add_flag_callback(
            name, [&flag, value] { flag = value; }, wrap(help))
        ->disable_flag_override()
        ->group(group);
}

CLI::Option* addPositional(CLI::App& app, const std::string& name, const std::string& help,
                           std::string& text) {
    return app.add_option(name, text, wrap(help))->option_text(" ");
}

CLI::Option* addPositionals(CLI::App& app, const std::string& name, const std::string& help,
                            std::vector<std::string>& texts) {
    return app.add_option(name, texts, wrap(help))->option_text(" ...");
}

} // namespace celadon::app
