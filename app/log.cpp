#include "app/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <string>
#include <unistd.h>

namespace celadon::app::log {
namespace {

/// On a terminal a message first wipes the progress line that may stand there.
spdlog::logger& logger() {
    static const std::shared_ptr<spdlog::logger> instance = [] {
        auto created = std::make_shared<spdlog::logger>(
            "celadon", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        created->set_pattern(::isatty(STDERR_FILENO) != 0 ? "\r\x1b[Kceladon: %l: %v"
                                                          : "celadon: %l: %v");
        created->set_level(spdlog::level::warn);
        return created;
    }();
    return *instance;
}

spdlog::level::level_enum spdlogLevel(Level level) {
    switch (level) {
    case Level::Debug:
        return spdlog::level::debug;
    case Level::Info:
        return spdlog::level::info;
    case Level::Warning:
        return spdlog::level::warn;
    case Level::Error:
        break;
    }
    return spdlog::level::err;
}

} // namespace

void setVerbose(bool verbose) {
    logger().set_level(verbose ? spdlog::level::debug : spdlog::level::warn);
}

void write(Level level, std::string_view message) {
    std::string line(message);
    std::replace(line.begin(), line.end(), '\n', ' ');
    logger().log(spdlogLevel(level), line);
}

} // namespace celadon::app::log
