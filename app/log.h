#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

/// Messages for the person at the terminal, on stderr: stdout holds results only. Warnings and
/// errors always, the rest with --verbose. Libraries below app/ never print.
namespace celadon::app::log {

enum class Level {
    Debug,   ///< for diagnosis
    Info,    ///< milestones
    Warning, ///< unexpected, but going on
    Error    ///< something the user asked for did not happen
};

/// Lets debug and info through.
void setVerbose(bool verbose);

/// One message, one line: line breaks in it become spaces.
void write(Level level, std::string_view message);

template<typename... Args>
void debug(fmt::format_string<Args...> format, Args&&... args) {
    write(Level::Debug, fmt::format(format, std::forward<Args>(args)...));
}

template<typename... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
    write(Level::Info, fmt::format(format, std::forward<Args>(args)...));
}

template<typename... Args>
void warning(fmt::format_string<Args...> format, Args&&... args) {
    write(Level::Warning, fmt::format(format, std::forward<Args>(args)...));
}

template<typename... Args>
void error(fmt::format_string<Args...> format, Args&&... args) {
    write(Level::Error, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace celadon::app::log
