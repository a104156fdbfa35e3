#include "renderer/gl/shader_library.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>

namespace celadon::gl {

namespace {

std::filesystem::path checkedFolder(std::filesystem::path folder) {
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error)) {
        throw InputError(fmt::format("shader folder '{}'", folder.string()), "no such folder",
                         "set CELADON_SHADER_DIR to the folder shaders/ of the sources");
    }
    return folder;
}

} // namespace

ShaderLibrary::ShaderLibrary() : mFiles(shaders::embeddedShaders()) {
    const char* const folder = std::getenv("CELADON_SHADER_DIR");
    if (folder != nullptr && *folder != '\0') {
        mFolder = checkedFolder(folder);
    }
}

ShaderLibrary::ShaderLibrary(std::filesystem::path folder)
    : mFolder(checkedFolder(std::move(folder))) {}

std::optional<std::string> ShaderLibrary::text(std::string_view path) const {
    if (!mFolder) {
        const auto found = std::find_if(mFiles.begin(), mFiles.end(),
                                        [&](const auto& file) { return file.path == path; });
        return found != mFiles.end() ? std::optional(std::string(found->text)) : std::nullopt;
    }
    const std::filesystem::path file = *mFolder / path;
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        return std::nullopt;
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream || std::filesystem::is_directory(file, error)) {
        throw InputError(fmt::format("shader '{}'", file.string()), "it cannot be read");
    }
    return text;
}

std::optional<std::filesystem::file_time_type>
ShaderLibrary::lastChange(std::string_view path) const {
    if (!mFolder) {
        return std::nullopt;
    }
    std::error_code error;
    const auto time = std::filesystem::last_write_time(*mFolder / path, error);
    return error ? std::nullopt : std::optional(time);
}

std::string ShaderLibrary::description() const {
    return mFolder ? fmt::format("'{}'", mFolder->string()) : "the shaders in the program";
}

bool ShaderLibrary::isDefined(std::string_view name) const {
    return std::ranges::any_of(mDefines,
                               [name](const ShaderDefine& define) { return define.name == name; });
}

} // namespace celadon::gl
