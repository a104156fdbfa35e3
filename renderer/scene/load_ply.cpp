#include "renderer/scene/load_ply.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_ply_header.h"
#include "renderer/scene/load_soup.h"
#include "renderer/scene/load_text.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace celadon::loaders {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is read as it lies");

/// Scalars one after the other, whatever the encoding.
class PlyStream {
public:
    PlyStream(const std::filesystem::path& file, std::string_view content, const PlyHeader& header)
        : mFile(file),
          mContent(content),
          mAt(header.dataOffset),
          mScanner(file, content.substr(header.dataOffset), 0),
          mFormat(header.format),
          mFirstLine(header.lines) {}

    [[nodiscard]] bool isText() const { return mFormat == PlyFormat::Ascii; }

    [[nodiscard]] std::size_t remaining() const {
        return isText() ? mScanner.remaining() : mContent.size() - mAt;
    }

    double next(PlyType type) {
        if (isText()) {
            return nextWord(type);
        }
        const std::size_t size = sizeOf(type);
        if (mContent.size() - mAt < size) {
            fail("the file ends in the middle of it");
        }
        unsigned char bytes[8];
        std::memcpy(bytes, mContent.data() + mAt, size);
        mAt += size;
        if (mFormat == PlyFormat::BinaryBigEndian) {
            std::reverse(bytes, bytes + size);
        }
        switch (type) {
        case PlyType::Int8:
            return as<std::int8_t>(bytes);
        case PlyType::UInt8:
            return as<std::uint8_t>(bytes);
        case PlyType::Int16:
            return as<std::int16_t>(bytes);
        case PlyType::UInt16:
            return as<std::uint16_t>(bytes);
        case PlyType::Int32:
            return as<std::int32_t>(bytes);
        case PlyType::UInt32:
            return as<std::uint32_t>(bytes);
        case PlyType::Float32:
            return as<float>(bytes);
        case PlyType::Float64:
            return as<double>(bytes);
        }
        return 0.0;
    }

    /// The length of a list, held against what is left of the file.
    std::uint64_t nextLength(const PlyProperty& property) {
        const double length = next(property.countType);
        const std::size_t least = isText() ? 1 : sizeOf(property.type);
        if (!(length >= 0.0) || length != std::floor(length) ||
            length > static_cast<double>(remaining() / least + 1)) {
            fail(fmt::format("list '{}' has a length of {}, but {} bytes follow",
                             excerpt(property.name), length, remaining()));
        }
        return static_cast<std::uint64_t>(length);
    }

    /// Where messages say to look: "vertex 12".
    void setPlace(std::string_view element, std::uint64_t number) {
        mElement = element;
        mNumber = number;
    }

    [[nodiscard]] std::uint64_t line() const { return mFirstLine + mScanner.line(); }

    [[noreturn]] void fail(const std::string& reason,
                           const std::string& remedy = "export the model again") const {
        const std::string where =
            isText() ? fmt::format("{}, line {}", quoted(mFile), line())
                     : fmt::format("{}, {} {}", quoted(mFile), excerpt(mElement), mNumber);
        throw InputError(where, reason, remedy);
    }

private:
    const std::filesystem::path& mFile;
    std::string_view mContent;
    std::size_t mAt;
    TextScanner mScanner;
    PlyFormat mFormat;
    std::uint64_t mFirstLine;
    std::string_view mElement;
    std::uint64_t mNumber = 0;

    template<typename T>
    static double as(const unsigned char* bytes) {
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return static_cast<double>(value);
    }

    double nextWord(PlyType type) {
        const std::string_view word = mScanner.word();
        if (word.empty()) {
            fail(fmt::format("the file ends within {} {}", excerpt(mElement), mNumber));
        }
        const auto value = parseNumber(word);
        if (!value) {
            fail(fmt::format("'{}' is not a number", excerpt(word)));
        }
        if (!isReal(type) && *value != std::floor(*value)) {
            fail(fmt::format("'{}' is not a whole number", excerpt(word)));
        }
        return *value;
    }
};

class PlyReader {
public:
    PlyReader(const std::filesystem::path& file, std::string_view content)
        : mFile(file), mHeader(readPlyHeader(file, content)), mStream(file, content, mHeader) {}

