#include "ui/journal.h"

#include "subedit/errors.h"
#include "ui/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <unistd.h>

namespace celadon::ui {

namespace {

constexpr const char* kHeader = "journal";
constexpr const char* kKept = "journal.kept"; ///< a file that was replaced, and where it is now
constexpr const char* kReason = "journal.reason";
constexpr const char* kSuffix = ".journal";
constexpr const char* kKeptSuffix = ".kept.exr";

void removeFile(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
}

/// What Journal::keep() put aside, and no file of the user's, whatever a journal says.
void removeKept(const std::filesystem::path& folder, const OpenRequest& opened) {
    for (const auto& [file, kept] : opened.readInstead) {
        if (kept.parent_path() == folder && kept.string().ends_with(kKeptSuffix)) {
            removeFile(kept);
        }
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
    const bool undoes = command.name == "edit.undo" || command.name == "edit.redo";
    return command.name == "paint.edit" || command.name == "material.activate" ||
           command.name == "scene.size" || (undoes && !command.arguments.value("setting", false)) ||
           command.name == "motion.animation" ||
           (command.name.starts_with("deform.") && command.name != "deform.save");
}

bool continuesStep(const Command& command) {
    const auto found = command.arguments.find("continues");
    return found != command.arguments.end() && *found == true;
}

std::size_t Recovery::steps() const {
    return commands.size() -
           static_cast<std::size_t>(std::ranges::count_if(commands, continuesStep));
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
        Command header{kHeader, {{"model", mOpened.model}, {"material", mOpened.material}}};
        if (mOpened.diameterMm) {
            header.arguments["diameter"] = *mOpened.diameterMm;
        }
        write(header);
        for (const auto& [file, kept] : mOpened.readInstead) {
            write({kKept, {{"file", file.string()}, {"as", kept.string()}}});
        }
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

std::optional<std::string> Journal::keep(const std::filesystem::path& file) {
    std::error_code failed;
    const std::filesystem::path path = std::filesystem::weakly_canonical(file, failed);
    if (!mStream.is_open() || mHasFailed || !std::filesystem::exists(path, failed) ||
        mOpened.readInstead.contains(path)) {
        return std::nullopt;
    }
    std::filesystem::path kept;
    for (int number = 1; kept.empty() || std::filesystem::exists(kept, failed); ++number) {
        kept = mFolder / fmt::format("{}-{}{}", ::getpid(), number, kKeptSuffix);
    }
    // A writer puts another file in this one's place: a second name for it costs nothing.
    std::filesystem::create_hard_link(path, kept, failed);
    if (failed) {
        std::filesystem::copy_file(path, kept, failed);
    }
    if (failed) {
        return fmt::format("'{}' cannot be kept in '{}' ({}): after a crash, what was done before "
                           "this save would be done twice",
                           path.string(), kept.string(), failed.message());
    }
    mOpened.readInstead[path] = kept;
    write({kKept, {{"file", path.string()}, {"as", kept.string()}}});
    return std::nullopt;
}

void Journal::explain(const std::string& reason) {
    if (mStream.is_open()) {
        write({kReason, {{"text", reason}}});
    }
}

void Journal::finish() {
    mStream = {};
    mHasFailed = false;
    if (!mFile.empty()) {
        removeFile(mFile);
        mFile.clear();
    }
    removeKept(mFolder, mOpened);
    mOpened = {};
}

void discard(const Recovery& recovery) {
    removeFile(recovery.file);
    removeKept(recovery.file.parent_path(), recovery.opened);
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
            OpenRequest opened{arguments.text("model"), arguments.text("material"), {}};
            if (arguments.has("diameter")) {
                opened.diameterMm = arguments.number("diameter");
            }
            std::string reason;
            std::erase_if(commands, [&](const Command& command) {
                if (command.name == kReason) {
                    reason = Arguments(command).text("text");
                    return true;
                }
                if (command.name != kKept) {
                    return false;
                }
                const Arguments kept(command);
                opened.readInstead[kept.text("file")] = kept.text("as");
                return true;
            });
            // Another session may have saved and gone on from the same.
            const bool isWhole = std::ranges::all_of(opened.readInstead, [&](const auto& kept) {
                return std::filesystem::exists(kept.second, failed);
            });
            if (!isWhole) {
                continue;
            }
            const auto time = entry.last_write_time(failed);
            if (!commands.empty() && (!latest || time > latestTime)) {
                latest = Recovery{file, std::move(opened), std::move(commands), reason};
                latestTime = time;
            }
        } catch (const Error&) {
            continue;
        }
    }
    return latest;
}

} // namespace celadon::ui
