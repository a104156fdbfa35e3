#include "renderer/scene/load_obj.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_soup.h"
#include "renderer/scene/load_text.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace celadon::loaders {

namespace {

class ObjReader {
public:
    ObjReader(const std::filesystem::path& file, std::string_view content)
        : mFile(file), mScanner(file, content, '#') {}

    Scene read() {
        do {
            readLine();
        } while (mScanner.nextLine());
        resolveIndices();
        addWarnings();
        return makeScene(std::move(mSoup), mFile, std::move(mWarnings));
    }

private:
    const std::filesystem::path& mFile;
    TextScanner mScanner;
    PolygonSoup mSoup;
    std::vector<std::string> mWarnings;
    std::uint64_t mSkippedElements = 0, mSkippedFreeForm = 0, mShortFaces = 0, mUnknownLines = 0;
    std::uint64_t mFirstUnknownLine = 0;
    std::string mFirstUnknown;

    void readLine() {
        const std::string_view keyword = mScanner.wordOnLine();
        if (keyword.empty()) {
            return;
        }
        if (keyword == "v") {
            readPosition();
        } else if (keyword == "vt") {
            readUv();
        } else if (keyword == "vn") {
            readNormal();
        } else if (keyword == "f" || keyword == "fo") { // fo: the spelling of version 2.11
            readFace();
        } else if (keyword == "l" || keyword == "p") {
            ++mSkippedElements;
        } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
            ++mSkippedFreeForm;
        } else if (!isHarmless(keyword)) {
            if (mUnknownLines++ == 0) {
                mFirstUnknown = excerpt(keyword);
                mFirstUnknownLine = mScanner.line();
            }
        }
    }

    static bool isHarmless(std::string_view keyword) {
        static constexpr std::array kKnown{
            "g",      "o",     "s",     "mg",       "usemtl",   "mtllib",     "usemap",
            "maplib", "lod",   "bevel", "vp",       "cstype",   "deg",        "bmat",
            "step",   "parm",  "trim",  "hole",     "scrv",     "sp",         "end",
            "con",    "call",  "csh",   "c_interp", "d_interp", "shadow_obj", "trace_obj",
            "ctech",  "stech", "mapid"};
        for (const char* const known : kKnown) {
            if (keyword == known) {
                return true;
            }
        }
        return false;
    }

    void readPosition() {
        glm::vec3 p;
        p.x = mScanner.number(mScanner.wordOnLine(), "x of a vertex");
        p.y = mScanner.number(mScanner.wordOnLine(), "y of a vertex");
        p.z = mScanner.number(mScanner.wordOnLine(), "z of a vertex");
        mSoup.positions.push_back(p); // a weight or a color may follow
    }

    void readUv() {
        glm::vec2 uv(0.0f);
        uv.x = mScanner.number(mScanner.wordOnLine(), "u of a texture coordinate");
        const std::string_view second = mScanner.wordOnLine();
        uv.y = second.empty() ? 0.0f : mScanner.number(second, "v of a texture coordinate");
        mSoup.uvs.emplace_back(uv.x, 1.0f - uv.y);
    }

    void readNormal() {
        glm::vec3 n(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = mScanner.wordOnLine();
            const auto value = parseNumber(word);
            if (word.empty() || (!value && word.find_first_of("nN") == std::string_view::npos)) {
                n[axis] = mScanner.number(word, "a component of a normal"); // throws
            }
            // Exporters write NaN, also as "-nan(ind)", for degenerate faces: such are computed.
            n[axis] = value ? static_cast<float>(*value) : std::numeric_limits<float>::quiet_NaN();
        }
        mSoup.normals.push_back(n);
    }

