#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// A dialog for files, of our own: the platform's would need another toolkit.
namespace celadon::ui {

class FileDialog {
public:
    enum class Kind { Open, Save };

    /// @param suffixes such as ".subedit.exr", lower case; empty: all files
    /// @param name proposed, for Save
    void open(Kind kind, const std::string& title, std::vector<std::string> suffixes,
              const std::filesystem::path& folder, const std::string& name,
              std::function<void(const std::filesystem::path&)> done);
    [[nodiscard]] bool isOpen() const { return mIsOpen; }
    [[nodiscard]] const std::string& problem() const { return mProblem; } ///< that it shows
    void draw(float scale);

private:
    struct Entry {
        std::string name;
        bool isFolder = false;
        std::uintmax_t bytes = 0;
    };
    void enter(const std::filesystem::path& folder);
    void choose();
    void drawPlaces(float scale);
    void drawEntries(float height);

    Kind mKind = Kind::Open;
    std::string mTitle;
    std::vector<std::string> mSuffixes;
    std::filesystem::path mFolder;
    std::vector<Entry> mEntries;
    std::string mName;
    std::string mProblem;
    std::function<void(const std::filesystem::path&)> mDone;
    bool mIsOpen = false;
    bool mAppears = false;
    int mOpenings = 0;               ///< so far
    bool mTakesFocus = false;        ///< the name, with the next frame
    std::filesystem::path mWarnedOf; ///< that it exists: once more, and it is replaced
};

} // namespace celadon::ui
