#include "renderer/scene/motion.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon {

namespace {

/// As in buildWorld: squared lengths must stay finite in float.
constexpr double kLargestCoordinateMm = 1e15;

bool isGone(const glm::dvec3& p) {
    return !(std::abs(p.x) <= kLargestCoordinateMm && std::abs(p.y) <= kLargestCoordinateMm &&
             std::abs(p.z) <= kLargestCoordinateMm);
}

bool isFlat(const Mesh& mesh) {
    return mesh.binding && mesh.binding->normals.empty();
}

/// Unit normal of a triangle, or zero.
glm::dvec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    return length > 0.0 && std::isfinite(length) ? n / length : glm::dvec3(0.0);
}

/// Normals of faces: everywhere where the mesh is flat, else where a vertex has none.
void completeNormals(const Mesh& mesh, bool isMirrored, DeformedMesh& result) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 face =
            (isMirrored ? -1.0 : 1.0) * faceNormal(result.positions[mesh.indices[i]],
                                                   result.positions[mesh.indices[i + 1]],
                                                   result.positions[mesh.indices[i + 2]]);
        for (std::size_t k = i; k < i + 3; ++k) {
            glm::dvec3& normal = result.normals[mesh.indices[k]];
            if (isFlat(mesh) || normal == glm::dvec3(0.0)) {
                normal = face;
            }
        }
    }
}

/// The mesh where its skin and morph targets, or nothing, put it; and its miters where they are
/// needed, carried as normals are.
struct BoundMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> miters;
};

BoundMesh boundMesh(const World& rest, std::size_t index, const Pose& pose, bool wantsMiters) {
    const Mesh& mesh = rest.meshes[index].mesh;
    const MeshPose& meshPose = pose.meshes[index];
    const bool isBound = !meshPose.matrices.empty();
    BoundMesh result;
    if (wantsMiters) {
        const std::vector<glm::vec3> miters = miterDirections(mesh);
        result.miters.assign(miters.begin(), miters.end());
    }
    PosedVertices source; // of the binding, or of the mesh itself
    if (isBound) {
        source = morphedVertices(*mesh.binding, meshPose.weights);
    } else {
        source.positions.assign(mesh.positions.begin(), mesh.positions.end());
        source.normals.assign(mesh.normals.begin(), mesh.normals.end());
    }
    result.positions.reserve(mesh.positions.size());
    result.normals.assign(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::size_t v = isBound ? mesh.bindingVertices[i] : i;
        const glm::dmat4 matrix =
            isBound ? blendedMatrix(*mesh.binding, meshPose, v) : glm::dmat4(1.0);
        glm::dmat4 handled(1.0);
        if (pose.nodes) { // they move the rest shape, which a bound mesh has after its rest matrix
            const NodeBinding& nodes = *pose.nodes->binding;
            const glm::dmat4 toRest =
                isBound ? blendedMatrix(*mesh.binding, nodes.restPoses[index], v) : glm::dmat4(1.0);
            if (glm::determinant(glm::dmat3(toRest)) != 0.0) {
                handled =
                    glm::inverse(toRest) * affineAt(nodes.vertices[index][i], *pose.nodes) * toRest;
            }
        }
        const glm::dmat3 carrier = cofactors(glm::dmat3(handled)); // a fold turns its normals over
        result.positions.emplace_back(matrix * handled * glm::dvec4(source.positions[v], 1.0));
        if (!source.normals.empty()) {
            result.normals[i] = carryNormal(matrix, carrier * source.normals[v]);
        }
        if (wantsMiters) {
            result.miters[i] =
                carryNormal(matrix, carrier * result.miters[i]) * glm::length(result.miters[i]);
        }
    }
    return result;
}

} // namespace

DeformedMesh deformedMesh(const World& rest, std::size_t mesh, const Pose& pose) {
    const Mesh& source = rest.meshes[mesh].mesh;
    const BoundMesh bound = boundMesh(rest, mesh, pose, needsMiters(pose));
    DeformedMesh result{bound.positions, bound.normals};
    for (std::size_t i = 0; i < result.positions.size() && !pose.deformers.empty(); ++i) {
        DeformedVertex vertex{bound.positions[i], bound.normals[i],
                              bound.miters.empty() ? glm::dvec3(0.0) : bound.miters[i]};
        deform(pose.deformers, pose.box, vertex);
        result.positions[i] = vertex.position;
        result.normals[i] = vertex.normal;
    }
    completeNormals(source, pose.mirrored[mesh], result);
    return result;
}

World posedWorld(const World& rest, const Pose& pose) {
    refuseExplosion(rest, pose);
    World result = rest;
    std::vector<const Mesh*> all;
    std::vector<const Mesh*> scattering;
    for (std::size_t m = 0; m < result.meshes.size(); ++m) {
        Mesh& mesh = result.meshes[m].mesh;
        const DeformedMesh deformed = deformedMesh(rest, m, pose);
        mesh.positions.assign(deformed.positions.begin(), deformed.positions.end());
        mesh.normals.assign(deformed.normals.begin(), deformed.normals.end());
        for (std::size_t i = 0; pose.mirrored[m] && i + 2 < mesh.indices.size(); i += 3) {
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        }
        mesh.binding.reset(); // it would be moved twice
        mesh.bindingVertices.clear();
        all.push_back(&mesh);
        if (result.meshes[m].scattering >= 0) {
            scattering.push_back(&mesh);
        }
    }
    result.rig.reset();
    result.handleGround.reset(); // it is of the rest shape
    result.cameras = pose.cameras;
    result.lights = pose.lights;
    result.scatteringSphere = boundingSphere(scattering);
    result.sceneSphere = boundingSphere(all);
    return result;
}

void refuseExplosion(const World& rest, const Pose& pose) {
    for (std::size_t m = 0; m < rest.meshes.size(); ++m) {
        const Mesh& mesh = rest.meshes[m].mesh;
        const auto findGone = [](const std::vector<glm::dvec3>& positions) {
            return std::find_if(positions.begin(), positions.end(), isGone) != positions.end();
        };
        const std::string subject = fmt::format("mesh '{}'", mesh.name);
        Pose part = pose;
        part.nodes.reset();
        if (findGone(boundMesh(rest, m, part, false).positions)) {
            throw InputError(subject, "the animation takes it beyond all numbers",
                             "check the animation's scales, translations and weights");
        }
        part.nodes = pose.nodes;
        if (findGone(boundMesh(rest, m, part, false).positions)) {
            throw InputError(subject, "the handles take it beyond all numbers",
                             "move them less far");
        }
        for (std::size_t count = 1; count <= pose.deformers.size(); ++count) {
            part.deformers.assign(pose.deformers.begin(),
                                  pose.deformers.begin() + static_cast<std::ptrdiff_t>(count));
            if (findGone(deformedMesh(rest, m, part).positions)) {
                throw InputError(subject,
                                 fmt::format("deformer {} of {} takes it beyond all numbers", count,
                                             pose.deformers.size()),
                                 "give it a smaller amount");
            }
        }
    }
}

} // namespace celadon
