#pragma once

#include "renderer/gl/texture.h"
#include "ui/background_jobs.h"

#include <filesystem>
#include <map>
#include <string>

/// Pictures of materials, rendered by the renderer itself in the background and kept in the
/// platform's cache folder until the file changes.
namespace celadon::ui {

class Thumbnails {
public:
    static constexpr int kSizePx = 160;

    /// @param folder of the cache; made when it is needed
    Thumbnails(BackgroundJobs& jobs, std::filesystem::path folder);

    /// The picture of a material file; null until it is there: it is asked for by asking.
    [[nodiscard]] const gl::Texture* find(const std::filesystem::path& material);

    /// Files may have changed since they were last looked at.
    void refresh() { mKeys.clear(); }

private:
    struct Entry {
        gl::Texture texture;
        bool isAsked = false;
    };
    void ask(const std::string& key, const std::filesystem::path& material);

    BackgroundJobs& mJobs;
    std::filesystem::path mFolder;
    std::map<std::string, Entry> mEntries; ///< by cacheKey()
    std::map<std::filesystem::path, std::string> mKeys;
};

} // namespace celadon::ui
