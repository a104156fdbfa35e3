#pragma once

#include "renderer/scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What OBJ, PLY, OFF and STL have in common: polygons whose corners name a position, and perhaps a
/// normal and a texture coordinate; and how they become one Mesh.
///
/// These formats are read by our own parsers, into this structure, and not through OpenMesh: it
/// trusts counts and indices, reports on stderr, duplicates or drops faces at non-manifold edges
/// (scans such as the Stanford dragon have thousands), and has no normals per corner. A halfedge
/// structure is not needed to draw; triangles in the file's order are what the artist sees.
/// OpenMesh reads the same files in the tests, as an independent witness.
namespace celadon::loaders {

struct PolygonSoup {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    struct Corner {
        std::uint32_t position = 0;
        std::uint32_t uv = kNone;
        std::uint32_t normal = kNone;
        bool operator==(const Corner&) const = default;
    };

    std::vector<glm::vec3> positions;     ///< finite
    std::vector<glm::vec3> normals;       ///< any length; zero: compute it
    std::vector<glm::vec2> uvs;           ///< finite, v down
    std::vector<Corner> corners;          ///< in range
    std::vector<std::uint32_t> faceEnds;  ///< one past each face's last corner; >= 3 corners each
    std::vector<std::uint32_t> faceLines; ///< line of each face in a text file, or empty
};

/// A scene of one mesh: polygons cut into triangles, those of no area dropped (with a warning), a
/// vertex per distinct corner, unused ones dropped, order kept. Missing normals are angle-weighted
/// over vertices at equal positions (Thurmer, Wuthrich 1998). Texture coordinates are kept only
/// when every corner has them.
/// @throws InputError when no triangle is left
[[nodiscard]] Scene makeScene(PolygonSoup soup, const std::filesystem::path& file,
                              std::vector<std::string> warnings);

/// Unit normal of a triangle; zero when it has no area to speak of (a sliver whose height is under
/// 1e-12 of its longest side, beyond what coordinates in float can tell).
[[nodiscard]] glm::dvec3 triangleNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// For each position the first index that has the same one; -0 equals 0.
[[nodiscard]] std::vector<std::uint32_t> firstEqual(std::span<const glm::vec3> positions);

} // namespace celadon::loaders
