#include "subedit/map/shipped_materials.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace celadon::subedit {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kSuffix = ".subedit.exr";

bool isFolder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

} // namespace

fs::path shippedMaterialFolder() {
    if (const char* chosen = std::getenv("CELADON_MATERIALS"); chosen != nullptr && *chosen != 0) {
        if (!isFolder(chosen)) {
            throw InputError(fmt::format("environment variable CELADON_MATERIALS = '{}'", chosen),
                             "is not a folder", "unset it to use the shipped materials");
        }
        return chosen;
    }
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        const fs::path installed =
            program.parent_path().parent_path() / CELADON_INSTALL_DATADIR / "materials";
        if (isFolder(installed)) {
            return installed;
        }
    }
    if (isFolder(CELADON_SOURCE_MATERIALS)) {
        return CELADON_SOURCE_MATERIALS;
    }
    throw InputError("shipped materials", "the folder they were installed in is gone",
                     "install Celadon again, or name it in environment variable "
                     "CELADON_MATERIALS");
}

std::vector<std::string> shippedMaterialNames() {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(shippedMaterialFolder(), error)) {
        const std::string file = entry.path().filename().string();
        if (file.ends_with(kSuffix) && !file.starts_with('.')) {
            names.push_back(file.substr(0, file.size() - kSuffix.size()));
        }
    }
    std::ranges::sort(names);
    return names;
}

fs::path findMaterial(const std::string& nameOrPath) {
    const fs::path path(nameOrPath);
    if (path.has_extension() || path.has_parent_path() || nameOrPath.empty()) {
        return path;
    }
    const std::vector<std::string> names = shippedMaterialNames();
    if (std::ranges::binary_search(names, nameOrPath)) {
        return shippedMaterialFolder() / (nameOrPath + std::string(kSuffix));
    }
    throw InputError(
        fmt::format("material '{}'", nameOrPath), "no shipped material has this name",
        fmt::format("known are {}; a file is named with its extension", fmt::join(names, ", ")));
}

} // namespace celadon::subedit
