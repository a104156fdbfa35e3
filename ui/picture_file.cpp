#include "ui/picture_file.h"

#include "renderer/output/image_io.h"

namespace celadon::ui {

std::vector<std::string> pictureSuffixes() {
    return {".png", ".jpg", ".jpeg", ".tif", ".tiff"};
}

void writePicture(const std::filesystem::path& file, const std::vector<std::uint8_t>& rgb,
                  glm::ivec2 size) {
    FloatImage image;
    image.width = size.x;
    image.height = size.y;
    image.channels = {"R", "G", "B"};
    image.pixels.reserve(rgb.size());
    for (const std::uint8_t value : rgb) {
        image.pixels.push_back(static_cast<float>(value) / 255.0f);
    }
    writeDisplayImage(file, image);
}

void writePicture(const std::filesystem::path& file, const gl::Texture& texture) {
    const glm::ivec2 size = texture.size2d();
    std::vector<std::uint8_t> rgba(texture.texelCount() * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgba.size()),
                      rgba.data());
    std::vector<std::uint8_t> rgb;
    rgb.reserve(texture.texelCount() * 3);
    for (int y = size.y - 1; y >= 0; --y) {
        for (int x = 0; x < size.x; ++x) {
            const auto i = static_cast<std::size_t>(y * size.x + x) * 4;
            rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
        }
    }
    writePicture(file, rgb, size);
}

} // namespace celadon::ui
