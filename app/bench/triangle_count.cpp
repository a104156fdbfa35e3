#include "app/bench/triangle_count.h"

#include "renderer/scene/load_soup.h"
#include "renderer/scene/weld_vertices.h"
#include "subedit/errors.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <queue>

namespace celadon::app {

namespace {

constexpr double kCloseEnough = 0.02;

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) {
        count += mesh.triangleCount();
    }
    return count;
}

HalfEdges::VertexHandle addPoint(HalfEdges& mesh, const glm::vec3& p) {
    return mesh.add_vertex(HalfEdges::Point(p.x, p.y, p.z));
}

/// Triangles joined where their corners have one position. A triangle that would make an edge of
/// three, as scans have some, gets vertices of its own.
HalfEdges join(const Scene& scene) {
    HalfEdges joined;
    omerr().disable(); // it reports such triangles, and refuses them
    for (const Mesh& mesh : scene.meshes) {
        const std::vector<std::uint32_t> first = weldVertices(mesh.positions);
        std::vector<HalfEdges::VertexHandle> vertices(mesh.positions.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            vertices[i] = first[i] == i ? addPoint(joined, mesh.positions[i]) : vertices[first[i]];
        }
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            std::array<HalfEdges::VertexHandle, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) {
                corners[c] = vertices[mesh.indices[i + c]];
            }
            if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
                continue;
            }
            if (!joined.add_face(corners[0], corners[1], corners[2]).is_valid()) {
                for (std::size_t c = 0; c < 3; ++c) {
                    corners[c] = addPoint(joined, mesh.positions[mesh.indices[i + c]]);
                }
                joined.add_face(corners[0], corners[1], corners[2]);
            }
        }
    }
    omerr().enable();
    return joined;
}

void collapseEdges(HalfEdges& mesh, std::size_t count) {
    mesh.request_face_normals();
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    mesh.update_face_normals();
    for (const HalfEdges::VertexHandle vertex : mesh.vertices()) {
        mesh.status(vertex).set_locked(mesh.is_boundary(vertex));
    }
    OpenMesh::Decimater::DecimaterT<HalfEdges> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<HalfEdges>::Handle error;
    OpenMesh::Decimater::ModNormalFlippingT<HalfEdges>::Handle flipping;
    decimater.add(error);
    decimater.add(flipping);
    decimater.module(error).unset_max_err(); // the priority of a collapse, not a bound
    if (decimater.initialize()) {
        decimater.decimate_to_faces(0, count);
    }
    // What is gone stays in the mesh, marked: to fill its places would shuffle the rest.
}

void splitEdges(HalfEdges& mesh, std::size_t count) {
    struct Edge {
        double squaredLength;
        int index;
        bool operator<(const Edge& other) const {
            return squaredLength != other.squaredLength ? squaredLength < other.squaredLength
                                                        : index > other.index;
        }
    };
    std::priority_queue<Edge> longest;
    const auto add = [&](HalfEdges::EdgeHandle edge) {
        longest.push({mesh.calc_edge_sqr_length(edge), edge.idx()});
    };
    for (const HalfEdges::EdgeHandle edge : mesh.edges()) {
        add(edge);
    }
    while (mesh.n_faces() < count && !longest.empty()) {
        const HalfEdges::EdgeHandle edge(longest.top().index);
        longest.pop();
        const HalfEdges::VertexHandle middle = mesh.add_vertex(mesh.calc_edge_midpoint(edge));
        mesh.split(edge, middle);
        for (const HalfEdges::EdgeHandle around : mesh.ve_range(middle)) {
            add(around); // those of the edge's two halves, and those across its triangles
        }
    }
}

Scene sceneOf(const HalfEdges& mesh, const Scene& like) {
    loaders::PolygonSoup soup;
    std::vector<std::uint32_t> numbers(mesh.n_vertices());
    for (const HalfEdges::VertexHandle vertex : mesh.vertices()) {
        const HalfEdges::Point& p = mesh.point(vertex);
        numbers[static_cast<std::size_t>(vertex.idx())] =
            static_cast<std::uint32_t>(soup.positions.size());
        soup.positions.emplace_back(p[0], p[1], p[2]);
    }
    for (const HalfEdges::FaceHandle face : mesh.faces()) {
        for (const HalfEdges::VertexHandle vertex : mesh.fv_range(face)) {
            soup.corners.push_back({numbers[static_cast<std::size_t>(vertex.idx())]});
        }
        soup.faceEnds.push_back(static_cast<std::uint32_t>(soup.corners.size()));
    }
    return loaders::makeScene(std::move(soup), like.meshes.front().name, {});
}

} // namespace

Scene withTriangleCount(Scene scene, std::size_t count) {
    const auto present = static_cast<double>(triangleCount(scene));
    const auto wanted = static_cast<double>(count);
    if (scene.meshes.empty() || std::abs(present - wanted) <= kCloseEnough * wanted) {
        return scene;
    }
    HalfEdges mesh = join(scene);
    if (mesh.n_faces() > count) {
        collapseEdges(mesh, count);
    } else {
        splitEdges(mesh, count);
    }
    Scene changed = sceneOf(mesh, scene);
    if (const std::size_t left = triangleCount(changed); left > count + 1) {
        throw InputError(
            scene.meshes.front().name,
            fmt::format("cannot be brought to {} triangles: its borders need {}", count, left),
            "take a model with fewer borders");
    }
    return changed;
}

} // namespace celadon::app
