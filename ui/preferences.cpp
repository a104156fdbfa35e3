#include "ui/preferences.h"

#include "renderer/output/atomic_file.h"
#include "subedit/errors.h"
#include "ui/user_folders.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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

} // namespace

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
    const auto autosave = object.find("autosave");
    preferences.autosave =
        autosave == object.end() || !autosave->is_boolean() || autosave->get<bool>();
    preferences.recentModels = texts(object, "recentModels");
    preferences.recentMaterials = texts(object, "recentMaterials");
    return preferences;
}

void writePreferences(const Preferences& preferences, const std::filesystem::path& file) {
    const nlohmann::json object{{"uiScale", preferences.uiScale},
                                {"autosave", preferences.autosave},
                                {"frameBudgetMs", preferences.frameBudgetMs},
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
