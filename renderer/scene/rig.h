#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// What moves a model: a tree of nodes, skins on it, morph targets, animations of them (glTF 2.0,
/// 3.7 and 3.11), and deformers stored with it, as read and checked. Indices are in range, numbers
/// finite, nodes form trees.
namespace celadon {

struct AnimatedDeformer; // animated_deformer.h

struct RigNode {
    std::string name;
    int parent = -1;
    bool hasMatrix = false; ///< `matrix` holds, not the parts; such a node is never animated
    glm::dmat4 matrix{1.0};
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< unit length
    glm::dvec3 scale{1.0};
    std::vector<double> weights; ///< of the morph targets of its mesh at rest
};

struct RigSkin {
    std::vector<int> joints;             ///< nodes, in any tree, shared with other skins or not
    std::vector<glm::dmat4> inverseBind; ///< one per joint
};

enum class Interpolation { Step, Linear, CubicSpline };
enum class AnimatedValue { Translation, Rotation, Scale, Weights };

/// One animated property of one node.
struct AnimationChannel {
    int node = 0;
    AnimatedValue value = AnimatedValue::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<double> times; ///< seconds, at least one, in order
    /// [key][components], rotations as x, y, z, w; CubicSpline: [key][in-tangent, value,
    /// out-tangent][components]
    std::vector<double> values;
    std::size_t components = 0;
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    double durationSeconds = 0.0; ///< the last key of all; there it starts over
};

struct Rig {
    std::vector<RigNode> nodes;
    std::vector<std::size_t> parentsFirst; ///< every node once
    std::vector<RigSkin> skins;
    std::vector<Animation> animations;
    std::vector<int> cameraNodes; ///< of each of Scene::cameras
    std::vector<int> lightNodes;  ///< of each of Scene::lights
    /// Stored with the model (Celadon's own extras); null: none.
    std::shared_ptr<const std::vector<AnimatedDeformer>> deformers;
};

struct JointInfluence {
    std::uint32_t joint = 0; ///< of the skin; their number stands for the mesh's own node
    float weight = 0.0f;
    bool operator==(const JointInfluence&) const = default;
};

/// What a morph target adds, for the vertices that it moves at all, each once.
struct MorphTarget {
    std::vector<std::uint32_t> vertices;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

/// A mesh before anything moved it: in the space of its node, or of its skin. Mesh::bindingVertices
/// leads from the vertices that are drawn to these.
struct MeshBinding {
    int node = 0;
    int skin = -1;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;     ///< any length; empty: flat in every pose
    int influences = 0;                 ///< per vertex; 0 without a skin
    std::vector<JointInfluence> joints; ///< [vertex][influences]; weights of a vertex sum to 1
    std::vector<MorphTarget> targets;
};

} // namespace celadon
