#include "ui/material_library.h"

#include "subedit/errors.h"
#include "subedit/map/shipped_materials.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace celadon::ui {

namespace {

constexpr std::string_view kSuffix = ".subedit.exr";

} // namespace

std::string materialLabel(const std::string& nameOrPath) {
    std::string label = std::filesystem::path(nameOrPath).filename().string();
    if (label.ends_with(kSuffix)) {
        label.resize(label.size() - kSuffix.size());
    }
    std::ranges::replace(label, '_', ' ');
    if (!label.empty()) {
        label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
    }
    return label;
}

MaterialLibrary findMaterials(const std::filesystem::path& ownFolder,
                              const std::vector<std::string>& recentFiles) {
    MaterialLibrary library;
    std::set<std::filesystem::path> known;
    const auto add = [&](std::vector<LibraryMaterial>& list, const std::string& nameOrPath,
                         const std::filesystem::path& file) {
        std::error_code failed;
        if (std::filesystem::is_regular_file(file, failed) &&
            known.insert(std::filesystem::weakly_canonical(file, failed)).second) {
            list.push_back({materialLabel(nameOrPath), nameOrPath, file});
        }
    };
    try {
        for (const std::string& name : subedit::shippedMaterialNames()) {
            add(library.shipped, name, subedit::findMaterial(name));
        }
    } catch (const Error&) { // the folder is gone: there are none
        library.shipped.clear();
    }
    std::error_code failed;
    std::vector<std::filesystem::path> own;
    for (const auto& entry : std::filesystem::directory_iterator(ownFolder, failed)) {
        if (entry.path().filename().string().ends_with(kSuffix)) {
            own.push_back(entry.path());
        }
    }
    std::ranges::sort(own);
    for (const std::filesystem::path& file : own) {
        add(library.own, file.string(), file);
    }
    for (const std::string& file : recentFiles) {
        add(library.recent, file, file);
    }
    return library;
}

} // namespace celadon::ui
