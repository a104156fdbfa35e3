#include "renderer/scene/load_gltf_rig.h"

#include "renderer/scene/load_gltf_accessor.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace celadon::loaders {

namespace {

RigNode readNode(const GltfDocument& document, const tinygltf::Node& source) {
    RigNode node;
    node.name = source.name;
    if (source.matrix.size() == 16) {
        node.hasMatrix = true;
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                node.matrix[column][row] =
                    source.matrix[static_cast<std::size_t>(4 * column + row)];
            }
        }
    }
    if (source.rotation.size() == 4) {
        const glm::dquat rotation(source.rotation[3], source.rotation[0], source.rotation[1],
                                  source.rotation[2]); // glTF: x, y, z, w
        if (glm::length(rotation) > 0.0) {
            node.rotation = glm::normalize(rotation);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (source.scale.size() == 3) {
            node.scale[axis] = source.scale[static_cast<std::size_t>(axis)];
        }
        if (source.translation.size() == 3) {
            node.translation[axis] = source.translation[static_cast<std::size_t>(axis)];
        }
    }
    node.weights = source.weights;
    if (node.weights.empty() && source.mesh >= 0) {
        node.weights = document.model.meshes[static_cast<std::size_t>(source.mesh)].weights;
    }
    return node;
}

RigSkin readSkin(const GltfDocument& document, const tinygltf::Skin& source) {
    RigSkin skin;
    skin.joints = source.joints;
    skin.inverseBind.assign(skin.joints.size(), glm::dmat4(1.0)); // absent: identities
    if (source.inverseBindMatrices < 0) {
        return skin;
    }
    const std::vector<glm::mat4> matrices = readMat4(document, source.inverseBindMatrices);
    for (std::size_t j = 0; j < skin.joints.size(); ++j) { // checked: enough of them
        skin.inverseBind[j] = glm::dmat4(matrices[j]);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                if (!std::isfinite(matrices[j][column][row])) {
                    throw InputError(accessorPlace(document, source.inverseBindMatrices),
                                     fmt::format("the inverse bind matrix of joint {} is not "
                                                 "finite",
                                                 j),
                                     "export the model again");
                }
            }
        }
    }
    return skin;
}

} // namespace

Rig readRig(const GltfDocument& document) {
    Rig rig;
    for (const tinygltf::Node& node : document.model.nodes) {
        rig.nodes.push_back(readNode(document, node));
    }
    for (std::size_t i = 0; i < rig.nodes.size(); ++i) {
        for (const int child : document.model.nodes[i].children) {
            rig.nodes[static_cast<std::size_t>(child)].parent = static_cast<int>(i);
        }
    }
    for (std::size_t i = 0; i < rig.nodes.size(); ++i) {
        if (rig.nodes[i].parent < 0) {
            rig.parentsFirst.push_back(i);
        }
    }
    for (std::size_t next = 0; next < rig.parentsFirst.size(); ++next) {
        for (const int child : document.model.nodes[rig.parentsFirst[next]].children) {
            rig.parentsFirst.push_back(static_cast<std::size_t>(child));
        }
    }
    for (const tinygltf::Skin& skin : document.model.skins) {
        rig.skins.push_back(readSkin(document, skin));
    }
    return rig;
}

} // namespace celadon::loaders
