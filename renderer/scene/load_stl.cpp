#include "renderer/scene/load_stl.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_soup.h"
#include "renderer/scene/load_text.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace celadon::loaders {

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies");

constexpr std::size_t kHeaderBytes = 84; // 80 of text, 4 of count
constexpr std::size_t kFacetBytes = 50;  // normal, three positions, attribute

bool isWord(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
    });
}

/// Triangles of three positions each become a soup whose equal positions are one.
Scene join(std::vector<glm::vec3> positions, const std::filesystem::path& file,
           std::vector<std::uint32_t> faceLines, std::vector<std::string> warnings) {
    PolygonSoup soup;
    const std::vector<std::uint32_t> first = firstEqual(positions);
    soup.corners.reserve(positions.size());
    soup.faceEnds.reserve(positions.size() / 3);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        soup.corners.push_back({first[i]});
        if (i % 3 == 2) {
            soup.faceEnds.push_back(static_cast<std::uint32_t>(i + 1));
        }
    }
    soup.positions = std::move(positions);
    soup.faceLines = std::move(faceLines);
    return makeScene(std::move(soup), file, std::move(warnings));
}

Scene loadBinary(const std::filesystem::path& file, std::string_view content) {
    std::uint32_t facets = 0;
    std::memcpy(&facets, content.data() + kHeaderBytes - 4, sizeof(facets));
    const std::uint64_t wanted = kHeaderBytes + std::uint64_t{facets} * kFacetBytes;
    if (wanted > content.size()) {
        throw InputError(quoted(file),
                         fmt::format("{} facets are promised, which take {} bytes; the file has {}",
                                     facets, wanted, content.size()),
                         "the file is cut short, or is no STL: export it again");
    }
    std::vector<std::string> warnings;
    if (wanted < content.size()) {
        warnings.push_back(fmt::format("{}: ignored {} bytes after the last facet", quoted(file),
                                       content.size() - wanted));
    }
    std::vector<glm::vec3> positions(std::size_t{3} * facets);
    for (std::uint32_t facet = 0; facet < facets; ++facet) {
        const std::size_t at = kHeaderBytes + std::size_t{facet} * kFacetBytes + 12;
        static_assert(sizeof(glm::vec3) == 12);
        std::memcpy(&positions[std::size_t{3} * facet], content.data() + at, 36);
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = positions[std::size_t{3} * facet + k];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                throw InputError(fmt::format("{}, facet {}", quoted(file), facet),
                                 "a vertex is not finite", "repair the mesh where it was made");
            }
        }
    }
    return join(std::move(positions), file, {}, std::move(warnings));
}

Scene loadAscii(const std::filesystem::path& file, std::string_view content) {
    TextScanner scanner(file, content, 0);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> faceLines;
    const auto expect = [&](std::string_view wanted) {
        const std::string_view word = scanner.word();
        if (!isWord(word, wanted)) {
            scanner.fail(word.empty()
                             ? fmt::format("the file ends where '{}' should follow", wanted)
                             : fmt::format("'{}' where '{}' should stand", excerpt(word), wanted));
        }
    };
    bool inSolid = false;
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
        if (isWord(word, "solid") || isWord(word, "endsolid")) {
            inSolid = isWord(word, "solid");
            (void)scanner.restOfLine(); // a name, with blanks perhaps
            continue;
        }
        if (!inSolid || !isWord(word, "facet")) {
            scanner.fail(
                fmt::format("'{}' where 'facet' or 'endsolid' should stand", excerpt(word)));
        }
        faceLines.push_back(static_cast<std::uint32_t>(scanner.line()));
        expect("normal");
        for (int k = 0; k < 3; ++k) {
            if (scanner.word().empty()) { // any number, or NaN: it is not used
                scanner.fail("the file ends within a facet's normal");
            }
        }
        expect("outer");
        expect("loop");
        for (int k = 0; k < 3; ++k) {
            expect("vertex");
            glm::vec3 p;
            p.x = scanner.number(scanner.word(), "x of a vertex");
            p.y = scanner.number(scanner.word(), "y of a vertex");
            p.z = scanner.number(scanner.word(), "z of a vertex");
            positions.push_back(p);
        }
        expect("endloop");
        expect("endfacet");
    }
    if (inSolid) {
        scanner.fail("the file ends before 'endsolid'");
    }
    return join(std::move(positions), file, std::move(faceLines), {});
}

/// The header of a binary file may begin with "solid" as well; its size decides.
bool isBinary(std::string_view content) {
    if (content.size() < kHeaderBytes) {
        return false;
    }
    std::uint32_t facets = 0;
    std::memcpy(&facets, content.data() + kHeaderBytes - 4, sizeof(facets));
    if (content.size() == kHeaderBytes + std::uint64_t{facets} * kFacetBytes) {
        return true;
    }
    const std::size_t start = content.find_first_not_of(" \t\r\n");
    return start == std::string_view::npos || !isWord(content.substr(start, 5), "solid") ||
           content.substr(0, 512).find('\0') != std::string_view::npos;
}

} // namespace

Scene loadStl(const std::filesystem::path& file, std::string_view content) {
    return isBinary(content) ? loadBinary(file, content) : loadAscii(file, content);
}

} // namespace celadon::loaders
