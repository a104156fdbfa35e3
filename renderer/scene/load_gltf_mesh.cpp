#include "renderer/scene/load_gltf_mesh.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_accessor.h"
#include "renderer/scene/load_soup.h"
#include "renderer/scene/pose_mesh.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace celadon::loaders {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

template<typename Vector>
bool isFinite(const Vector& v) {
    for (int k = 0; k < Vector::length(); ++k) {
        if (!std::isfinite(v[k])) {
            return false;
        }
    }
    return true;
}

std::optional<int> attribute(const std::map<std::string, int>& attributes,
                             const std::string& name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

std::uint64_t indexCount(const GltfDocument& document, const tinygltf::Primitive& primitive) {
    const auto position = attribute(primitive.attributes, "POSITION");
    const int accessor = primitive.indices >= 0 ? primitive.indices : position.value_or(-1);
    return accessor < 0 ? 0 : document.model.accessors[static_cast<std::size_t>(accessor)].count;
}

bool hasTriangles(const tinygltf::Primitive& primitive) {
    return primitive.mode == TINYGLTF_MODE_TRIANGLES ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

class PrimitiveReader {
public:
    PrimitiveReader(const GltfDocument& document, const Rig& rig, const RigPose& rest,
                    std::size_t node, const tinygltf::Primitive& primitive, std::string place,
                    std::vector<std::string>& warnings)
        : mDocument(document),
          mRig(rig),
          mRest(rest),
          mNode(node),
          mPrimitive(primitive),
          mPlace(std::move(place)),
          mWarnings(warnings) {}

    /// Nothing when no triangle is left.
    std::optional<Mesh> read() {
        mPositionAccessor = *attribute(mPrimitive.attributes, "POSITION");
        mBinding.positions = readVec3(mDocument, mPositionAccessor);
        checkFinite("POSITION", mPositionAccessor, mBinding.positions);
        if (const auto normals = attribute(mPrimitive.attributes, "NORMAL")) {
            mBinding.normals = readVec3(mDocument, *normals);
        }
        readUvs("TEXCOORD_0", mMesh.uvs);
        readUvs("TEXCOORD_1", mMesh.uvs1);
        readColors();
        readMorphTargets();
        bindToNode();
        const std::vector<Triangle> triangles = readTriangles();
        place(triangles);
        if (mTriangles.empty()) {
            return std::nullopt;
        }
        if (mMesh.normals.empty()) {
            makeFlat();
        } else {
            repairNormals();
            keepUsedVertices();
        }
        if (isAnimated()) {
            mMesh.binding = std::make_shared<MeshBinding>(std::move(mBinding));
        }
        return std::move(mMesh);
    }

    [[nodiscard]] std::uint64_t droppedTriangles() const { return mDropped; }

private:
    const GltfDocument& mDocument;
    const Rig& mRig;
    const RigPose& mRest;
    std::size_t mNode;
    const tinygltf::Primitive& mPrimitive;
    std::string mPlace;
    std::vector<std::string>& mWarnings;
    int mPositionAccessor = -1;
    MeshBinding mBinding;
    Mesh mMesh;
    std::vector<Triangle> mTriangles;
    std::uint64_t mDropped = 0;

    [[nodiscard]] const tinygltf::Node& node() const { return mDocument.model.nodes[mNode]; }

    [[nodiscard]] bool isAnimated() const { return !mRig.animations.empty(); }

    template<typename Vector>
    void checkFinite(const char* name, int accessor, const std::vector<Vector>& values) const {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!isFinite(values[i])) {
                throw InputError(accessorPlace(mDocument, accessor),
                                 fmt::format("{} of vertex {} is not finite", name, i),
                                 "repair the mesh where it was made");
            }
        }
    }

    void readUvs(const char* name, std::vector<glm::vec2>& uvs) const {
        if (const auto accessor = attribute(mPrimitive.attributes, name)) {
            uvs = readVec2(mDocument, *accessor);
            checkFinite(name, *accessor, uvs);
        }
    }

    /// glTF 2.0, 3.7.2.1: linear, with alpha or without, clamped to [0, 1].
    void readColors() {
        const auto accessor = attribute(mPrimitive.attributes, "COLOR_0");
        if (!accessor) {
            return;
        }
        if (mDocument.model.accessors[static_cast<std::size_t>(*accessor)].type ==
            TINYGLTF_TYPE_VEC4) {
            mMesh.colors = readVec4(mDocument, *accessor);
        } else {
            for (const glm::vec3& color : readVec3(mDocument, *accessor)) {
                mMesh.colors.emplace_back(color, 1.0f);
            }
        }
        checkFinite("COLOR_0", *accessor, mMesh.colors);
        for (glm::vec4& color : mMesh.colors) {
            color = glm::clamp(color, 0.0f, 1.0f);
        }
    }

    /// Those that may ever count, without the vertices that they leave in place.
    void readMorphTargets() {
        const std::vector<double>& weights = mRest.weights[mNode];
        for (std::size_t t = 0; t < mPrimitive.targets.size(); ++t) {
            MorphTarget target;
            if (isAnimated() || (t < weights.size() && weights[t] != 0.0)) {
                const auto changes = [&](const char* name) {
                    const auto accessor = attribute(mPrimitive.targets[t], name);
                    std::vector<glm::vec3> values(mBinding.positions.size(), glm::vec3(0.0f));
                    if (accessor) {
                        values = readVec3(mDocument, *accessor);
                        checkFinite(name, *accessor, values);
                    }
                    return values;
                };
                const std::vector<glm::vec3> positions = changes("POSITION");
                const std::vector<glm::vec3> normals = changes("NORMAL");
                for (std::size_t i = 0; i < positions.size(); ++i) {
                    if (positions[i] != glm::vec3(0.0f) || normals[i] != glm::vec3(0.0f)) {
                        target.vertices.push_back(static_cast<std::uint32_t>(i));
                        target.positions.push_back(positions[i]);
                        target.normals.push_back(normals[i]);
                    }
                }
            }
            mBinding.targets.push_back(std::move(target));
        }
    }

    /// glTF 2.0, 3.7.3.3: a skinned vertex goes where its joints take it; the node's own transform
    /// does not matter then.
    void bindToNode() {
        mBinding.node = static_cast<int>(mNode);
        if (node().skin >= 0 && attribute(mPrimitive.attributes, "JOINTS_0") &&
            attribute(mPrimitive.attributes, "WEIGHTS_0")) {
            mBinding.skin = node().skin;
            readInfluences(mRig.skins[static_cast<std::size_t>(node().skin)].joints.size());
        }
    }

    void readInfluences(std::size_t joints) {
        const std::size_t vertices = mBinding.positions.size();
        std::vector<std::pair<int, int>> sets; // accessors of joints and of weights
        for (;;) {
            const auto jointAccessor =
                attribute(mPrimitive.attributes, fmt::format("JOINTS_{}", sets.size()));
            const auto weightAccessor =
                attribute(mPrimitive.attributes, fmt::format("WEIGHTS_{}", sets.size()));
            if (!jointAccessor || !weightAccessor) {
                break;
            }
            sets.emplace_back(*jointAccessor, *weightAccessor);
        }
        const std::size_t influences = 4 * sets.size();
        mBinding.influences = static_cast<int>(influences);
        mBinding.joints.resize(vertices * influences);
        for (std::size_t set = 0; set < sets.size(); ++set) {
            const std::vector<glm::uvec4> indices = readJoints(mDocument, sets[set].first);
            const std::vector<glm::vec4> weights = readVec4(mDocument, sets[set].second);
            for (std::size_t i = 0; i < vertices; ++i) {
                for (int k = 0; k < 4; ++k) {
                    const float weight = weights[i][k];
                    if (!(weight > 0.0f) || !std::isfinite(weight)) {
                        continue;
                    }
                    if (indices[i][k] >= joints) {
                        throw InputError(accessorPlace(mDocument, sets[set].first),
                                         fmt::format("joint {} of vertex {} is past the {} joints "
                                                     "of its skin",
                                                     indices[i][k], i, joints),
                                         "export the model again");
                    }
                    mBinding.joints[i * influences + 4 * set + static_cast<std::size_t>(k)] = {
                        indices[i][k], weight};
                }
            }
        }
        normalizeWeights(static_cast<std::uint32_t>(joints));
    }

    /// glTF 2.0, 3.7.3.3: weights sum to one; where they do not, they are made to. A vertex that no
    /// joint holds stays with the node.
    void normalizeWeights(std::uint32_t nodeItself) {
        constexpr double kRounding = 0.01; // of weights in bytes
        std::size_t off = 0;
        const auto influences = static_cast<std::size_t>(mBinding.influences);
        for (std::size_t i = 0; i < mBinding.positions.size(); ++i) {
            JointInfluence* const own = &mBinding.joints[i * influences];
            double total = 0.0;
            for (std::size_t k = 0; k < influences; ++k) {
                total += static_cast<double>(own[k].weight);
            }
            off += std::abs(total - 1.0) > kRounding ? 1 : 0;
            for (std::size_t k = 0; k < influences && total > 0.0; ++k) {
                own[k].weight = static_cast<float>(static_cast<double>(own[k].weight) / total);
            }
            if (!(total > 0.0)) {
                own[0] = {nodeItself, 1.0f};
            }
        }
        if (off > 0) {
            mWarnings.push_back(fmt::format("{}: the joint weights of {} did not sum to one, and "
                                            "were scaled to",
                                            mPlace, counted(off, "vertex")));
        }
    }

    std::vector<Triangle> readTriangles() {
        std::vector<std::uint32_t> indices;
        const std::size_t vertices = mBinding.positions.size();
        if (mPrimitive.indices >= 0) {
            indices = readIndices(mDocument, mPrimitive.indices);
            for (std::size_t i = 0; i < indices.size(); ++i) {
                if (indices[i] >= vertices) {
                    throw InputError(accessorPlace(mDocument, mPrimitive.indices),
                                     fmt::format("index {} at {} is past the {} vertices",
                                                 indices[i], i, vertices),
                                     "export the model again");
                }
            }
        } else {
            indices.resize(vertices);
            for (std::size_t i = 0; i < vertices; ++i) {
                indices[i] = static_cast<std::uint32_t>(i);
            }
        }
        std::vector<Triangle> triangles;
        if (mPrimitive.mode == TINYGLTF_MODE_TRIANGLES) {
            triangles.reserve(indices.size() / 3);
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
                triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
            }
            if (indices.size() % 3 != 0) {
                mWarnings.push_back(fmt::format("{}: {} are left over after the last triangle",
                                                mPlace, counted(indices.size() % 3, "vertex")));
            }
            return triangles;
        }
        for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
            if (mPrimitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
            } else { // every other triangle of a strip turns the other way (glTF 2.0, 3.7.2.1)
                const std::size_t odd = i % 2;
                triangles.push_back({indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
            }
        }
        return triangles;
    }

    /// To world space; keeps the triangles that have an area there, or may get one.
    void place(const std::vector<Triangle>& triangles) {
        const PosedVertices posed = poseVertices(mBinding, meshPose(mRig, mBinding, mRest, 1.0));
        mMesh.positions.assign(posed.positions.begin(), posed.positions.end());
        mMesh.normals.assign(posed.normals.begin(), posed.normals.end());
        for (std::size_t i = 0; i < mMesh.positions.size(); ++i) {
            if (!isFinite(mMesh.positions[i])) {
                throw InputError(fmt::format("{}, node {}", quoted(mDocument.file), mNode),
                                 fmt::format("its transform takes vertex {} beyond all numbers", i),
                                 "check the scales of the nodes");
            }
        }
        if (isAnimated()) {
            mMesh.bindingVertices.resize(mMesh.positions.size());
            std::iota(mMesh.bindingVertices.begin(), mMesh.bindingVertices.end(), 0u);
        }
        mTriangles.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles) {
            const bool turn = posed.mirrored[a];
            const Triangle triangle{a, turn ? c : b, turn ? b : c};
            if (normalOf(triangle) == glm::dvec3(0.0) && !mayUnfold(triangle)) {
                ++mDropped;
            } else {
                mTriangles.push_back(triangle);
            }
        }
    }

    /// Whether a triangle of no area at rest may have one in motion.
    [[nodiscard]] bool mayUnfold(const Triangle& triangle) const {
        const auto& [a, b, c] = triangle;
        return isAnimated() && !moveAsOne(a, b) && !moveAsOne(b, c) && !moveAsOne(c, a);
    }

    /// Whether two vertices are at one place in every pose.
    [[nodiscard]] bool moveAsOne(std::size_t a, std::size_t b) const {
        if (a == b) {
            return true;
        }
        if (mBinding.positions[a] != mBinding.positions[b] || !mBinding.targets.empty()) {
            return false;
        }
        const auto influences = static_cast<std::size_t>(mBinding.influences);
        const auto* const first = mBinding.joints.data();
        return std::equal(first + a * influences, first + (a + 1) * influences,
                          first + b * influences);
    }

    [[nodiscard]] glm::dvec3 normalOf(const Triangle& triangle) const {
        return triangleNormal(mMesh.positions[triangle[0]], mMesh.positions[triangle[1]],
                              mMesh.positions[triangle[2]]);
    }

    /// Normals that are no direction become that of the first face at the vertex.
    void repairNormals() {
        for (const Triangle& triangle : mTriangles) {
            for (const std::uint32_t vertex : triangle) {
                if (mMesh.normals[vertex] == glm::vec3(0.0f)) {
                    mMesh.normals[vertex] = glm::vec3(normalOf(triangle));
                }
            }
        }
    }

    /// A vertex for each corner, with the normal of its face (glTF 2.0, 3.7.2.1).
    void makeFlat() {
        std::vector<std::uint32_t> sources;
        sources.reserve(mTriangles.size() * 3);
        std::vector<glm::vec3> normals;
        normals.reserve(mTriangles.size() * 3);
        for (const Triangle& triangle : mTriangles) {
            const glm::vec3 normal(normalOf(triangle));
            for (const std::uint32_t vertex : triangle) {
                mMesh.indices.push_back(static_cast<std::uint32_t>(sources.size()));
                sources.push_back(vertex);
                normals.push_back(normal);
            }
        }
        gather(sources);
        mMesh.normals = std::move(normals);
    }

    void keepUsedVertices() {
        constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> numbers(mMesh.positions.size(), kUnused);
        for (const Triangle& triangle : mTriangles) {
            for (const std::uint32_t vertex : triangle) {
                numbers[vertex] = 0;
            }
        }
        std::vector<std::uint32_t> sources;
        for (std::uint32_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] != kUnused) {
                numbers[i] = static_cast<std::uint32_t>(sources.size());
                sources.push_back(i);
            }
        }
        mMesh.indices.reserve(mTriangles.size() * 3);
        for (const Triangle& triangle : mTriangles) {
            for (const std::uint32_t vertex : triangle) {
                mMesh.indices.push_back(numbers[vertex]);
            }
        }
        gather(sources);
    }

    /// Vertex i becomes what vertex sources[i] was.
    void gather(const std::vector<std::uint32_t>& sources) {
        const auto pick = [&](auto& values) {
            if (values.empty()) {
                return;
            }
            std::remove_reference_t<decltype(values)> picked;
            picked.reserve(sources.size());
            for (const std::uint32_t source : sources) {
                picked.push_back(values[source]);
            }
            values = std::move(picked);
        };
        pick(mMesh.positions);
        pick(mMesh.normals);
        pick(mMesh.uvs);
        pick(mMesh.uvs1);
        pick(mMesh.colors);
        pick(mMesh.bindingVertices);
    }
};

