#include "renderer/scene/pose_mesh.h"

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

glm::dmat4 scaled(const glm::dmat4& matrix, double unit) {
    glm::dmat4 result = matrix;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            result[column][row] *= unit;
        }
    }
    return result;
}

} // namespace

PosedVertices morphedVertices(const MeshBinding& binding, const std::vector<double>& weights) {
    PosedVertices result;
    result.positions.assign(binding.positions.begin(), binding.positions.end());
    result.normals.assign(binding.normals.begin(), binding.normals.end());
    for (std::size_t t = 0; t < std::min(binding.targets.size(), weights.size()); ++t) {
        const MorphTarget& target = binding.targets[t];
        for (std::size_t i = 0; weights[t] != 0.0 && i < target.vertices.size(); ++i) {
            const std::size_t v = target.vertices[i];
            result.positions[v] += weights[t] * glm::dvec3(target.positions[i]);
            if (!result.normals.empty()) {
                result.normals[v] += weights[t] * glm::dvec3(target.normals[i]);
            }
        }
    }
    return result;
}

glm::dmat4 blendedMatrix(const MeshBinding& binding, const MeshPose& pose, std::size_t vertex) {
    if (binding.influences == 0) {
        return pose.matrices[0];
    }
    const auto count = static_cast<std::size_t>(binding.influences);
    glm::dmat4 matrix(0.0);
    for (std::size_t k = 0; k < count; ++k) {
        const JointInfluence& influence = binding.joints[vertex * count + k];
        if (influence.weight > 0.0f) {
            matrix += static_cast<double>(influence.weight) * pose.matrices[influence.joint];
        }
    }
    return matrix;
}

glm::dvec3 carryNormal(const glm::dmat4& matrix, const glm::dvec3& normal) {
    const glm::dmat3 linear(matrix);
    const glm::dvec3 carried =
        cofactors(linear) * normal * (glm::determinant(linear) < 0.0 ? -1.0 : 1.0);
    const double length = glm::length(carried);
    return length > 0.0 && std::isfinite(length) ? carried / length : glm::dvec3(0.0);
}

glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

MeshPose meshPose(const Rig& rig, const MeshBinding& binding, const RigPose& pose, double unit) {
    MeshPose result;
    const auto node = static_cast<std::size_t>(binding.node);
    if (binding.skin >= 0) {
        const RigSkin& skin = rig.skins[static_cast<std::size_t>(binding.skin)];
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            const glm::dmat4& joint = pose.nodes[static_cast<std::size_t>(skin.joints[j])];
            result.matrices.push_back(scaled(joint * skin.inverseBind[j], unit));
        }
    }
    result.matrices.push_back(scaled(pose.nodes[node], unit));
    result.weights = pose.weights[node];
    return result;
}

PosedVertices poseVertices(const MeshBinding& binding, const MeshPose& pose) {
    PosedVertices result = morphedVertices(binding, pose.weights);
    result.mirrored.resize(result.positions.size());
    glm::dmat4 matrix = pose.matrices[0];
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
        if (binding.influences > 0) {
            matrix = blendedMatrix(binding, pose, i);
        }
        result.mirrored[i] = glm::determinant(glm::dmat3(matrix)) < 0.0;
        result.positions[i] = glm::dvec3(matrix * glm::dvec4(result.positions[i], 1.0));
        if (!result.normals.empty()) {
            result.normals[i] = carryNormal(matrix, result.normals[i]);
        }
    }
    return result;
}

} // namespace celadon
