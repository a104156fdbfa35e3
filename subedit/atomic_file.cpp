#include "subedit/atomic_file.h"

#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace celadon {
namespace fs = std::filesystem;
namespace {

constexpr mode_t kDefaultMode = 0666; // less the user's umask
constexpr int kMostLinks = 40;        // that a name may lead through, as Linux has it
constexpr int kNameAttempts = 100;    // leftovers of a killed process with the same id

std::string quote(const fs::path& path) {
    return fmt::format("'{}'", path.string());
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// One sentence for what the system said about `target`, which is written at `resolved`.
OutputError systemError(const fs::path& target, const fs::path& resolved, int code) {
    const std::string folder = quote(folderOf(resolved));
    switch (code) {
    case ENOENT:
        return {quote(target), fmt::format("the folder {} does not exist", folder),
                "create it first or choose another"};
    case ENOTDIR:
        return {quote(target), fmt::format("{} is not a folder", folder), "choose another name"};
    case EACCES:
    case EPERM:
        return {quote(target), fmt::format("the folder {} is not writable", folder),
                "change its permissions or choose another"};
    case EROFS:
        return {quote(target), fmt::format("the folder {} is on a read-only disk", folder),
                "choose another"};
    case ENOSPC:
    case EDQUOT:
        return {quote(target), "the disk is full", "free some space or choose another disk"};
    case EFBIG:
        return {quote(target), "the file is larger than this disk or the user's limit allows",
                "choose another disk or raise the limit"};
    case ENAMETOOLONG:
        return {quote(target), "the name is too long", "choose a shorter one"};
    default:
        return {quote(target),
                fmt::format("cannot be written ({})", std::system_category().message(code))};
    }
}

/// A name that no other process and no other thread of this one uses.
int createTemporary(const fs::path& folder, fs::path& name) {
    static std::atomic<unsigned> counter{0};
    for (int attempt = 0; attempt < kNameAttempts; ++attempt) {
        name = folder / fmt::format(".celadon-{}-{}.tmp", ::getpid(), counter++);
        const int descriptor =
            ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kDefaultMode);
        if (descriptor >= 0 || errno != EEXIST) {
            return descriptor;
        }
    }
    return -1;
}

} // namespace

fs::path resolveTarget(const fs::path& target) {
    if (target.empty()) {
        throw OutputError("output", "no file name is given");
    }
    if (target == "-") {
        throw OutputError("'-'", "is no name for standard output here",
                          "name a file; './-' is one of that name");
    }
    std::error_code error;
    fs::path resolved = target;
    // Link by link: what the last one names need not exist yet.
    for (int links = 0; fs::is_symlink(resolved, error); ++links) {
        const fs::path next = fs::read_symlink(resolved, error);
        if (links == kMostLinks) {
            error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
        }
        if (error) {
            throw OutputError(quote(target),
                              fmt::format("the link cannot be followed ({})", error.message()));
        }
        resolved = resolved.parent_path() / next;
    }
    const fs::file_status status = fs::status(resolved, error);
    if (fs::is_directory(status) || !resolved.has_filename()) {
        throw OutputError(quote(target), "is a folder", "name a file in it");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw OutputError(quote(target), "is a device or a pipe, not a file", "name a file");
    }
    if (fs::exists(status) && ::faccessat(AT_FDCWD, resolved.c_str(), W_OK, AT_EACCESS) != 0) {
        throw OutputError(quote(target), "the file is write-protected",
                          "change its permissions or choose another name");
    }
    return resolved;
}

AtomicFile::AtomicFile(const fs::path& target) : mTarget(target), mResolved(resolveTarget(target)) {
    // A name that the file system refuses should be refused now, not at the rename.
    struct stat info {};
    if (::lstat(mResolved.c_str(), &info) != 0 && errno == ENAMETOOLONG) {
        throw systemError(mTarget, mResolved, errno);
    }
    mDescriptor = createTemporary(folderOf(mResolved), mTemporary);
    if (mDescriptor < 0) {
        throw systemError(mTarget, mResolved, errno);
    }
}

AtomicFile::~AtomicFile() {
    discard();
}

void AtomicFile::discard() noexcept {
    if (mDescriptor >= 0) {
        ::close(mDescriptor);
        mDescriptor = -1;
    }
    if (!mTemporary.empty()) {
        ::unlink(mTemporary.c_str());
        mTemporary.clear();
    }
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    CELADON_ASSERT(mDescriptor >= 0);
    while (!bytes.empty()) {
        const ssize_t written = ::write(mDescriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            const int code = errno;
            discard();
            throw systemError(mTarget, mResolved, code);
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit() {
    CELADON_ASSERT(mDescriptor >= 0);
    struct stat earlier {};
    const bool replaces = ::stat(mResolved.c_str(), &earlier) == 0;
    if (replaces) {
        // Best effort: a file system without permissions is no reason to fail.
        static_cast<void>(::fchmod(mDescriptor, earlier.st_mode & 07777));
    }
    const int descriptor = mDescriptor;
    mDescriptor = -1;
    // Network disks report a full disk only here.
    if (::close(descriptor) != 0 || ::rename(mTemporary.c_str(), mResolved.c_str()) != 0) {
        const int code = errno;
        discard();
        throw systemError(mTarget, mResolved, code);
    }
    mTemporary.clear();
}

void checkWritable(const fs::path& target) {
    const AtomicFile probe(target);
}

void writeFileAtomically(const fs::path& target, std::span<const std::byte> bytes) {
    AtomicFile file(target);
    file.write(bytes);
    file.commit();
}

void writeFileAtomically(const fs::path& target, std::string_view text) {
    writeFileAtomically(target, std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace celadon