    Scene read() {
        for (const PlyElement& element : mHeader.elements) {
            // A record takes at least its scalars and the lengths of its lists.
            if (element.leastBytes(mStream.isText()) > 0 &&
                element.count > mStream.remaining() / element.leastBytes(mStream.isText()) + 1) {
                throw InputError(quoted(mFile),
                                 fmt::format("{} of '{}' are promised, but only {} bytes follow",
                                             element.count, excerpt(element.name),
                                             mStream.remaining()),
                                 "the file is cut short: export it again");
            }
            if (element.properties.empty()) {
                continue;
            }
            if (element.name == "vertex") {
                readVertices(element);
            } else if (element.name == "face") {
                readFaces(element);
            } else if (element.name == "tristrips") {
                readStrips(element);
            } else {
                skip(element);
            }
        }
        checkIndices();
        if (mShortFaces > 0) {
            mWarnings.push_back(fmt::format("{}: skipped {} with fewer than three corners",
                                            quoted(mFile), counted(mShortFaces, "face")));
        }
        return makeScene(std::move(mSoup), mFile, std::move(mWarnings));
    }

private:
    const std::filesystem::path& mFile;
    PlyHeader mHeader;
    PlyStream mStream;
    PolygonSoup mSoup;
    std::vector<std::string> mWarnings;
    std::uint64_t mShortFaces = 0;
    bool mVertexUvs = false, mVertexNormals = false; // then one per position, in the same order

    void skipProperty(const PlyProperty& property) {
        const std::uint64_t count = property.isList ? mStream.nextLength(property) : 1;
        for (std::uint64_t i = 0; i < count; ++i) {
            (void)mStream.next(property.type);
        }
    }

