#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <string_view>

/// Pictures of a model, to 8-bit RGBA and back. By stb_image, the decoder that tinygltf has, and
/// not by OpenImageIO: it multiplies nothing by alpha, prints nothing about damaged files, and does
/// not make every program that reads a model load some 270 libraries.
namespace celadon::loaders {

inline constexpr int kMaxImageSide = 16384;

/// PNG or JPEG (what glTF allows), told by the first bytes. Gray becomes RGB, missing alpha is
/// opaque, 16 bits become 8, values stay encoded as they are.
/// @throws InputError with `place` when it cannot be decoded, is larger than kMaxImageSide on a
/// side, or promises more pixels than its bytes can hold
[[nodiscard]] Image decodeImage(std::string_view bytes, const std::string& place);

/// The bytes of a PNG file, without its alpha where all of it is opaque. @throws OutputError
[[nodiscard]] std::string encodePng(const Image& image);

} // namespace celadon::loaders
