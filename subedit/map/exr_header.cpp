#include "subedit/map/exr_header.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <fstream>

namespace celadon::subedit {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxNameLength = 255;
constexpr std::uint64_t kMaxKeptAttribute = 1 << 16;
constexpr std::uint64_t kMaxChannelList = 1 << 20;
constexpr int kMaxSide = 32768;
/// Deflate, the strongest of the format's lossless codecs, cannot shrink by more than 1032.
constexpr double kMaxCompression = 1100.0;
/// Up to this, whatever is claimed is harmless.
constexpr double kHarmlessBytes = 64.0 * 1024 * 1024;

/// Little-endian reader that knows where the file ends.
class HeaderReader {
public:
    explicit HeaderReader(const fs::path& file) : mFile(file), mStream(file, std::ios::binary) {
        std::error_code error;
        if (!fs::exists(file, error)) {
            fail("no such file");
        }
        if (!fs::is_regular_file(file, error)) {
            fail("is not a file");
        }
        mSize = fs::file_size(file, error);
        if (error || !mStream) {
            fail("cannot be opened", "check its permissions");
        }
    }

    [[noreturn]] void fail(const std::string& reason, const std::string& remedy = {}) const {
        throw InputError(fmt::format("'{}'", mFile.string()), reason, remedy);
    }

    [[nodiscard]] std::uint64_t size() const { return mSize; }
    [[nodiscard]] std::uint64_t remaining() const { return mSize - mPosition; }

    [[nodiscard]] std::string bytes(std::uint64_t count) {
        if (count > remaining()) {
            fail("is cut short within its header");
        }
        std::string data(static_cast<std::size_t>(count), '\0');
        mStream.read(data.data(), static_cast<std::streamsize>(count));
        if (!mStream) {
            fail("cannot be read");
        }
        mPosition += count;
        return data;
    }

    void skip(std::uint64_t count) {
        if (count > remaining()) {
            fail("is cut short within its header");
        }
        mPosition += count;
        mStream.seekg(static_cast<std::streamoff>(mPosition));
    }

    [[nodiscard]] std::uint32_t uint32();

    /// A zero-terminated name.
    [[nodiscard]] std::string name() {
        std::string result;
        for (;;) {
            const char c = bytes(1)[0];
            if (c == '\0') {
                return result;
            }
            if (result.size() >= kMaxNameLength) {
                fail("has a name of over 255 characters in its header");
            }
            result.push_back(c);
        }
    }

private:
    fs::path mFile;
    std::ifstream mStream;
    std::uint64_t mSize = 0;
    std::uint64_t mPosition = 0;
};

std::uint32_t uint32At(const std::string& data, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
        value = value << 8 | static_cast<std::uint8_t>(data[offset + i]);
    }
    return value;
}

std::uint32_t HeaderReader::uint32() {
    return uint32At(bytes(4), 0);
}

void readChannels(const HeaderReader& reader, const std::string& data, ExrHeader& header) {
    std::size_t at = 0;
    while (at < data.size() && data[at] != '\0') {
        const std::size_t end = data.find('\0', at);
        if (end == std::string::npos || data.size() - end < 17) {
            reader.fail("has a damaged channel list");
        }
        const std::string name = data.substr(at, end - at);
        const std::uint32_t type = uint32At(data, end + 1);
        if (type > 2) {
            reader.fail(fmt::format("channel '{}' has unknown type {}", name, type));
        }
        if (uint32At(data, end + 9) != 1 || uint32At(data, end + 13) != 1) {
            reader.fail(fmt::format("channel '{}' is subsampled", name),
                        "save it at full resolution");
        }
        header.channels.emplace(name, static_cast<ExrHeader::PixelType>(type));
        at = end + 17;
    }
    if (at >= data.size()) {
        reader.fail("has a damaged channel list");
    }
}

void readDataWindow(const HeaderReader& reader, const std::string& data, ExrHeader& header) {
    const auto edge = [&](std::size_t i) {
        return static_cast<std::int64_t>(static_cast<std::int32_t>(uint32At(data, i * 4)));
    };
    const std::int64_t width = edge(2) - edge(0) + 1;
    const std::int64_t height = edge(3) - edge(1) + 1;
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
        reader.fail(fmt::format("claims {} x {} pixels; 1 to {} a side are possible", width, height,
                                kMaxSide));
    }
    header.width = static_cast<int>(width);
    header.height = static_cast<int>(height);
}

