#include "ui/preferences.h"

#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "ui/user_folders.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>

namespace celadon::ui {

namespace {

constexpr std::size_t kMostRecent = 10;

std::vector<std::string> texts(const nlohmann::json& object, const char* name) {
    std::vector<std::string> result;
    const auto found = object.find(name);
    if (found != object.end() && found->is_array()) {
        for (const nlohmann::json& element : *found) {
            if (element.is_string() && result.size() < kMostRecent) {
                result.push_back(element.get<std::string>());
            }
        }
    }
    return result;
}

double number(const nlohmann::json& object, const char* name, double least, double most,
              double otherwise) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) {
        return otherwise;
    }
    const double value = found->get<double>();
    return value >= least && value <= most ? value : otherwise;
}

constexpr std::array<const char*, 3> kThemes{"dark", "gray", "light"}; ///< in the order of Theme

std::map<std::string, std::string> keysOf(const nlohmann::json& object) {
    std::map<std::string, std::string> keys;
    const auto found = object.find("keys");
    if (found != object.end() && found->is_object()) {
        for (const auto& [name, chord] : found->items()) {
            if (chord.is_string()) {
                keys[name] = chord.get<std::string>();
            }
        }
    }
    return keys;
}

} // namespace

const char* themeName(Theme theme) {
    return kThemes[static_cast<std::size_t>(theme)];
}

std::filesystem::path preferencesFile() {
    return configFolder() / "preferences.json";
}

Preferences readPreferences(const std::filesystem::path& file) {
    Preferences preferences;
    std::ifstream stream(file);
    const nlohmann::json object =
        stream ? nlohmann::json::parse(stream, nullptr, false) : nlohmann::json();
    if (!object.is_object()) {
        return preferences;
    }
    preferences.uiScale = number(object, "uiScale", 0.5, 4.0, 0.0);
    preferences.frameBudgetMs =
        number(object, "frameBudgetMs", 10.0, 1000.0, preferences.frameBudgetMs);
    preferences.undoMegabytes =
        number(object, "undoMegabytes", 64.0, 65536.0, preferences.undoMegabytes);
    const auto theme =
        std::find(kThemes.begin(), kThemes.end(), object.value("theme", nlohmann::json()));
    if (theme != kThemes.end()) {
        preferences.theme = static_cast<Theme>(theme - kThemes.begin());
    }
    preferences.keys.apply(keysOf(object));
    const auto autosave = object.find("autosave");
    preferences.autosave =
        autosave == object.end() || !autosave->is_boolean() || autosave->get<bool>();
    preferences.recentModels = texts(object, "recentModels");
    preferences.recentMaterials = texts(object, "recentMaterials");
    return preferences;
}

void writePreferences(const Preferences& preferences, const std::filesystem::path& file) {
    const nlohmann::json object{{"theme", themeName(preferences.theme)},
                                {"keys", preferences.keys.changes()},
                                {"uiScale", preferences.uiScale},
                                {"autosave", preferences.autosave},
                                {"frameBudgetMs", preferences.frameBudgetMs},
                                {"undoMegabytes", preferences.undoMegabytes},
                                {"recentModels", preferences.recentModels},
                                {"recentMaterials", preferences.recentMaterials}};
    std::error_code failed;
    std::filesystem::create_directories(file.parent_path(), failed);
    writeFileAtomically(file, object.dump(4) + "\n");
}

void addRecent(std::vector<std::string>& recent, const std::string& entry) {
    std::erase(recent, entry);
    recent.insert(recent.begin(), entry);
    recent.resize(std::min(recent.size(), kMostRecent));
}

} // namespace celadon::ui
