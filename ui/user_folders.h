#pragma once

#include <filesystem>

/// Where the platform keeps what belongs to the user (XDG Base Directory Specification 0.8).
namespace celadon::ui {

[[nodiscard]] std::filesystem::path configFolder(); ///< preferences
[[nodiscard]] std::filesystem::path stateFolder();  ///< journals of sessions
[[nodiscard]] std::filesystem::path cacheFolder();  ///< thumbnails: may be deleted at any time
[[nodiscard]] std::filesystem::path dataFolder();   ///< the user's own materials

} // namespace celadon::ui
