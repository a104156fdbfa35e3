#include "renderer/output/image_io.h"

#include "renderer/output/tone_map.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace celadon {
namespace fs = std::filesystem;
namespace {

struct FormatEntry {
    ImageFormat format;
    const char* plugin; ///< OpenImageIO's name
    std::array<std::string_view, 2> extensions;
};

constexpr std::array<FormatEntry, 4> kFormats = {{{ImageFormat::Exr, "openexr", {".exr", ""}},
                                                  {ImageFormat::Png, "png", {".png", ""}},
                                                  {ImageFormat::Jpeg, "jpeg", {".jpg", ".jpeg"}},
                                                  {ImageFormat::Tiff, "tiff", {".tif", ".tiff"}}}};

/// No picture that Celadon writes or reads is larger: 2^30 floats are 4 GiB.
constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 30;
constexpr int kMaxSide = 65536;
constexpr int kMaxChannels = 1024;
/// How many values a byte of a file can stand for. Zip and deflate reach 1032 to 1; the rest is
/// slack for a few constant pictures in stronger codecs.
constexpr std::uint64_t kMaxValuesPerByte = 8192;
constexpr std::uint64_t kAlwaysAllowedValues = std::uint64_t{1} << 22;

std::string quote(const fs::path& path) {
    return fmt::format("'{}'", path.string());
}

std::string lowerExtension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

const char* pluginName(ImageFormat format) {
    return std::find_if(kFormats.begin(), kFormats.end(),
                        [&](const FormatEntry& entry) { return entry.format == format; })
        ->plugin;
}

/// Library messages may hold several lines; an error is one.
std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
        text.pop_back();
    }
    return text.empty() ? "unknown reason" : text;
}

std::uint64_t valueCount(int width, int height, std::size_t channels) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * channels;
}

void checkShape(const fs::path& file, const FloatImage& image) {
    if (image.width < 1 || image.height < 1 || image.channels.empty() ||
        image.pixels.size() != valueCount(image.width, image.height, image.channelCount())) {
        throw UsageError(quote(file), "the picture to be written is empty or of a wrong shape");
    }
}

void addAttributes(OIIO::ImageSpec& spec, const ImageAttributes& attributes) {
    for (const auto& [name, value] : attributes) {
        spec.attribute(name, value);
    }
}

/// With the library's reasons in our words.
template<typename T>
void encode(const fs::path& file, OIIO::ImageOutput& writer, const std::string& name,
            const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const std::vector<T>& values) {
    if (!writer.open(name, spec) || !writer.write_image(type, values.data()) || !writer.close()) {
        throw OutputError(quote(file),
                          fmt::format("encoding failed ({})", oneLine(writer.geterror())));
    }
}

template<typename T>
void encodeAndWrite(const fs::path& file, ImageFormat format, const OIIO::ImageSpec& spec,
                    OIIO::TypeDesc type, const std::vector<T>& values) {
    const auto writer = OIIO::ImageOutput::create(pluginName(format));
    if (!writer) {
        throw OutputError(quote(file), fmt::format("OpenImageIO cannot write {} ({})",
                                                   pluginName(format), oneLine(OIIO::geterror())));
    }
    if (format == ImageFormat::Tiff) {
        // libtiff reads back what it wrote, which a sink in memory does not offer.
        AtomicFile target(file);
        encode(file, *writer, target.temporaryPath().string(), spec, type, values);
        target.commit();
        return;
    }
    // In memory, so that the file is written by us alone, with its errors told apart.
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    writer->set_ioproxy(&sink);
    encode(file, *writer, file.filename().string(), spec, type, values);
    writeFileAtomically(file, std::as_bytes(std::span(bytes)));
}

template<typename T>
std::vector<T> quantize(const std::vector<float>& values) {
    constexpr float kLargest = static_cast<float>(std::numeric_limits<T>::max());
    std::vector<T> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(), [](float value) {
        const float unit = value > 0.0f ? std::min(value, 1.0f) : 0.0f; // NaN: 0
        return static_cast<T>(unit * kLargest + 0.5f);
    });
    return result;
}

void checkDisplaySettings(const fs::path& file, ImageFormat format, const FloatImage& image,
                          const DisplayFileSettings& settings) {
    const std::vector<std::string> rgb{"R", "G", "B"};
    const std::vector<std::string> rgba{"R", "G", "B", "A"};
    if (format == ImageFormat::Exr) {
        throw UsageError(quote(file), "EXR holds linear values, not display-encoded ones");
    }
    if (image.channels != rgb && image.channels != rgba) {
        throw UsageError(quote(file),
                         fmt::format("only R,G,B and R,G,B,A fit a {} file", pluginName(format)));
    }
    if (image.channels == rgba && !holdsAlpha(format)) {
        throw UsageError(quote(file), "JPEG cannot hold transparency",
                         "give a background or choose PNG");
    }
    if (settings.bits != 8 && !(settings.bits == 16 && holdsAlpha(format))) {
        throw UsageError(quote(file), fmt::format("{} bits a channel do not fit a {} file",
                                                  settings.bits, pluginName(format)));
    }
}

