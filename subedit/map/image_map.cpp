#include "subedit/map/image_map.h"

#include "subedit/errors.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>

namespace celadon::subedit {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxSide = 8192;
constexpr int kMaxChannels = 16;

[[noreturn]] void refuse(const fs::path& file, const std::string& reason,
                         const std::string& remedy = {}) {
    throw InputError(fmt::format("'{}'", file.string()), reason, remedy);
}

/// IEC 61966-2-1
float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

bool isEncoded(const OIIO::ImageSpec& spec, ImageMeaning meaning) {
    if (meaning == ImageMeaning::Data || spec.format.is_floating_point()) {
        return false;
    }
    const std::string space = spec.get_string_attribute("oiio:ColorSpace", "sRGB");
    return !(space == "Linear" || space == "linear");
}

glm::vec3 texel(const ImageMap& map, int x, int y) {
    const int wrappedX = (x % map.width + map.width) % map.width;
    const int wrappedY = (y % map.height + map.height) % map.height;
    return map.values[static_cast<std::size_t>(wrappedY) * static_cast<std::size_t>(map.width) +
                      static_cast<std::size_t>(wrappedX)];
}

} // namespace

ImageMap readImageMap(const fs::path& file, ImageMeaning meaning) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
        refuse(file, "no such file");
    }
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    if (!input) {
        refuse(file, "is no image that can be read: " + OIIO::geterror());
    }
    const OIIO::ImageSpec spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > kMaxSide || spec.height > kMaxSide ||
        spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > kMaxChannels || spec.deep) {
        refuse(file, fmt::format("is {} x {} in {} channels; maps are flat, up to {} a side",
                                 spec.width, spec.height, spec.nchannels, kMaxSide));
    }
    ImageMap map{spec.width, spec.height, {}};
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> pixels(static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data())) {
        refuse(file, "cannot be read: " + input->geterror(), "it may be cut short");
    }
    const bool decode = isEncoded(spec, meaning);
    map.values.reserve(pixels.size() / channels);
    for (std::size_t i = 0; i < pixels.size(); i += channels) {
        glm::vec3 value = channels < 3 ? glm::vec3(pixels[i])
                                       : glm::vec3(pixels[i], pixels[i + 1], pixels[i + 2]);
        for (int channel = 0; channel < 3; ++channel) {
            if (!std::isfinite(value[channel])) {
                const std::size_t pixel = i / channels;
                const auto width = static_cast<std::size_t>(spec.width);
                refuse(file, fmt::format("is not finite at pixel ({}, {})", pixel % width,
                                         pixel / width));
            }
            if (decode) {
                value[channel] = decodeSrgb(value[channel]);
            }
        }
        map.values.push_back(value);
    }
    return map;
}

ImageMap resizeImageMap(const ImageMap& map, int width, int height) {
    ImageMap out{width, height, {}};
    // A smaller map takes the mean over each of its texels' footprints.
    const int stepsX = std::max(1, (map.width + width - 1) / width);
    const int stepsY = std::max(1, (map.height + height - 1) / height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0.0f);
            for (int j = 0; j < stepsY; ++j) {
                for (int i = 0; i < stepsX; ++i) {
                    const float u = (static_cast<float>(x) +
                                     (static_cast<float>(i) + 0.5f) / static_cast<float>(stepsX)) /
                                        static_cast<float>(width) * static_cast<float>(map.width) -
                                    0.5f;
                    const float v = (static_cast<float>(y) +
                                     (static_cast<float>(j) + 0.5f) / static_cast<float>(stepsY)) /
                                        static_cast<float>(height) *
                                        static_cast<float>(map.height) -
                                    0.5f;
                    const int x0 = static_cast<int>(std::floor(u));
                    const int y0 = static_cast<int>(std::floor(v));
                    const float fu = u - static_cast<float>(x0);
                    const float fv = v - static_cast<float>(y0);
                    sum +=
                        (texel(map, x0, y0) * (1.0f - fu) + texel(map, x0 + 1, y0) * fu) *
                            (1.0f - fv) +
                        (texel(map, x0, y0 + 1) * (1.0f - fu) + texel(map, x0 + 1, y0 + 1) * fu) *
                            fv;
                }
            }
            out.values.push_back(sum / static_cast<float>(stepsX * stepsY));
        }
    }
    return out;
}

} // namespace celadon::subedit
