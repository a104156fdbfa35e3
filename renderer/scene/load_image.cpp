#include "renderer/scene/load_image.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <stb_image.h>
#include <stb_image_write.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace celadon::loaders {

Image decodeImage(std::string_view bytes, const std::string& place) {
    const char* const remedy = "save the picture again as PNG or JPEG";
    const bool known = bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.starts_with("\xff\xd8\xff");
    if (!known || bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw InputError(place, "is no PNG or JPEG", remedy);
    }
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    Image image;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0) {
        throw InputError(place, "its header cannot be decoded", remedy);
    }
    if (image.width < 1 || image.height < 1 || image.width > kMaxImageSide ||
        image.height > kMaxImageSide) {
        throw InputError(place,
                         fmt::format("is {} x {} pixels, the limit being {} on a side", image.width,
                                     image.height, kMaxImageSide),
                         "make the picture smaller");
    }
    // Deflate makes at most 1032 bytes of one, a byte at most 8 pixels; JPEG packs less tightly.
    constexpr std::uint64_t kMostPixelsPerByte = 1032 * 8;
    const auto pixels =
        static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    if (pixels > kMostPixelsPerByte * bytes.size()) {
        throw InputError(place,
                         fmt::format("{} x {} pixels cannot be in {} bytes", image.width,
                                     image.height, bytes.size()),
                         remedy);
    }
    int width = 0;
    int height = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(data, size, &width, &height, &channels, STBI_rgb_alpha),
        stbi_image_free);
    if (!decoded || width != image.width || height != image.height) {
        const char* const reason = stbi_failure_reason();
        throw InputError(place, fmt::format("cannot be decoded ({})", reason ? reason : "damaged"),
                         remedy);
    }
    image.rgba.assign(decoded.get(), decoded.get() + pixels * 4);
    return image;
}

std::string encodePng(const Image& image) {
    std::vector<std::uint8_t> rgb;
    bool isOpaque = true;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        isOpaque = isOpaque && image.rgba[i + 3] == 255;
        rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
    }
    const int channels = isOpaque ? 3 : 4;
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                              static_cast<std::size_t>(size));
    };
    if (stbi_write_png_to_func(append, &bytes, image.width, image.height, channels,
                               isOpaque ? rgb.data() : image.rgba.data(),
                               image.width * channels) == 0) {
        throw OutputError(fmt::format("picture '{}'", image.name), "cannot be encoded as PNG");
    }
    return bytes;
}

} // namespace celadon::loaders
