#pragma once

#include "shaders/embedded_shaders.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace celadon::gl {

/// A compile-time option: "#define name value".
struct ShaderDefine {
    std::string name;
    std::string value;
};

/// Where shader text comes from, by path relative to shaders/: the files compiled into the program,
/// or, for those who edit shaders, a folder on disk.
class ShaderLibrary {
public:
    /// The folder that the environment variable CELADON_SHADER_DIR names, else the embedded files.
    /// @throws InputError when it names no folder
    ShaderLibrary();
    explicit ShaderLibrary(std::filesystem::path folder);
    /// Files in memory, which outlive the library.
    explicit ShaderLibrary(std::span<const shaders::EmbeddedShader> files) : mFiles(files) {}

    /// Options of every shader that is loaded from here on, besides its own: what a scene fixes.
    void define(std::vector<ShaderDefine> defines) { mDefines = std::move(defines); }
    [[nodiscard]] const std::vector<ShaderDefine>& defines() const { return mDefines; }
    /// By define().
    [[nodiscard]] bool isDefined(std::string_view name) const;

    /// Null when there is no such file. @throws InputError when it is there and cannot be read
    [[nodiscard]] std::optional<std::string> text(std::string_view path) const;

    /// Time of the last change on disk; null for embedded files and missing ones. Watch
    /// ShaderSource::files() to reload a program when it or one of its includes changes.
    [[nodiscard]] std::optional<std::filesystem::file_time_type>
    lastChange(std::string_view path) const;
    [[nodiscard]] bool isOnDisk() const { return mFolder.has_value(); }
    /// "'…/shaders'" or "the shaders in the program", for messages.
    [[nodiscard]] std::string description() const;

private:
    std::span<const shaders::EmbeddedShader> mFiles;
    std::optional<std::filesystem::path> mFolder;
    std::vector<ShaderDefine> mDefines;
};

} // namespace celadon::gl
