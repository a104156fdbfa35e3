#pragma once

#include "ui/key_map.h"

#include <filesystem>
#include <string>
#include <vector>

/// What a user has chosen for good. A JSON file; what it lacks or has wrong takes its default.
namespace celadon::ui {

enum class Theme { Dark, Gray, Light };
/// In files and commands: dark, gray, light.
[[nodiscard]] const char* themeName(Theme theme);

struct Preferences {
    Theme theme = Theme::Dark;
    KeyMap keys;
    double uiScale = 0.0; ///< 0: the display's
    bool autosave = true; ///< journals of sessions, for recovery
    double frameBudgetMs = 100.0;
    double undoMegabytes = 512.0;          ///< of each material's history
    std::vector<std::string> recentModels; ///< latest first
    std::vector<std::string> recentMaterials;
};

[[nodiscard]] std::filesystem::path preferencesFile();
[[nodiscard]] Preferences readPreferences(const std::filesystem::path& file);
/// @throws OutputError
void writePreferences(const Preferences& preferences, const std::filesystem::path& file);

/// Puts an entry first; each once, so many at most.
void addRecent(std::vector<std::string>& recent, const std::string& entry);

} // namespace celadon::ui