/// libpng prints its errors besides returning them; the exception that follows says the same in
/// one line. Affects the whole process, so it stays around calls to the library only.
class SilentStderr {
public:
    SilentStderr() {
        std::fflush(stderr);
        mSaved = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
        const int sink = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (mSaved >= 0 && sink >= 0) {
            ::dup2(sink, STDERR_FILENO);
        }
        if (sink >= 0) {
            ::close(sink);
        }
    }
    ~SilentStderr() {
        if (mSaved >= 0) {
            std::fflush(stderr);
            ::dup2(mSaved, STDERR_FILENO);
            ::close(mSaved);
        }
    }
    SilentStderr(const SilentStderr&) = delete;
    SilentStderr& operator=(const SilentStderr&) = delete;

private:
    int mSaved = -1;
};

void checkReadable(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) {
        throw InputError(quote(file), "no such file", "check the path");
    }
    if (fs::is_directory(status)) {
        throw InputError(quote(file), "is a folder, not a picture", "name a file in it");
    }
    if (!fs::is_regular_file(status)) {
        throw InputError(quote(file), "is not a regular file");
    }
    if (fs::file_size(file, error) == 0) {
        throw InputError(quote(file), "the file is empty");
    }
}

void checkHeader(const fs::path& file, const OIIO::ImageSpec& spec) {
    const auto badSide = [](int side) { return side < 1 || side > kMaxSide; };
    if (badSide(spec.width) || badSide(spec.height) || badSide(spec.full_width) ||
        badSide(spec.full_height) || spec.depth > 1) {
        throw InputError(quote(file),
                         fmt::format("its size {}x{} (shown {}x{}) is outside 1..{}", spec.width,
                                     spec.height, spec.full_width, spec.full_height, kMaxSide));
    }
    if (spec.nchannels < 1 || spec.nchannels > kMaxChannels) {
        throw InputError(quote(file), fmt::format("its {} channels are outside 1..{}",
                                                  spec.nchannels, kMaxChannels));
    }
    std::error_code error;
    const std::uint64_t bytes = fs::file_size(file, error);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    const std::uint64_t values = std::max(valueCount(spec.width, spec.height, channels),
                                          valueCount(spec.full_width, spec.full_height, channels));
    if (values > kMaxValues) {
        throw InputError(quote(file),
                         fmt::format("{}x{} pixels of {} channels are too large a picture",
                                     spec.full_width, spec.full_height, channels),
                         "make it smaller");
    }
    if (values > kAlwaysAllowedValues && values / kMaxValuesPerByte > bytes) {
        throw InputError(quote(file),
                         fmt::format("{} bytes cannot hold the {}x{} pixels that it announces",
                                     bytes, spec.width, spec.height),
                         "the file is damaged");
    }
}

/// R,G,B,A first, then the others in the file's order (EXR: by name).
std::vector<int> channelOrder(const OIIO::ImageSpec& spec) {
    std::vector<int> order;
    for (const char* name : {"R", "G", "B", "A"}) {
        const int index = spec.channelindex(name);
        if (index >= 0) {
            order.push_back(index);
        }
    }
    for (int c = 0; c < spec.nchannels; ++c) {
        if (std::find(order.begin(), order.end(), c) == order.end()) {
            order.push_back(c);
        }
    }
    return order;
}

/// The data window's values as they are stored. @param spec receives the header
std::vector<float> readPixels(const fs::path& file, OIIO::ImageSpec& spec) {
    const SilentStderr silence;
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const auto reader = OIIO::ImageInput::open(file.string(), &hints);
    if (!reader) {
        throw InputError(quote(file),
                         fmt::format("is no readable picture ({})", oneLine(OIIO::geterror())));
    }
    spec = reader->spec();
    checkHeader(file, spec);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> data(valueCount(spec.width, spec.height, channels));
    if (!reader->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, data.data())) {
        throw InputError(quote(file),
                         fmt::format("its pixels cannot be read ({})", oneLine(reader->geterror())),
                         "the file is damaged");
    }
    return data;
}

/// sRGB-encoded straight color, as integer files have it, to linear and premultiplied.
void linearize(FloatImage& image) {
    const int alpha = image.channelIndex("A");
    const std::size_t stride = image.channelCount();
    for (std::size_t i = 0; i < image.pixels.size(); i += stride) {
        float* pixel = image.pixels.data() + i;
        const float coverage = alpha >= 0 ? pixel[alpha] : 1.0f;
        for (std::size_t c = 0; c < stride; ++c) {
            if (static_cast<int>(c) != alpha) {
                pixel[c] = decodeSrgb(pixel[c]) * coverage;
            }
        }
    }
}

} // namespace

