#include "renderer/scene/load_gltf_mesh.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_accessor.h"
#include "renderer/scene/load_soup.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace celadon::loaders {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
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

/// Where the vertices of one primitive go: one matrix for all, or one each (skins).
struct Placement {
    std::vector<glm::dmat4> matrices;
    [[nodiscard]] const glm::dmat4& of(std::size_t vertex) const {
        return matrices[matrices.size() == 1 ? 0 : vertex];
    }
};

/// Carries normals: the inverse transpose times the determinant, which exists for flat scales too.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

class PrimitiveReader {
public:
    PrimitiveReader(const GltfDocument& document, const std::vector<glm::dmat4>& world,
                    std::size_t node, const tinygltf::Primitive& primitive, std::string place,
                    std::vector<std::string>& warnings)
        : mDocument(document),
          mWorld(world),
          mNode(node),
          mPrimitive(primitive),
          mPlace(std::move(place)),
          mWarnings(warnings) {}

    /// Nothing when no triangle is left.
    std::optional<Mesh> read() {
        mPositionAccessor = *attribute(mPrimitive.attributes, "POSITION");
        mMesh.positions = readVec3(mDocument, mPositionAccessor);
        checkFinite("POSITION", mPositionAccessor);
        if (const auto normals = attribute(mPrimitive.attributes, "NORMAL")) {
            mMesh.normals = readVec3(mDocument, *normals);
        }
        readUvs("TEXCOORD_0", mMesh.uvs);
        readUvs("TEXCOORD_1", mMesh.uvs1);
        applyMorphTargets();
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
        return std::move(mMesh);
    }

    [[nodiscard]] std::uint64_t droppedTriangles() const { return mDropped; }

private:
    const GltfDocument& mDocument;
    const std::vector<glm::dmat4>& mWorld;
    std::size_t mNode;
    const tinygltf::Primitive& mPrimitive;
    std::string mPlace;
    std::vector<std::string>& mWarnings;
    int mPositionAccessor = -1;
    Mesh mMesh;
    std::vector<Triangle> mTriangles;
    std::uint64_t mDropped = 0;

    [[nodiscard]] const tinygltf::Node& node() const { return mDocument.model.nodes[mNode]; }

    void checkFinite(const char* name, int accessor) const {
        for (std::size_t i = 0; i < mMesh.positions.size(); ++i) {
            if (!isFinite(mMesh.positions[i])) {
                throw InputError(accessorPlace(mDocument, accessor),
                                 fmt::format("{} of vertex {} is not finite", name, i),
                                 "repair the mesh where it was made");
            }
        }
    }

    void readUvs(const char* name, std::vector<glm::vec2>& uvs) const {
        const auto accessor = attribute(mPrimitive.attributes, name);
        if (!accessor) {
            return;
        }
        uvs = readVec2(mDocument, *accessor);
        for (std::size_t i = 0; i < uvs.size(); ++i) {
            if (!std::isfinite(uvs[i].x) || !std::isfinite(uvs[i].y)) {
                throw InputError(accessorPlace(mDocument, *accessor),
                                 fmt::format("{} of vertex {} is not finite", name, i),
                                 "repair the mesh where it was made");
            }
        }
    }

    void applyMorphTargets() {
        const std::vector<double>& weights =
            node().weights.empty()
                ? mDocument.model.meshes[static_cast<std::size_t>(node().mesh)].weights
                : node().weights;
        for (std::size_t t = 0; t < mPrimitive.targets.size() && t < weights.size(); ++t) {
            if (weights[t] == 0.0) {
                continue;
            }
            const auto add = [&](const char* name, std::vector<glm::vec3>& values) {
                const auto accessor = attribute(mPrimitive.targets[t], name);
                if (accessor && !values.empty()) {
                    const std::vector<glm::vec3> change = readVec3(mDocument, *accessor);
                    for (std::size_t i = 0; i < values.size(); ++i) {
                        values[i] += static_cast<float>(weights[t]) * change[i];
                    }
                }
                return accessor;
            };
            if (const auto accessor = add("POSITION", mMesh.positions)) {
                checkFinite("POSITION with morph targets", *accessor);
            }
            (void)add("NORMAL", mMesh.normals);
        }
    }

