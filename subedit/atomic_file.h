#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

/// Outputs that appear whole or not at all (DESIGN section 5): written under a temporary name in
/// the target's own folder, then renamed over it. Until then an earlier file is left as it was.
/// No fsync: this protects from failures of the program, not of the power supply.
namespace celadon {

/// Says early, before long work, whether `target` could be written: its folder exists and takes a
/// new file, and the target itself is a regular, writable file or absent.
/// Leaves no trace. @throws OutputError naming the target and what stands in the way
void checkWritable(const std::filesystem::path& target);

/// Where a name leads: symbolic links are followed, and what the last one names need not exist.
/// Files that lie beside an output lie beside this. @throws OutputError as checkWritable()
[[nodiscard]] std::filesystem::path resolveTarget(const std::filesystem::path& target);

/// What outputs say instead of the time of writing: the same content is to be the same bytes.
inline constexpr const char* kNoDate = "1970:01:01 00:00:00";

/// A temporary file that becomes `target` on commit() and vanishes when destroyed before that.
class AtomicFile {
public:
    /// Creates the empty temporary file. A symbolic link is followed: what it points to is
    /// replaced, the link stays. @throws OutputError as checkWritable()
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// For libraries that open files by name; a hidden name without the target's extension.
    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return mTemporary; }

    /// Appends. @throws OutputError (disk full, file too large, ...)
    void write(std::span<const std::byte> bytes);

    /// Renames the temporary file to the target; permissions of an earlier target are kept.
    /// @throws OutputError; the temporary file is then gone and the earlier target untouched
    void commit();

private:
    void discard() noexcept;

    std::filesystem::path mTarget;   ///< as the user named it, for messages
    std::filesystem::path mResolved; ///< links followed
    std::filesystem::path mTemporary;
    int mDescriptor = -1; ///< open while >= 0
};

/// The whole contents at once.
void writeFileAtomically(const std::filesystem::path& target, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& target, std::string_view text);

} // namespace celadon
