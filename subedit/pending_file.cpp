#include "subedit/pending_file.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>
#include <unistd.h>

namespace celadon::subedit {

namespace fs = std::filesystem;

namespace {

std::string quoted(const fs::path& path) {
    return fmt::format("'{}'", path.string());
}

} // namespace

PendingFile::PendingFile(fs::path target) : mTarget(std::move(target)) {
    std::error_code error;
    const fs::path folder = mTarget.has_parent_path() ? mTarget.parent_path() : fs::path(".");
    if (!mTarget.has_filename()) {
        throw OutputError(quoted(mTarget), "is not a file name");
    }
    if (!fs::is_directory(folder, error)) {
        throw OutputError(quoted(mTarget),
                          fmt::format("folder '{}' does not exist", folder.string()),
                          "create it first");
    }
    if (fs::is_directory(mTarget, error)) {
        throw OutputError(quoted(mTarget), "is a folder", "give a file name in it");
    }
    mTemporary = folder / fmt::format(".{}.{}{}", mTarget.stem().string(),
                                      static_cast<long>(::getpid()), mTarget.extension().string());
}

PendingFile::~PendingFile() {
    if (!mCommitted) {
        std::error_code ignored;
        fs::remove(mTemporary, ignored);
    }
}

void PendingFile::commit() {
    std::error_code error;
    fs::rename(mTemporary, mTarget, error);
    if (error) {
        throw OutputError(quoted(mTarget), "cannot be written: " + error.message());
    }
    mCommitted = true;
}

void writeTextFile(const fs::path& target, std::string_view content) {
    PendingFile pending(target);
    std::ofstream stream(pending.temporaryPath(), std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) {
        throw OutputError(quoted(target), "cannot be written",
                          "check the folder's permissions and the free space");
    }
    pending.commit();
}

} // namespace celadon::subedit
