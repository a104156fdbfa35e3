#include "renderer/scene/load_image.h"

#include "renderer/scene/load_bytes.h"
#include "subedit/errors.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace celadon::loaders {

namespace {

/// A name with the extension by which OpenImageIO finds the reader; empty for unknown bytes.
std::string readerName(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        return "picture.png";
    }
    if (bytes.starts_with("\xff\xd8\xff")) {
        return "picture.jpg";
    }
    if (bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") {
        return "picture.webp";
    }
    if (bytes.starts_with("BM")) {
        return "picture.bmp";
    }
    if (bytes.starts_with("GIF8")) {
        return "picture.gif";
    }
    return {};
}

} // namespace

Image decodeImage(std::string_view bytes, const std::string& place) {
    const std::string name = readerName(bytes);
    if (name.empty()) {
        throw InputError(place, "is no PNG or JPEG");
    }
    std::vector<char> copy(bytes.begin(), bytes.end()); // the reader takes it as writable
    OIIO::Filesystem::IOMemReader memory(copy.data(), copy.size());
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    const auto input = OIIO::ImageInput::open(name, &config, &memory);
    if (!input) {
        throw InputError(place, fmt::format("cannot be decoded ({})", excerpt(OIIO::geterror())));
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > kMaxImageSide ||
        spec.height > kMaxImageSide || spec.depth > 1) {
        throw InputError(place, fmt::format("is {} x {} pixels, the limit being {} on a side",
                                            spec.width, spec.height, kMaxImageSide));
    }
    // Deflate makes at most 1032 bytes of one, a byte at most 8 pixels; nothing packs tighter.
    constexpr std::uint64_t kMostPixelsPerByte = 1032 * 8;
    const auto pixels = static_cast<std::uint64_t>(spec.width) * static_cast<unsigned>(spec.height);
    if (pixels > kMostPixelsPerByte * bytes.size() || spec.nchannels < 1 || spec.nchannels > 8) {
        throw InputError(place, fmt::format("{} x {} pixels of {} channels cannot be in {} bytes",
                                            spec.width, spec.height, spec.nchannels, bytes.size()));
    }
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint8_t> raw(pixels * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, raw.data())) {
        throw InputError(place, fmt::format("cannot be decoded ({})", excerpt(input->geterror())));
    }
    Image image;
    image.width = spec.width;
    image.height = spec.height;
    image.rgba.resize(pixels * 4);
    const bool gray = channels < 3;
    const bool alpha = channels == 2 || channels >= 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* const from = raw.data() + i * channels;
        std::uint8_t* const to = image.rgba.data() + i * 4;
        to[0] = from[0];
        to[1] = gray ? from[0] : from[1];
        to[2] = gray ? from[0] : from[2];
        to[3] = alpha ? from[gray ? 1 : 3] : 255;
    }
    return image;
}

} // namespace celadon::loaders