    /// OBJ counts from 1; negative numbers count back from the last one read.
    [[nodiscard]] std::uint32_t index(std::string_view word, std::size_t soFar,
                                      std::string_view what) const {
        const std::int64_t value = mScanner.integer(word, what);
        const std::int64_t absolute =
            value < 0 ? static_cast<std::int64_t>(soFar) + value : value - 1;
        if (value == 0) {
            mScanner.fail(fmt::format("{} is 0; OBJ counts from 1", what));
        }
        if (absolute < 0) {
            mScanner.fail(
                fmt::format("{} {} goes back past the {} read so far", what, value, soFar));
        }
        if (absolute >= PolygonSoup::kNone) {
            mScanner.fail(fmt::format("{} {} is out of range", what, value));
        }
        return static_cast<std::uint32_t>(absolute);
    }

    [[nodiscard]] PolygonSoup::Corner corner(std::string_view word) const {
        PolygonSoup::Corner result;
        const std::size_t first = word.find('/');
        result.position = index(word.substr(0, first), mSoup.positions.size(), "vertex index");
        if (first == std::string_view::npos) {
            return result;
        }
        word.remove_prefix(first + 1);
        const std::size_t second = word.find('/');
        const std::string_view uv = word.substr(0, second);
        if (!uv.empty()) {
            result.uv = index(uv, mSoup.uvs.size(), "texture coordinate index");
        }
        if (second != std::string_view::npos && second + 1 < word.size()) {
            result.normal = index(word.substr(second + 1), mSoup.normals.size(), "normal index");
        }
        return result;
    }

    void readFace() {
        const std::size_t begin = mSoup.corners.size();
        const std::uint64_t line = mScanner.line();
        for (std::string_view word = mScanner.wordOnLine(); !word.empty();
             word = mScanner.wordOnLine()) {
            mSoup.corners.push_back(corner(word));
        }
        if (mSoup.corners.size() - begin < 3) {
            mSoup.corners.resize(begin);
            ++mShortFaces;
            return;
        }
        mSoup.faceEnds.push_back(static_cast<std::uint32_t>(mSoup.corners.size()));
        mSoup.faceLines.push_back(static_cast<std::uint32_t>(line));
    }

    void resolveIndices() const {
        std::size_t face = 0;
        for (std::size_t i = 0; i < mSoup.corners.size(); ++i) {
            while (mSoup.faceEnds[face] <= i) {
                ++face;
            }
            const PolygonSoup::Corner& corner = mSoup.corners[i];
            const auto check = [&](std::uint32_t index, std::size_t size, const char* what,
                                   const char* whats) {
                if (index != PolygonSoup::kNone && index >= size) {
                    throw InputError(mScanner.whereIs(mSoup.faceLines[face]),
                                     fmt::format("{} index {} is past the {} {} of the file", what,
                                                 std::uint64_t{index} + 1, size, whats),
                                     "export the model again");
                }
            };
            check(corner.position, mSoup.positions.size(), "vertex", "vertices");
            check(corner.uv, mSoup.uvs.size(), "texture coordinate", "texture coordinates");
            check(corner.normal, mSoup.normals.size(), "normal", "normals");
        }
    }

    void addWarnings() {
        const auto add = [&](const std::string& text) {
            mWarnings.push_back(fmt::format("{}: {}", quoted(mFile), text));
        };
        if (mSkippedElements > 0) {
            add(fmt::format("skipped {} of points or lines", counted(mSkippedElements, "element")));
        }
        if (mSkippedFreeForm > 0) {
            add(fmt::format("skipped {}; export polygons to see them",
                            counted(mSkippedFreeForm, "free-form curve or surface")));
        }
        if (mShortFaces > 0) {
            add(fmt::format("skipped {} with fewer than three corners",
                            counted(mShortFaces, "face")));
        }
        if (mUnknownLines > 0) {
            add(fmt::format("skipped {} of unknown kind, the first being '{}' in line {}",
                            counted(mUnknownLines, "line"), mFirstUnknown, mFirstUnknownLine));
        }
    }
};

} // namespace

Scene loadObj(const std::filesystem::path& file, std::string_view content) {
    if (content.find('\0') != std::string_view::npos) {
        throw InputError(quoted(file), "holds binary data, so it is no OBJ file",
                         "check its format and extension");
    }
    return ObjReader(file, content).read();
}

} // namespace celadon::loaders
