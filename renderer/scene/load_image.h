#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <string_view>

/// Pictures of a model, decoded to 8-bit RGBA through OpenImageIO.
namespace celadon::loaders {

inline constexpr int kMaxImageSide = 16384;

/// PNG, JPEG, WebP and the like, told by its first bytes. Gray becomes RGB, missing alpha is
/// opaque, alpha stays unassociated, values stay encoded as they are.
/// @throws InputError with `place` when it cannot be decoded, is larger than kMaxImageSide on a
/// side, or promises more pixels than its bytes can hold
[[nodiscard]] Image decodeImage(std::string_view bytes, const std::string& place);

} // namespace celadon::loaders
