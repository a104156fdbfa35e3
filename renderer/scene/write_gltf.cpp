#include "renderer/scene/write_gltf.h"

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/write_gltf_looks.h"
#include "subedit/assert.h"

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <string>

namespace celadon {

namespace {

using nlohmann::json;

// glTF 2.0, sections 3.6.2.2 and 3.7.2.1.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr float kMetersPerMm = 1e-3f;

json toJson(const glm::vec3& v) {
    return json::array({v.x, v.y, v.z});
}

/// Meshes of a document, and the nodes that show them.
class MeshWriter {
public:
    MeshWriter(json& document, std::string& buffer) : mDocument(document), mBuffer(buffer) {}

    void add(const Mesh& mesh, std::size_t material) {
        std::vector<glm::vec3> positions;
        glm::vec3 low(std::numeric_limits<float>::max());
        glm::vec3 high(-std::numeric_limits<float>::max());
        for (const glm::vec3& position : mesh.positions) {
            positions.push_back(kMetersPerMm * position);
            low = glm::min(low, positions.back());
            high = glm::max(high, positions.back());
        }
        json attributes;
        const std::size_t place = attribute<glm::vec3>(positions, "VEC3");
        mDocument["accessors"][place]["min"] = toJson(low);
        mDocument["accessors"][place]["max"] = toJson(high);
        attributes["POSITION"] = place;
        attributes["NORMAL"] = attribute<glm::vec3>(mesh.normals, "VEC3");
        if (!mesh.uvs.empty() || !mesh.uvs1.empty()) { // a second set needs a first
            attributes["TEXCOORD_0"] =
                attribute<glm::vec2>(mesh.uvs.empty() ? mesh.uvs1 : mesh.uvs, "VEC2");
        }
        if (!mesh.uvs1.empty()) {
            attributes["TEXCOORD_1"] = attribute<glm::vec2>(mesh.uvs1, "VEC2");
        }
        if (!mesh.colors.empty()) {
            attributes["COLOR_0"] = attribute<glm::vec4>(mesh.colors, "VEC4");
        }
        const std::size_t indices =
            accessor<std::uint32_t>(mesh.indices, "SCALAR", kUnsignedInt, kElementArrayBuffer);
        json made = {{"primitives", json::array({{{"attributes", attributes},
                                                  {"indices", indices},
                                                  {"material", material},
                                                  {"mode", 4}}})}};
        if (!mesh.name.empty()) {
            made["name"] = mesh.name;
        }
        mDocument["scenes"][0]["nodes"].push_back(mDocument["nodes"].size());
        mDocument["nodes"].push_back({{"mesh", mDocument["meshes"].size()}});
        mDocument["meshes"].push_back(std::move(made));
    }

private:
    template<typename T>
    std::size_t attribute(std::span<const T> values, const char* type) {
        return accessor<T>(values, type, kFloat, kArrayBuffer);
    }
    /// @return its index
    template<typename T>
    std::size_t accessor(std::span<const T> values, const char* type, int componentType,
                         int target) {
        const std::size_t view = loaders::appendView(
            mDocument, mBuffer,
            {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
        mDocument["bufferViews"][view]["target"] = target;
        json& accessors = mDocument["accessors"];
        accessors.push_back({{"bufferView", view},
                             {"componentType", componentType},
                             {"count", values.size()},
                             {"type", type}});
        return accessors.size() - 1;
    }

    json& mDocument;
    std::string& mBuffer;
};

} // namespace

void writeGltf(const World& world, const std::vector<json>& scattering, const json& extras,
               const std::filesystem::path& file, std::span<const loaders::NamedLight> lights) {
    CELADON_ASSERT(scattering.size() == world.materials.size());
    json document = {{"asset", {{"version", "2.0"}, {"generator", "Celadon"}}},
                     {"scene", 0},
                     {"scenes", json::array({json::object()})}};
    if (!extras.empty()) {
        document["scenes"][0]["extras"] = extras;
    }
    std::string buffer;
    MeshWriter meshes(document, buffer);
    GltfLooks looks(world, document, buffer);
    for (const WorldMesh& part : world.meshes) {
        meshes.add(part.mesh,
                   looks.material(part.mesh.material,
                                  part.scattering < 0
                                      ? nullptr
                                      : &scattering[static_cast<std::size_t>(part.scattering)]));
    }
    loaders::putLights(document, lights);
    loaders::writeGltfFile(std::move(document), buffer, file);
}

} // namespace celadon
