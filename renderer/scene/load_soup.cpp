#include "renderer/scene/load_soup.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_triangulate.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace celadon::loaders {

namespace {

using Corner = PolygonSoup::Corner;

std::uint64_t mixBits(std::uint64_t x) { // splitmix64's finalizer (Steele et al. 2014)
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

std::uint64_t hashOf(const glm::vec3& p) {
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0f)}; };
    return mixBits(bits(p.x) | (bits(p.y) << 32)) ^ mixBits(bits(p.z) + 0x9e3779b97f4a7c15ull);
}

std::uint64_t hashOf(const glm::vec2& p) {
    return hashOf(glm::vec3(p, 0.0f));
}

std::uint64_t hashOf(const Corner& c) {
    return mixBits(c.position | (std::uint64_t{c.uv} << 32)) ^
           mixBits(c.normal + 0x9e3779b97f4a7c15ull);
}

/// Numbers items in the order in which they first appear; equal ones share a number. Open
/// addressing: the table holds numbers of items that the caller keeps.
template<typename Item>
class Numbering {
public:
    explicit Numbering(std::size_t expected)
        : mSlots(std::bit_ceil(2 * expected + 2), PolygonSoup::kNone) {}

    /// @param itemOf number -> item, for numbers given out so far
    /// @return the number of the equal item, or `next`, which the item then has
    template<typename ItemOf>
    std::uint32_t find(const Item& item, std::uint32_t next, const ItemOf& itemOf) {
        const std::size_t mask = mSlots.size() - 1;
        std::size_t slot = static_cast<std::size_t>(hashOf(item)) & mask;
        while (mSlots[slot] != PolygonSoup::kNone) {
            if (itemOf(mSlots[slot]) == item) {
                return mSlots[slot];
            }
            slot = (slot + 1) & mask;
        }
        mSlots[slot] = next;
        return next;
    }

private:
    std::vector<std::uint32_t> mSlots;
};

template<typename Vector>
std::vector<std::uint32_t> firstEqualOf(std::span<const Vector> values) {
    std::vector<std::uint32_t> first(values.size());
    Numbering<Vector> numbering(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        first[i] = numbering.find(values[i], static_cast<std::uint32_t>(i),
                                  [&](std::uint32_t n) { return values[n]; });
    }
    return first;
}

std::string placeOf(const PolygonSoup& soup, const std::filesystem::path& file, std::size_t face) {
    return soup.faceLines.empty() ? fmt::format("{}, face {}", quoted(file), face)
                                  : fmt::format("{}, line {}", quoted(file), soup.faceLines[face]);
}

/// Corners of the triangles, three each, those of no area left out.
std::vector<Corner> cutIntoTriangles(const PolygonSoup& soup, const std::filesystem::path& file,
                                     std::vector<std::string>& warnings) {
    std::vector<Corner> result;
    result.reserve(soup.corners.size());
    std::vector<glm::vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::uint64_t dropped = 0;
    std::size_t begin = 0;
    for (std::size_t face = 0; face < soup.faceEnds.size(); ++face) {
        const std::size_t end = soup.faceEnds[face];
        points.clear();
        for (std::size_t i = begin; i < end; ++i) {
            points.push_back(soup.positions[soup.corners[i].position]);
        }
        triangles.clear();
        if (!triangulate(points, triangles)) {
            throw InputError(placeOf(soup, file, face),
                             fmt::format("a polygon of {} corners that is not convex; the limit "
                                         "for such is {}",
                                         end - begin, kMaxConcaveCorners),
                             "triangulate the model where it was made");
        }
        for (const auto& [a, b, c] : triangles) {
            if (triangleNormal(points[a], points[b], points[c]) == glm::dvec3(0.0)) {
                ++dropped;
                continue;
            }
            result.push_back(soup.corners[begin + a]);
            result.push_back(soup.corners[begin + b]);
            result.push_back(soup.corners[begin + c]);
        }
        begin = end;
    }
    if (result.empty()) {
        throw InputError(
            quoted(file),
            dropped == 0 ? std::string("holds no triangles")
                         : fmt::format("all of its {} have no area", counted(dropped, "triangle")),
            "export a surface, not points or lines");
    }
    if (result.size() / 3 > kMaxElements) {
        throw InputError(
            quoted(file),
            fmt::format("{} triangles are above the limit of {}", result.size() / 3, kMaxElements),
            "simplify the model");
    }
    if (dropped > 0) {
        warnings.push_back(
            fmt::format("{}: left out {} of no area", quoted(file), counted(dropped, "triangle")));
    }
    return result;
}

void forgetIncompleteUvs(std::vector<Corner>& corners, const std::filesystem::path& file,
                         std::vector<std::string>& warnings) {
    std::size_t without = 0;
    for (const Corner& corner : corners) {
        without += corner.uv == PolygonSoup::kNone ? 1 : 0;
    }
    if (without == 0) {
        return;
    }
    if (without < corners.size()) {
        warnings.push_back(fmt::format("{}: {} of {} corners have no texture coordinates; all are "
                                       "ignored, so that an atlas can be made",
                                       quoted(file), without, corners.size()));
    }
    for (Corner& corner : corners) {
        corner.uv = PolygonSoup::kNone;
    }
}

