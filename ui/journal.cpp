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
constexpr const char* kKeptSuffix = ".kept.exr";

void removeFile(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
}

/// What Journal::keep() put aside, not a file of the user's.
void removeKept(const std::filesystem::path& folder, const std::string& material) {
    if (material.ends_with(kKeptSuffix) &&
        std::filesystem::path(material).parent_path() == folder) {
        removeFile(material);
    }
}

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

bool changesWork(const Command& command) {
    return command.name == "paint.edit" || command.name == "edit.undo" ||
           command.name == "edit.redo" || command.name == "material.activate" ||
           command.name == "motion.animation" ||
           (command.name.starts_with("deform.") && command.name != "deform.save");
}

Journal::Journal(std::filesystem::path folder) : mFolder(std::move(folder)) {}

Journal::~Journal() = default;

void Journal::begin(const OpenRequest& opened) {
    finish();
    mOpened = opened;
    // A later process may run in another folder. Names of builtins and shipped materials stay.
    for (std::string* name : {&mOpened.model, &mOpened.material}) {
        std::error_code failed;
        if (std::filesystem::exists(*name, failed)) {
            *name = std::filesystem::absolute(*name, failed).string();
        }
    }
}

std::optional<std::string> Journal::add(const Command& command) {
    if (!changesWork(command) || mHasFailed) {
        return std::nullopt;
    }
    if (!mStream.is_open()) {
        std::error_code failed;
        std::filesystem::create_directories(mFolder, failed);
        mFile = mFolder / fmt::format("{}{}", ::getpid(), kSuffix);
        mStream.open(mFile, std::ios::trunc);
        writeHeader();
    }
    write(command);
    if (!mStream) {
        mHasFailed = true;
        return fmt::format("'{}' cannot be written: a crash would lose what is not saved",
                           mFile.string());
    }
    return std::nullopt;
}

void Journal::write(const Command& command) {
    mStream << formatCommand(command) << '\n' << std::flush;
}

void Journal::writeHeader() {
    write({kHeader, {{"model", mOpened.model}, {"material", mOpened.material}}});
}

std::optional<std::string> Journal::keep(const std::filesystem::path& file) {
    std::error_code failed;
    if (!mStream.is_open() || !std::filesystem::equivalent(file, mOpened.material, failed)) {
        return std::nullopt;
    }
    std::filesystem::path kept;
    for (int number = 1; kept.empty() || std::filesystem::exists(kept, failed); ++number) {
        kept = mFolder / fmt::format("{}-{}{}", ::getpid(), number, kKeptSuffix);
    }
    // Saving puts another file in this one's place: a second name for it costs nothing.
    std::filesystem::create_hard_link(file, kept, failed);
    if (failed) {
        std::filesystem::copy_file(file, kept, failed);
    }
    if (failed) {
        return fmt::format("'{}' cannot be kept in '{}' ({}): after a crash, what was done before "
                           "this save would be done twice",
                           file.string(), mFolder.string(), failed.message());
    }
    mOpened.material = kept.string();
    writeHeader(); // the last one counts
    return std::nullopt;
}

void Journal::finish() {
    mStream = {};
    mHasFailed = false;
    if (!mFile.empty()) {
        removeFile(mFile);
        mFile.clear();
    }
    removeKept(mFolder, mOpened.material);
    mOpened = {};
}

void discard(const Recovery& recovery) {
    removeFile(recovery.file);
    removeKept(recovery.file.parent_path(), recovery.opened.material);
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
            OpenRequest opened;
            std::erase_if(commands, [&opened](const Command& command) {
                if (command.name != kHeader) {
                    return false;
                }
                const Arguments header(command);
                opened = {header.text("model"), header.text("material")};
                return true;
            });
            const auto time = entry.last_write_time(failed);
            if (!commands.empty() && (!latest || time > latestTime)) {
                latest = Recovery{file, std::move(opened), std::move(commands)};
                latestTime = time;
            }
        } catch (const Error&) {
            continue;
        }
    }
    return latest;
}

} // namespace celadon::ui