/// Scan lines a chunk holds, by the format's number of the compression.
int linesPerChunk(int compression) {
    constexpr int kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return compression >= 0 && compression < 10 ? kLines[compression] : 1;
}

void checkSize(const HeaderReader& reader, const ExrHeader& header, int compression, bool isTiled) {
    double bytesPerPixel = 0.0;
    for (const auto& [name, type] : header.channels) {
        bytesPerPixel += type == ExrHeader::PixelType::Half ? 2.0 : 4.0;
    }
    const double pixelBytes = bytesPerPixel * header.width * header.height;
    const auto fileBytes = static_cast<double>(reader.size());
    // Each chunk has an 8-byte place in the table of offsets, and 8 bytes before its data.
    const int lines = linesPerChunk(compression);
    const double chunkBytes = isTiled ? 0.0 : 16.0 * ((header.height + lines - 1) / lines);
    if (chunkBytes > static_cast<double>(reader.remaining()) ||
        pixelBytes > std::max(kHarmlessBytes, kMaxCompression * fileBytes) ||
        (compression == 0 && pixelBytes > fileBytes)) {
        reader.fail(fmt::format("claims {} x {} pixels in {} channels, which its {} bytes cannot "
                                "hold",
                                header.width, header.height, header.channels.size(), reader.size()),
                    "it is damaged or was cut short: fetch or bake it again");
    }
}

const ExrHeader::Attribute& find(const ExrHeader& header, const fs::path& file,
                                 const std::string& name, const std::string& type) {
    const auto found = header.attributes.find(name);
    const std::string subject = fmt::format("'{}', attribute '{}'", file.string(), name);
    if (found == header.attributes.end()) {
        throw InputError(subject, "is missing", "is it a SubEdit material?");
    }
    if (found->second.type != type) {
        throw InputError(subject,
                         fmt::format("is of type '{}' instead of '{}'", found->second.type, type));
    }
    if (type != "string" && found->second.data.size() != 4) {
        throw InputError(subject,
                         fmt::format("has {} bytes instead of 4", found->second.data.size()));
    }
    return found->second;
}

} // namespace

int ExrHeader::intAttribute(const fs::path& file, const std::string& name) const {
    return static_cast<int>(uint32At(find(*this, file, name, "int").data, 0));
}

float ExrHeader::floatAttribute(const fs::path& file, const std::string& name) const {
    return std::bit_cast<float>(uint32At(find(*this, file, name, "float").data, 0));
}

std::string ExrHeader::stringAttribute(const fs::path& file, const std::string& name) const {
    return find(*this, file, name, "string").data;
}

ExrHeader readExrHeader(const fs::path& file) {
    HeaderReader reader(file);
    constexpr std::uint32_t kMagic = 0x01312f76;
    if (reader.size() < 8 || reader.uint32() != kMagic) {
        reader.fail("is not an OpenEXR file");
    }
    const std::uint32_t version = reader.uint32();
    const bool isTiled = (version & 0x200) != 0;
    if ((version & 0xff) != 2 || (version & 0x1800) != 0) {
        reader.fail("is a multi-part, deep or unknown kind of OpenEXR",
                    "save it as one flat image");
    }
    ExrHeader header;
    int compression = -1;
    bool hasWindow = false;
    for (std::string name = reader.name(); !name.empty(); name = reader.name()) {
        const std::string type = reader.name();
        const std::uint32_t size = reader.uint32();
        if (name == "channels" && type == "chlist" && size <= kMaxChannelList) {
            readChannels(reader, reader.bytes(size), header);
        } else if (name == "dataWindow" && type == "box2i" && size == 16) {
            readDataWindow(reader, reader.bytes(size), header);
            hasWindow = true;
        } else if (name == "compression" && size == 1) {
            compression = static_cast<std::uint8_t>(reader.bytes(1)[0]);
        } else if (name.starts_with("subedit:") && size <= kMaxKeptAttribute) {
            header.attributes[name] = {type, reader.bytes(size)};
        } else {
            reader.skip(size);
        }
    }
    if (header.channels.empty() || !hasWindow || compression < 0) {
        reader.fail("lacks its channel list, data window or compression");
    }
    checkSize(reader, header, compression, isTiled);
    return header;
}

} // namespace celadon::subedit