    void skip(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            mStream.setPlace(element.name, i);
            for (const PlyProperty& property : element.properties) {
                skipProperty(property);
            }
        }
    }

    void readVertices(const PlyElement& element) {
        // Slots: position 0-2, normal 3-5, texture coordinate 6-7; 8 is nothing of ours.
        constexpr std::size_t kNothing = 8;
        std::vector<std::size_t> slots;
        std::array<bool, kNothing + 1> has{};
        for (const PlyProperty& property : element.properties) {
            const std::size_t slot = property.isList ? kNothing : vertexSlot(property.name);
            slots.push_back(has[slot] ? kNothing : slot);
            has[slot] = slot != kNothing;
        }
        if (!mSoup.positions.empty()) {
            throw InputError(quoted(mFile), "has two elements named 'vertex'", "export it again");
        }
        if (!has[0] || !has[1] || !has[2]) {
            throw InputError(quoted(mFile), "its vertices lack x, y or z", "export it again");
        }
        mVertexNormals = has[3] && has[4] && has[5];
        mVertexUvs = has[6] && has[7];
        mSoup.positions.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            mStream.setPlace(element.name, i);
            std::array<float, kNothing> value{};
            for (std::size_t k = 0; k < slots.size(); ++k) {
                if (slots[k] == kNothing) {
                    skipProperty(element.properties[k]);
                } else {
                    value[slots[k]] = toFloat(mStream.next(element.properties[k].type));
                }
            }
            if (!std::isfinite(value[0]) || !std::isfinite(value[1]) || !std::isfinite(value[2])) {
                mStream.fail("a coordinate is not finite", "repair the mesh where it was made");
            }
            mSoup.positions.emplace_back(value[0], value[1], value[2]);
            if (mVertexNormals) {
                mSoup.normals.emplace_back(value[3], value[4], value[5]);
            }
            if (mVertexUvs) {
                addUv(value[6], value[7]);
            }
        }
    }

    static float toFloat(double value) {
        constexpr double kLargest = 3.4028234663852886e38;
        return std::abs(value) <= kLargest ? static_cast<float>(value)
                                           : std::numeric_limits<float>::quiet_NaN();
    }

    void addUv(float u, float v) {
        if (!std::isfinite(u) || !std::isfinite(v)) {
            mStream.fail("a texture coordinate is not finite", "repair the mesh where it was made");
        }
        mSoup.uvs.emplace_back(u, 1.0f - v);
    }

    static std::size_t vertexSlot(std::string_view name) {
        static constexpr std::array<std::pair<std::string_view, std::size_t>, 14> kSlots{
            {{"x", 0},
             {"y", 1},
             {"z", 2},
             {"nx", 3},
             {"ny", 4},
             {"nz", 5},
             {"s", 6},
             {"t", 7},
             {"u", 6},
             {"v", 7},
             {"texture_u", 6},
             {"texture_v", 7},
             {"tx", 6},
             {"ty", 7}}};
        for (const auto& [known, slot] : kSlots) {
            if (name == known) {
                return slot;
            }
        }
        return 8;
    }

    /// A list of vertex indices, kept as they come: they are held against the vertices at the end.
    void readIndices(const PlyProperty& property, std::vector<std::int64_t>& indices) {
        indices.clear();
        const std::uint64_t count = mStream.nextLength(property);
        for (std::uint64_t i = 0; i < count; ++i) {
            indices.push_back(
                static_cast<std::int64_t>(std::clamp(mStream.next(property.type), -9e15, 9e15)));
        }
    }

    static const PlyProperty* findIndices(const PlyElement& element) {
        for (const PlyProperty& property : element.properties) {
            if (property.isList && !isReal(property.type) &&
                (property.name == "vertex_indices" || property.name == "vertex_index")) {
                return &property;
            }
        }
        return nullptr;
    }

    [[nodiscard]] std::uint32_t checked(std::int64_t index) const {
        if (index < 0 || index >= PolygonSoup::kNone) {
            mStream.fail(fmt::format("vertex index {} is out of range", index));
        }
        return static_cast<std::uint32_t>(index);
    }

    void endFace() {
        mSoup.faceEnds.push_back(static_cast<std::uint32_t>(mSoup.corners.size()));
        if (mStream.isText()) {
            mSoup.faceLines.push_back(static_cast<std::uint32_t>(mStream.line()));
        }
    }

    void readFaces(const PlyElement& element) {
        const PlyProperty* const indexList = findIndices(element);
        if (indexList == nullptr) {
            throw InputError(quoted(mFile),
                             "its faces have no list of whole numbers named "
                             "'vertex_indices'",
                             "export it again");
        }
        std::vector<std::int64_t> indices;
        std::vector<float> texcoords;
        for (std::uint64_t face = 0; face < element.count; ++face) {
            mStream.setPlace(element.name, face);
            texcoords.clear();
            for (const PlyProperty& property : element.properties) {
                if (&property == indexList) {
                    readIndices(property, indices);
                } else if (property.isList && property.name == "texcoord") {
                    const std::uint64_t count = mStream.nextLength(property);
                    for (std::uint64_t i = 0; i < count; ++i) {
                        texcoords.push_back(toFloat(mStream.next(property.type)));
                    }
                } else {
                    skipProperty(property);
                }
            }
            if (indices.size() < 3) {
                ++mShortFaces;
                continue;
            }
            const bool cornerUvs = texcoords.size() == 2 * indices.size();
            for (std::size_t k = 0; k < indices.size(); ++k) {
                const std::uint32_t index = checked(indices[k]);
                PolygonSoup::Corner corner{index};
                if (cornerUvs) {
                    corner.uv = static_cast<std::uint32_t>(mSoup.uvs.size());
                    addUv(texcoords[2 * k], texcoords[2 * k + 1]);
                } else if (mVertexUvs) {
                    corner.uv = index;
                }
                corner.normal = mVertexNormals ? index : PolygonSoup::kNone;
                mSoup.corners.push_back(corner);
            }
            endFace();
        }
    }

    /// Strips of triangles, each ended by -1; every other triangle turns the other way.
    void readStrips(const PlyElement& element) {
        const PlyProperty* const indexList = findIndices(element);
        std::vector<std::int64_t> indices;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            mStream.setPlace(element.name, i);
            for (const PlyProperty& property : element.properties) {
                if (&property == indexList) {
                    readIndices(property, indices);
                    addStrips(indices);
                } else {
                    skipProperty(property);
                }
            }
        }
    }

    void addStrips(std::span<const std::int64_t> indices) {
        std::size_t start = 0;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] == -1) {
                start = i + 1;
            } else if (i >= start + 2) {
                const bool odd = (i - start) % 2 == 1;
                for (const std::size_t k : {odd ? i - 1 : i - 2, odd ? i - 2 : i - 1, i}) {
                    const std::uint32_t index = checked(indices[k]);
                    mSoup.corners.push_back({index, mVertexUvs ? index : PolygonSoup::kNone,
                                             mVertexNormals ? index : PolygonSoup::kNone});
                }
                endFace();
            }
        }
    }

    void checkIndices() const {
        std::size_t face = 0;
        for (std::size_t i = 0; i < mSoup.corners.size(); ++i) {
            while (mSoup.faceEnds[face] <= i) {
                ++face;
            }
            if (mSoup.corners[i].position >= mSoup.positions.size()) {
                throw InputError(mStream.isText() ? fmt::format("{}, line {}", quoted(mFile),
                                                                mSoup.faceLines[face])
                                                  : fmt::format("{}, face {}", quoted(mFile), face),
                                 fmt::format("vertex index {} is past the {} vertices of the file",
                                             mSoup.corners[i].position, mSoup.positions.size()),
                                 "export the model again");
            }
        }
    }
};

} // namespace

Scene loadPly(const std::filesystem::path& file, std::string_view content) {
    return PlyReader(file, content).read();
}

} // namespace celadon::loaders
