#pragma once

#include <filesystem>
#include <string_view>

/// An output that appears under its name only once it is complete: written to a temporary file in
/// the same folder, which commit() renames. Without commit() it leaves no trace.
namespace celadon::subedit {

class PendingFile {
public:
    /// @throws OutputError if the folder does not exist or `target` is a folder
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// Where to write. Ends like the target, so that writers choose the same format.
    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return mTemporary; }

    /// Renames. @throws OutputError; the target is then as it was
    void commit();

private:
    std::filesystem::path mTarget;
    std::filesystem::path mTemporary;
    bool mCommitted = false;
};

/// Writes `content` to `target` by way of a PendingFile. @throws OutputError
void writeTextFile(const std::filesystem::path& target, std::string_view content);

} // namespace celadon::subedit
