#include "ui/recorder.h"

#include "subedit/errors.h"

#include <fmt/format.h>

namespace celadon::ui {

Recorder::Recorder(const std::filesystem::path& file)
    : mFile(file), mStream(file, std::ios::trunc) {
    if (!mStream) {
        throw OutputError(fmt::format("'{}'", file.string()), "cannot be written",
                          "choose another file to record to");
    }
}

void Recorder::write(const Command& command) {
    mStream << formatCommand(command) << '\n' << std::flush;
    if (!mStream && !mHasFailed) {
        mHasFailed = true;
        throw OutputError(fmt::format("'{}'", mFile.string()), "cannot be written",
                          "the record ends here: make room and begin another");
    }
}

std::vector<Command> readCommands(const std::filesystem::path& file, Tail tail) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file)) {
        throw InputError(fmt::format("'{}'", file.string()), "cannot be opened");
    }
    std::vector<Command> commands;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        if (line.empty() || line.front() == '#' || line == "\r") {
            continue;
        }
        try {
            commands.push_back(parseCommand(line));
        } catch (const Error& error) {
            if (tail == Tail::MayBeCut && stream.peek() == std::ifstream::traits_type::eof()) {
                break;
            }
            throw InputError(fmt::format("'{}', line {}", file.string(), number), error.what(),
                             "a replay is one JSON object a line, as --record writes it");
        }
    }
    return commands;
}

} // namespace celadon::ui
