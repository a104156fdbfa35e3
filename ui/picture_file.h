#pragma once

#include "renderer/gl/texture.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// Display pixels to files.
namespace celadon::ui {

/// Those that writePicture() takes, the usual one first.
[[nodiscard]] std::vector<std::string> pictureSuffixes();

/// @param rgb rows from the top @throws UsageError (extension), OutputError
void writePicture(const std::filesystem::path& file, const std::vector<std::uint8_t>& rgb,
                  glm::ivec2 size);
/// @param texture RGBA8, sRGB encoded, rows from the bottom; its context is current
void writePicture(const std::filesystem::path& file, const gl::Texture& texture);

} // namespace celadon::ui
