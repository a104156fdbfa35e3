#include "renderer/scene/load_off.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_soup.h"
#include "renderer/scene/load_text.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace celadon::loaders {

namespace {

class OffReader {
public:
    OffReader(const std::filesystem::path& file, std::string_view content)
        : mFile(file), mScanner(file, content, '#') {}

    Scene read() {
        readKeyword();
        const std::uint64_t vertices = readCount("the number of vertices");
        const std::uint64_t faces = readCount("the number of faces");
        // The number of edges may follow, and is ignored. A vertex takes at least 6 bytes ("0 0 0"
        // and a line's end), a face that counts at least 8.
        if (vertices > mScanner.remaining() / 5) {
            mScanner.fail(tooMany(vertices, "vertices"));
        }
        if (faces > mScanner.remaining() / 2) {
            mScanner.fail(tooMany(faces, "faces"));
        }
        mSoup.positions.reserve(vertices);
        for (std::uint64_t i = 0; i < vertices; ++i) {
            goToData(i, vertices, "vertices");
            readVertex();
        }
        for (std::uint64_t i = 0; i < faces; ++i) {
            goToData(i, faces, "faces");
            readFace(vertices);
        }
        if (mShortFaces > 0) {
            mWarnings.push_back(fmt::format("{}: skipped {} with fewer than three corners",
                                            quoted(mFile), counted(mShortFaces, "face")));
        }
        return makeScene(std::move(mSoup), mFile, std::move(mWarnings));
    }

private:
    const std::filesystem::path& mFile;
    TextScanner mScanner;
    PolygonSoup mSoup;
    std::vector<std::string> mWarnings;
    bool mHasUvs = false, mHasNormals = false;
    std::uint64_t mShortFaces = 0;
    std::string_view mPending; // first word of a line that is still to be read

    [[nodiscard]] std::string tooMany(std::uint64_t count, std::string_view what) const {
        return fmt::format("{} {} are promised, but only {} bytes follow", count, what,
                           mScanner.remaining());
    }

    void readKeyword() {
        std::string_view word = mScanner.word();
        std::string_view rest = word;
        const auto take = [&](std::string_view prefix) {
            const bool has = rest.starts_with(prefix);
            rest.remove_prefix(has ? prefix.size() : 0);
            return has;
        };
        mHasUvs = take("ST");
        take("C");
        mHasNormals = take("N");
        if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
            mScanner.fail("is not in three dimensions", "export a surface in 3-D");
        }
        if (rest != "OFF") {
            mScanner.fail(fmt::format("starts with '{}', not OFF", excerpt(word)),
                          "check the format and the extension");
        }
        const std::string_view next = mScanner.wordOnLine();
        if (next == "BINARY") {
            mScanner.fail("binary OFF is not read", "save it as ascii OFF or as PLY");
        }
        mPending = next;
    }

    std::uint64_t readCount(std::string_view what) {
        const std::string_view word = mPending.empty() ? mScanner.word() : mPending;
        mPending = {};
        const std::int64_t count = mScanner.integer(word, what);
        if (count < 0) {
            mScanner.fail(fmt::format("{} is {}", what, count));
        }
        return static_cast<std::uint64_t>(count);
    }

    /// Goes to the first word of the next line that has one.
    void goToData(std::uint64_t done, std::uint64_t all, std::string_view what) {
        do {
            if (!mScanner.nextLine()) {
                mScanner.fail(fmt::format("the file ends after {} of {} {}", done, all, what));
            }
            mPending = mScanner.wordOnLine();
        } while (mPending.empty());
    }

    void readVertex() {
        const auto next = [&] {
            const std::string_view word = mPending.empty() ? mScanner.wordOnLine() : mPending;
            mPending = {};
            return word;
        };
        glm::vec3 p;
        p.x = mScanner.number(next(), "x of a vertex");
        p.y = mScanner.number(next(), "y of a vertex");
        p.z = mScanner.number(next(), "z of a vertex");
        mSoup.positions.push_back(p);
        if (mHasNormals) {
            glm::vec3 n;
            n.x = mScanner.number(next(), "x of a normal");
            n.y = mScanner.number(next(), "y of a normal");
            n.z = mScanner.number(next(), "z of a normal");
            mSoup.normals.push_back(n);
        }
        if (mHasUvs) { // the last two words; a color may stand before them
            std::string_view u;
            std::string_view v;
            for (std::string_view word = next(); !word.empty(); word = next()) {
                u = v;
                v = word;
            }
            const float x = mScanner.number(u, "u of a texture coordinate");
            mSoup.uvs.emplace_back(x, 1.0f - mScanner.number(v, "v of a texture coordinate"));
        }
    }

    void readFace(std::uint64_t vertices) {
        const std::int64_t corners = mScanner.integer(mPending, "the number of corners of a face");
        if (corners < 0 || static_cast<std::uint64_t>(corners) > mScanner.remaining()) {
            mScanner.fail(fmt::format("a face of {} corners", corners));
        }
        const std::size_t begin = mSoup.corners.size();
        for (std::int64_t k = 0; k < corners; ++k) {
            const std::int64_t index = mScanner.integer(mScanner.wordOnLine(), "a vertex index");
            if (index < 0 || static_cast<std::uint64_t>(index) >= vertices) {
                mScanner.fail(fmt::format("vertex index {} is outside 0 ... {}", index,
                                          static_cast<std::int64_t>(vertices) - 1));
            }
            const auto i = static_cast<std::uint32_t>(index);
            mSoup.corners.push_back(
                {i, mHasUvs ? i : PolygonSoup::kNone, mHasNormals ? i : PolygonSoup::kNone});
        }
        if (corners < 3) {
            mSoup.corners.resize(begin);
            ++mShortFaces;
            return;
        }
        mSoup.faceEnds.push_back(static_cast<std::uint32_t>(mSoup.corners.size()));
        mSoup.faceLines.push_back(static_cast<std::uint32_t>(mScanner.line()));
    }
};

} // namespace

Scene loadOff(const std::filesystem::path& file, std::string_view content) {
    return OffReader(file, content).read();
}

} // namespace celadon::loaders
