#pragma once

#include <glm/vec3.hpp>

#include <filesystem>
#include <vector>

/// Images as maps of numbers, for baking materials.
namespace celadon::subedit {

struct ImageMap {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> values; ///< [height][width], top row first
};

enum class ImageMeaning {
    Color, ///< 8- and 16-bit integer images are sRGB encoded, unless the file says otherwise
    Data   ///< numbers are taken as they are
};

/// Any image that OpenImageIO reads; gray images fill all channels, alpha is left out.
/// @throws InputError if it cannot be read, is over 8192 a side, or holds NaN or infinity
[[nodiscard]] ImageMap readImageMap(const std::filesystem::path& file, ImageMeaning meaning);

/// Bilinear, repeating, texel centers at (i + 1/2) / size.
[[nodiscard]] ImageMap resizeImageMap(const ImageMap& map, int width, int height);

} // namespace celadon::subedit
