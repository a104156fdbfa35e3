#pragma once

#include <span>
#include <string_view>

/// The shader files of this folder, compiled into the program (cmake/EmbedShaders.cmake).
namespace celadon::shaders {

struct EmbeddedShader {
    std::string_view path; ///< relative to shaders/: "include/profile.glsl"
    std::string_view text;
};

/// Sorted by path.
[[nodiscard]] std::span<const EmbeddedShader> embeddedShaders();

} // namespace celadon::shaders