/// Instances cost nothing in the file: bound what they make before making it.
void checkTotal(const GltfDocument& document, const std::vector<std::size_t>& shown) {
    constexpr std::uint64_t kMaxVertexReads = 1'000'000'000; // primitives may share large accessors
    std::uint64_t total = 0;
    std::uint64_t reads = 0;
    for (const std::size_t index : shown) {
        const int mesh = document.model.nodes[index].mesh;
        if (mesh < 0) {
            continue;
        }
        for (const tinygltf::Primitive& primitive :
             document.model.meshes[static_cast<std::size_t>(mesh)].primitives) {
            const auto position = attribute(primitive.attributes, "POSITION");
            if (!hasTriangles(primitive) || !position) {
                continue;
            }
            total += indexCount(document, primitive);
            reads += document.model.accessors[static_cast<std::size_t>(*position)].count;
            if (total > kMaxElements * 3 || reads > kMaxVertexReads) {
                throw InputError(quoted(document.file),
                                 fmt::format("its nodes show more than {} triangles", kMaxElements),
                                 "simplify the model");
            }
        }
    }
}

} // namespace

void addMeshes(const GltfDocument& document, const Rig& rig, const RigPose& rest,
               const std::vector<std::size_t>& shown, Scene& scene) {
    checkTotal(document, shown);
    std::uint64_t skipped = 0;
    std::uint64_t dropped = 0;
    for (const std::size_t index : shown) {
        const tinygltf::Node& node = document.model.nodes[index];
        if (node.mesh < 0) {
            continue;
        }
        const tinygltf::Mesh& mesh = document.model.meshes[static_cast<std::size_t>(node.mesh)];
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            if (!hasTriangles(primitive)) {
                ++skipped;
                continue;
            }
            if (!attribute(primitive.attributes, "POSITION")) {
                continue;
            }
            const std::string place =
                fmt::format("{}, mesh {}, primitive {}", quoted(document.file), node.mesh, p);
            PrimitiveReader reader(document, rig, rest, index, primitive, place, scene.warnings);
            std::optional<Mesh> result = reader.read();
            dropped += reader.droppedTriangles();
            if (result) {
                result->name = mesh.name.empty() ? node.name : mesh.name;
                result->material = primitive.material >= 0
                                       ? primitive.material
                                       : static_cast<int>(document.model.materials.size());
                scene.meshes.push_back(std::move(*result));
            }
        }
    }
    if (skipped > 0) {
        scene.warnings.push_back(fmt::format("{}: skipped {} of points or lines",
                                             quoted(document.file), counted(skipped, "primitive")));
    }
    if (dropped > 0) {
        scene.warnings.push_back(fmt::format("{}: left out {} of no area", quoted(document.file),
                                             counted(dropped, "triangle")));
    }
}

} // namespace celadon::loaders