/// Forgets normals that are no direction.
void forgetUselessNormals(std::vector<Corner>& corners, PolygonSoup& soup) {
    for (glm::vec3& normal : soup.normals) {
        const double length = glm::length(glm::dvec3(normal));
        if (!(length > 1e-20) || !std::isfinite(length)) {
            normal = glm::vec3(0.0f);
        }
    }
    for (Corner& corner : corners) {
        if (corner.normal != PolygonSoup::kNone && soup.normals[corner.normal] == glm::vec3(0.0f)) {
            corner.normal = PolygonSoup::kNone;
        }
    }
}

/// Many exporters write a normal and a texture coordinate anew for each corner: equal ones get one
/// number, so that corners share vertices.
void numberEqualValues(std::vector<Corner>& corners, const PolygonSoup& soup) {
    const std::vector<std::uint32_t> normals = firstEqualOf(std::span(soup.normals));
    const std::vector<std::uint32_t> uvs = firstEqualOf(std::span(soup.uvs));
    for (Corner& corner : corners) {
        corner.normal =
            corner.normal == PolygonSoup::kNone ? corner.normal : normals[corner.normal];
        corner.uv = corner.uv == PolygonSoup::kNone ? corner.uv : uvs[corner.uv];
    }
}

/// Angle-weighted normals of the vertices that `normals` leaves zero.
void computeMissingNormals(Mesh& mesh) {
    const std::vector<std::uint32_t> group = firstEqual(mesh.positions);
    std::vector<glm::dvec3> sum(mesh.positions.size(), glm::dvec3(0.0));
    const auto faceNormal = [&](std::size_t first) {
        return triangleNormal(mesh.positions[mesh.indices[first]],
                              mesh.positions[mesh.indices[first + 1]],
                              mesh.positions[mesh.indices[first + 2]]);
    };
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3) {
        const glm::dvec3 normal = faceNormal(first);
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 here(mesh.positions[mesh.indices[first + k]]);
            const glm::dvec3 u(glm::dvec3(mesh.positions[mesh.indices[first + (k + 1) % 3]]) -
                               here);
            const glm::dvec3 v(glm::dvec3(mesh.positions[mesh.indices[first + (k + 2) % 3]]) -
                               here);
            const double angle = std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
            sum[group[mesh.indices[first + k]]] += angle * normal;
        }
    }
    // Where faces cancel (a sheet with two sides), a vertex takes the first face that uses it.
    constexpr double kCancelled = 1e-6;
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[first + k];
            if (mesh.normals[vertex] == glm::vec3(0.0f)) {
                const glm::dvec3& total = sum[group[vertex]];
                const double length = glm::length(total);
                mesh.normals[vertex] =
                    length > kCancelled ? glm::vec3(total / length) : glm::vec3(faceNormal(first));
            }
        }
    }
}

} // namespace

glm::dvec3 triangleNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    constexpr double kFlattest = 1e-12;
    const glm::dvec3 u = glm::dvec3(b) - glm::dvec3(a);
    const glm::dvec3 v = glm::dvec3(c) - glm::dvec3(a);
    const glm::dvec3 w = v - u;
    const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
    const glm::dvec3 normal = glm::cross(u, v);
    const double length = glm::length(normal);
    return length > kFlattest * longest && length > 0.0 ? normal / length : glm::dvec3(0.0);
}

std::vector<std::uint32_t> firstEqual(std::span<const glm::vec3> positions) {
    return firstEqualOf(positions);
}

Scene makeScene(PolygonSoup soup, const std::filesystem::path& file,
                std::vector<std::string> warnings) {
    std::vector<Corner> corners = cutIntoTriangles(soup, file, warnings);
    soup.corners = {};
    forgetIncompleteUvs(corners, file, warnings);
    forgetUselessNormals(corners, soup);
    numberEqualValues(corners, soup);

    Mesh mesh;
    mesh.name = file.stem().string();
    mesh.indices.reserve(corners.size());
    mesh.positions.reserve(soup.positions.size());
    std::vector<Corner> vertices;
    vertices.reserve(soup.positions.size());
    Numbering<Corner> numbering(std::max(soup.positions.size(), corners.size()));
    for (const Corner& corner : corners) {
        const auto next = static_cast<std::uint32_t>(vertices.size());
        const std::uint32_t vertex =
            numbering.find(corner, next, [&](std::uint32_t n) { return vertices[n]; });
        if (vertex == next) {
            vertices.push_back(corner);
        }
        mesh.indices.push_back(vertex);
    }
    bool allNormals = true;
    mesh.normals.reserve(vertices.size());
    for (const Corner& vertex : vertices) {
        mesh.positions.push_back(soup.positions[vertex.position]);
        if (vertex.uv != PolygonSoup::kNone) {
            mesh.uvs.push_back(soup.uvs[vertex.uv]);
        }
        const bool has = vertex.normal != PolygonSoup::kNone;
        mesh.normals.push_back(
            has ? glm::vec3(glm::normalize(glm::dvec3(soup.normals[vertex.normal])))
                : glm::vec3(0.0f));
        allNormals = allNormals && has;
    }
    if (!allNormals) {
        computeMissingNormals(mesh);
    }

    Scene scene;
    scene.name = mesh.name;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back();
    scene.warnings = std::move(warnings);
    return scene;
}

} // namespace celadon::loaders
