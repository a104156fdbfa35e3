#include "renderer/scene/load_scene.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf.h"
#include "renderer/scene/load_obj.h"
#include "renderer/scene/load_off.h"
#include "renderer/scene/load_ply.h"
#include "renderer/scene/load_stl.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <new>
#include <string>
#include <string_view>

namespace celadon {

namespace {

using Loader = Scene (*)(const std::filesystem::path&, std::string_view);

struct Format {
    std::string_view extension;
    Loader load;
};

constexpr std::array<Format, 6> kFormats{{{".gltf", loaders::loadGltf},
                                          {".glb", loaders::loadGltf},
                                          {".obj", loaders::loadObj},
                                          {".ply", loaders::loadPly},
                                          {".off", loaders::loadOff},
                                          {".stl", loaders::loadStl}}};

/// In small letters.
std::string extensionOf(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

Loader loaderFor(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file);
    std::string known;
    for (const Format& format : kFormats) {
        if (extension == format.extension) {
            return format.load;
        }
        known += known.empty() ? "" : " ";
        known += format.extension;
    }
    throw InputError(loaders::quoted(file),
                     extension.empty() ? "has no extension that tells its format"
                                       : fmt::format("'{}' is no model format that Celadon reads",
                                                     loaders::excerpt(extension)),
                     fmt::format("convert it to one of {}", known));
}

} // namespace

bool isGltf(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file);
    return extension == ".gltf" || extension == ".glb";
}

Scene loadScene(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw InputError(loaders::quoted(file), "is a folder", "name a model file in it");
    }
    const Loader load = loaderFor(file);
    try {
        return load(file, loaders::readFile(file));
    } catch (const std::bad_alloc&) {
        throw InputError(loaders::quoted(file), "does not fit into memory",
                         "close other programs, or simplify the model");
    }
}

} // namespace celadon