ImageFormat imageFormat(const fs::path& file) {
    const std::string extension = lowerExtension(file);
    for (const FormatEntry& entry : kFormats) {
        for (const std::string_view known : entry.extensions) {
            if (!extension.empty() && extension == known) {
                return entry.format;
            }
        }
    }
    throw UsageError(quote(file),
                     extension.empty()
                         ? "the picture's name has no extension that tells its format"
                         : fmt::format("'{}' is no picture format that can be written", extension),
                     "choose .exr, .png, .jpg, .jpeg, .tif or .tiff");
}

bool holdsAlpha(ImageFormat format) {
    return format != ImageFormat::Jpeg;
}

void writeExr(const fs::path& file, const FloatImage& image, const ExrSettings& settings) {
    if (imageFormat(file) != ImageFormat::Exr) {
        throw UsageError(quote(file), "linear channels need an EXR file", "choose .exr");
    }
    checkShape(file, image);
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channelCount()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.alpha_channel = image.channelIndex("A");
    for (const std::string& name : image.channels) {
        const bool isColor = name == "R" || name == "G" || name == "B" || name == "A";
        spec.channelformats.emplace_back(settings.halfColor && isColor ? OIIO::TypeDesc::HALF
                                                                       : OIIO::TypeDesc::FLOAT);
    }
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", kNoDate);
    spec.attribute("oiio:ColorSpace", "Linear");
    addAttributes(spec, settings.attributes);
    encodeAndWrite(file, ImageFormat::Exr, spec, OIIO::TypeDesc::FLOAT, image.pixels);
}

void writeDisplayImage(const fs::path& file, const FloatImage& image,
                       const DisplayFileSettings& settings) {
    const ImageFormat format = imageFormat(file);
    checkShape(file, image);
    checkDisplaySettings(file, format, image, settings);
    const OIIO::TypeDesc type =
        settings.bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channelCount()), type);
    spec.channelnames = image.channels;
    spec.alpha_channel = image.channelIndex("A");
    spec.attribute("oiio:ColorSpace", "sRGB");
    // The values are as the file wants them; without this the library would divide by alpha.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (format == ImageFormat::Jpeg) {
        const int quality = std::clamp(settings.jpegQuality, 1, 100);
        spec.attribute("compression", fmt::format("jpeg:{}", quality));
        spec.attribute("jpeg:subsampling", "4:4:4"); // thin colored edges stay clean
    } else if (format == ImageFormat::Tiff) {
        spec.attribute("compression", "zip");
        spec.attribute("DateTime", kNoDate);
    }
    addAttributes(spec, settings.attributes);
    if (settings.bits == 16) {
        encodeAndWrite(file, format, spec, type, quantize<std::uint16_t>(image.pixels));
    } else {
        encodeAndWrite(file, format, spec, type, quantize<std::uint8_t>(image.pixels));
    }
}

ReadImage readImage(const fs::path& file) {
    checkReadable(file);
    OIIO::ImageSpec spec;
    const std::vector<float> data = readPixels(file, spec);
    const auto channels = static_cast<std::size_t>(spec.nchannels);

    const std::vector<int> order = channelOrder(spec);
    ReadImage result;
    FloatImage& image = result.image;
    image.width = spec.full_width;
    image.height = spec.full_height;
    for (const int c : order) {
        image.channels.push_back(spec.channel_name(c));
    }
    image.pixels.assign(valueCount(image.width, image.height, channels), 0.0f);

    const int left = spec.x - spec.full_x;
    const int top = spec.y - spec.full_y;
    for (int y = std::max(0, top); y < std::min(image.height, top + spec.height); ++y) {
        for (int x = std::max(0, left); x < std::min(image.width, left + spec.width); ++x) {
            const std::size_t from = (static_cast<std::size_t>(y - top) * spec.width +
                                      static_cast<std::size_t>(x - left)) *
                                     channels;
            const std::size_t to =
                (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)) *
                channels;
            for (std::size_t c = 0; c < channels; ++c) {
                image.pixels[to + c] = data[from + static_cast<std::size_t>(order[c])];
            }
        }
    }

    const bool integers = !spec.format.is_floating_point();
    const std::string colorSpace = spec.get_string_attribute("oiio:ColorSpace");
    result.displayEncoded = integers && !OIIO::Strutil::iequals(colorSpace, "linear");
    if (result.displayEncoded) {
        linearize(image);
    }
    return result;
}

} // namespace celadon