    std::vector<Triangle> readTriangles() {
        std::vector<std::uint32_t> indices;
        const std::size_t vertices = mMesh.positions.size();
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

    /// glTF 2.0, 3.7.3.3: a skinned vertex goes where its joints take it; the node's own transform
    /// does not matter then.
    Placement skinned(const tinygltf::Skin& skin) const {
        std::vector<glm::dmat4> joints;
        std::vector<glm::mat4> inverseBind;
        if (skin.inverseBindMatrices >= 0) {
            inverseBind = readMat4(mDocument, skin.inverseBindMatrices);
        }
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            joints.push_back(mWorld[static_cast<std::size_t>(skin.joints[j])]);
            if (j < inverseBind.size()) {
                joints[j] = joints[j] * glm::dmat4(inverseBind[j]);
            }
        }
        Placement placement;
        placement.matrices.assign(mMesh.positions.size(), glm::dmat4(0.0));
        std::vector<double> total(mMesh.positions.size(), 0.0);
        for (int set = 0;; ++set) {
            const auto jointAccessor =
                attribute(mPrimitive.attributes, fmt::format("JOINTS_{}", set));
            const auto weightAccessor =
                attribute(mPrimitive.attributes, fmt::format("WEIGHTS_{}", set));
            if (!jointAccessor || !weightAccessor) {
                break;
            }
            const std::vector<glm::uvec4> indices = readJoints(mDocument, *jointAccessor);
            const std::vector<glm::vec4> weights = readVec4(mDocument, *weightAccessor);
            for (std::size_t i = 0; i < indices.size(); ++i) {
                for (int k = 0; k < 4; ++k) {
                    const double weight = weights[i][k];
                    if (!(weight > 0.0) || !std::isfinite(weight)) {
                        continue;
                    }
                    if (indices[i][k] >= joints.size()) {
                        throw InputError(accessorPlace(mDocument, *jointAccessor),
                                         fmt::format("joint {} of vertex {} is past the {} joints "
                                                     "of its skin",
                                                     indices[i][k], i, joints.size()),
                                         "export the model again");
                    }
                    placement.matrices[i] += weight * joints[indices[i][k]];
                    total[i] += weight;
                }
            }
        }
        for (std::size_t i = 0; i < total.size(); ++i) {
            placement.matrices[i] =
                total[i] > 0.0 ? placement.matrices[i] / total[i] : mWorld[mNode];
        }
        return placement;
    }

    /// To world space; keeps the triangles that have an area there.
    void place(const std::vector<Triangle>& triangles) {
        Placement placement{{mWorld[mNode]}};
        const bool hasJoints = attribute(mPrimitive.attributes, "JOINTS_0") &&
                               attribute(mPrimitive.attributes, "WEIGHTS_0");
        if (node().skin >= 0 && hasJoints) {
            placement = skinned(mDocument.model.skins[static_cast<std::size_t>(node().skin)]);
        }
        std::vector<bool> mirrored(placement.matrices.size());
        std::vector<glm::dmat3> normalMatrices(placement.matrices.size());
        for (std::size_t i = 0; i < placement.matrices.size(); ++i) {
            const glm::dmat3 linear(placement.matrices[i]);
            mirrored[i] = glm::determinant(linear) < 0.0;
            normalMatrices[i] = cofactors(linear) * (mirrored[i] ? -1.0 : 1.0);
        }
        const auto matrixOf = [&](std::size_t vertex) {
            return placement.matrices.size() == 1 ? 0 : vertex;
        };
        for (std::size_t i = 0; i < mMesh.positions.size(); ++i) {
            mMesh.positions[i] =
                glm::vec3(placement.of(i) * glm::dvec4(glm::dvec3(mMesh.positions[i]), 1.0));
            if (!isFinite(mMesh.positions[i])) {
                throw InputError(fmt::format("{}, node {}", quoted(mDocument.file), mNode),
                                 fmt::format("its transform takes vertex {} beyond all numbers", i),
                                 "check the scales of the nodes");
            }
            if (!mMesh.normals.empty()) {
                const glm::dvec3 normal =
                    normalMatrices[matrixOf(i)] * glm::dvec3(mMesh.normals[i]);
                const double length = glm::length(normal);
                mMesh.normals[i] = length > 0.0 && std::isfinite(length)
                                       ? glm::vec3(normal / length)
                                       : glm::vec3(0.0f);
            }
        }
        mTriangles.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles) {
            const bool turn = mirrored[matrixOf(a)];
            const Triangle triangle{a, turn ? c : b, turn ? b : c};
            if (normalOf(triangle) == glm::dvec3(0.0)) {
                ++mDropped;
            } else {
                mTriangles.push_back(triangle);
            }
        }
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

void addMeshes(const GltfDocument& document, const std::vector<glm::dmat4>& world,
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
            PrimitiveReader reader(document, world, index, primitive, place, scene.warnings);
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
