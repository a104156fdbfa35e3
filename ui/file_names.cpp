#include "ui/file_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace celadon::ui {

namespace {

/// What nobody means as a part of a name that goes on: "bust.v2" is one, "bust.obj" is not.
const std::array<std::string, 18> kKnown{".exr",  ".hdr",  ".png", ".jpg",  ".jpeg", ".tif",
                                         ".tiff", ".webp", ".bmp", ".gltf", ".glb",  ".obj",
                                         ".ply",  ".off",  ".stl", ".fbx",  ".usd",  ".json"};

} // namespace

std::string lowered(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool endsInOne(const std::string& name, std::span<const std::string> suffixes) {
    const std::string lower = lowered(name);
    return suffixes.empty() || std::ranges::any_of(suffixes, [&lower](const std::string& suffix) {
               return lower.ends_with(suffix);
           });
}

std::optional<std::string> completedName(const std::string& name,
                                         std::span<const std::string> suffixes) {
    if (endsInOne(name, suffixes)) {
        return name;
    }
    const std::string& suffix = suffixes.front();
    const std::string lastPart = std::filesystem::path("name" + suffix).extension().string();
    if (lowered(name).ends_with(lastPart)) {
        return name.substr(0, name.size() - lastPart.size()) + suffix;
    }
    return endsInOne(name, kKnown) ? std::nullopt : std::optional(name + suffix);
}

} // namespace celadon::ui
