#include "ui/journal.h"

#include "subedit/errors.h"
#include "ui/recorder.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <unistd.h>

namespace celadon::ui {

namespace {

constexpr const char* kHeader = "journal";
constexpr const char* kSuffix = ".journal";

/// "1234.journal" of a process that runs still.
bool belongsToLiving(const std::filesystem::path& file) {
    const std::string name = file.stem().string();
    int process = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (error != std::errc() || end != name.data() + name.size() || process <= 0) {
        return false;
    }
    return ::kill(process, 0) == 0 || errno == EPERM;
}

} // namespace

bool changesMaterial(const Command& command) {
    return command.name == "paint.edit" || command.name == "edit.undo" ||
           command.name == "edit.redo" || command.name == "material.activate";
}

Journal::Journal(std::filesystem::path folder) : mFolder(std::move(folder)) {}

Journal::~Journal() = default;

void Journal::begin(const OpenRequest& opened) {
    finish();
    mOpened = opened;
}

std::optional<std::string> Journal::add(const Command& command) {
    if (!changesMaterial(command) || mHasFailed) {
        return std::nullopt;
    }
    if (!mStream.is_open()) {
        std::error_code failed;
        std::filesystem::create_directories(mFolder, failed);
        mFile = mFolder / fmt::format("{}{}", ::getpid(), kSuffix);
        mStream.open(mFile, std::ios::trunc);
        mStream << formatCommand(
                       {kHeader, {{"model", mOpened.model}, {"material", mOpened.material}}})
                << '\n';
    }
    mStream << formatCommand(command) << '\n' << std::flush;
    if (!mStream) {
        mHasFailed = true;
        return fmt::format("'{}' cannot be written: a crash would lose what is not saved",
                           mFile.string());
    }
    return std::nullopt;
}

void Journal::finish() {
    mStream = {};
    mHasFailed = false;
    if (!mFile.empty()) {
        std::error_code ignored;
        std::filesystem::remove(mFile, ignored);
        mFile.clear();
    }
}

std::optional<Recovery> findRecovery(const std::filesystem::path& folder) {
    std::error_code failed;
    std::optional<Recovery> latest;
    std::filesystem::file_time_type latestTime{};
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        const std::filesystem::path& file = entry.path();
        if (file.extension() != kSuffix || belongsToLiving(file)) {
            continue;
        }
        try {
            // The last line may be cut off in its middle: it is left out.
            std::vector<Command> commands = readCommands(file, Tail::MayBeCut);
            if (commands.empty() || commands.front().name != kHeader) {
                continue;
            }
            const Command header = commands.front();
            const Arguments arguments(header);
            commands.erase(commands.begin());
            const auto time = entry.last_write_time(failed);
            if (!commands.empty() && (!latest || time > latestTime)) {
                latest = Recovery{file,
                                  {arguments.text("model"), arguments.text("material")},
                                  std::move(commands)};
                latestTime = time;
            }
        } catch (const Error&) {
            continue;
        }
    }
    return latest;
}

} // namespace celadon::ui
