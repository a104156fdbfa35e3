#include "ui/user_folders.h"

#include <cstdlib>

namespace celadon::ui {

namespace {

std::filesystem::path folder(const char* variable, const char* underHome) {
    const char* const named = std::getenv(variable);
    if (named != nullptr && std::filesystem::path(named).is_absolute()) {
        return std::filesystem::path(named) / "celadon";
    }
    const char* const home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr ? home : "/tmp") / underHome / "celadon";
}

} // namespace

std::filesystem::path configFolder() {
    return folder("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path stateFolder() {
    return folder("XDG_STATE_HOME", ".local/state");
}

std::filesystem::path cacheFolder() {
    return folder("XDG_CACHE_HOME", ".cache");
}

std::filesystem::path dataFolder() {
    return folder("XDG_DATA_HOME", ".local/share");
}

} // namespace celadon::ui
