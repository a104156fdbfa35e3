#include "renderer/scene/write_gltf.h"

#include "subedit/assert.h"
#include "subedit/pending_file.h"

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
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

class Writer {
public:
    /// @return index of the new accessor
    template<typename T>
    std::size_t addAccessor(std::span<const T> values, const char* type, int componentType,
                            int target) {
        const std::size_t begin = mBytes.size();
        mBytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        mBytes.resize((mBytes.size() + 3) / 4 * 4); // views start on multiples of four
        mViews.push_back({{"buffer", 0},
                          {"byteOffset", begin},
                          {"byteLength", values.size_bytes()},
                          {"target", target}});
        mAccessors.push_back({{"bufferView", mViews.size() - 1},
                              {"componentType", componentType},
                              {"count", values.size()},
                              {"type", type}});
        return mAccessors.size() - 1;
    }

    void addMesh(const Mesh& mesh, std::size_t material) {
        std::vector<glm::vec3> positions;
        glm::vec3 low(std::numeric_limits<float>::max());
        glm::vec3 high(-std::numeric_limits<float>::max());
        for (const glm::vec3& position : mesh.positions) {
            positions.push_back(kMetersPerMm * position);
            low = glm::min(low, positions.back());
            high = glm::max(high, positions.back());
        }
        json attributes;
        const std::size_t place =
            addAccessor(std::span<const glm::vec3>(positions), "VEC3", kFloat, kArrayBuffer);
        mAccessors[place]["min"] = toJson(low);
        mAccessors[place]["max"] = toJson(high);
        attributes["POSITION"] = place;
        attributes["NORMAL"] =
            addAccessor(std::span<const glm::vec3>(mesh.normals), "VEC3", kFloat, kArrayBuffer);
        if (!mesh.uvs.empty()) {
            attributes["TEXCOORD_0"] =
                addAccessor(std::span<const glm::vec2>(mesh.uvs), "VEC2", kFloat, kArrayBuffer);
        }
        if (!mesh.colors.empty()) {
            attributes["COLOR_0"] =
                addAccessor(std::span<const glm::vec4>(mesh.colors), "VEC4", kFloat, kArrayBuffer);
        }
        const std::size_t indices = addAccessor(std::span<const std::uint32_t>(mesh.indices),
                                                "SCALAR", kUnsignedInt, kElementArrayBuffer);
        json made = {{"primitives", json::array({{{"attributes", attributes},
                                                  {"indices", indices},
                                                  {"material", material},
                                                  {"mode", 4}}})}};
        if (!mesh.name.empty()) {
            made["name"] = mesh.name;
        }
        mNodes.push_back({{"mesh", mMeshes.size()}});
        mMeshes.push_back(std::move(made));
    }

    [[nodiscard]] json document(const std::vector<json>& materials, const std::string& buffer) {
        std::set<std::string> extensions;
        for (const json& material : materials) {
            if (const auto found = material.find("extensions"); found != material.end()) {
                for (const auto& [name, value] : found->items()) {
                    extensions.insert(name);
                }
            }
        }
        json roots = json::array();
        for (std::size_t i = 0; i < mNodes.size(); ++i) {
            roots.push_back(i);
        }
        json out = {{"asset", {{"version", "2.0"}, {"generator", "Celadon"}}},
                    {"scene", 0},
                    {"scenes", json::array({{{"nodes", roots}}})},
                    {"nodes", mNodes},
                    {"meshes", mMeshes},
                    {"materials", materials},
                    {"accessors", mAccessors},
                    {"bufferViews", mViews},
                    {"buffers", json::array({{{"uri", buffer}, {"byteLength", mBytes.size()}}})}};
        if (!extensions.empty()) {
            out["extensionsUsed"] = extensions;
        }
        return out;
    }

    [[nodiscard]] const std::string& bytes() const { return mBytes; }

private:
    std::string mBytes;
    json mViews = json::array(), mAccessors = json::array();
    json mMeshes = json::array(), mNodes = json::array();
};

/// Without its pictures.
json opaqueMaterial(const SurfaceMaterial& look) {
    const glm::vec3 emission = look.emissiveTexture.isSet() // without, all of it would glow
                                   ? glm::vec3(0.0f)
                                   : glm::min(look.emission, glm::vec3(1.0f));
    return {{"name", look.name},
            {"doubleSided", look.doubleSided},
            {"emissiveFactor", toJson(emission)},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", json::array({look.baseColor.r, look.baseColor.g, look.baseColor.b,
                                               look.baseColor.a})},
              {"metallicFactor", look.metallic},
              {"roughnessFactor", look.roughness}}}};
}

/// What a URI may hold as it is (RFC 3986, unreserved); the rest is escaped.
std::string escaped(const std::string& name) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789-._~";
    std::string uri;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (kPlain.find(c) != std::string_view::npos) {
            uri.push_back(c);
        } else {
            uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
        }
    }
    return uri;
}

} // namespace

void writeGltf(const World& world, const std::vector<json>& scattering, const json& extras,
               const std::filesystem::path& file) {
    CELADON_ASSERT(scattering.size() == world.materials.size());
    std::vector<json> materials = scattering;
    const std::size_t firstOpaque = materials.size();
    for (const SurfaceMaterial& look : world.looks) {
        materials.push_back(opaqueMaterial(look));
    }
    Writer writer;
    for (const WorldMesh& part : world.meshes) {
        writer.addMesh(part.mesh, part.scattering >= 0
                                      ? static_cast<std::size_t>(part.scattering)
                                      : firstOpaque + static_cast<std::size_t>(part.mesh.material));
    }
    std::filesystem::path buffer = file;
    buffer.replace_extension(".bin");
    json document = writer.document(materials, escaped(buffer.filename().string()));
    if (!extras.empty()) {
        document["scenes"][0]["extras"] = extras;
    }
    subedit::writeTextFile(buffer, writer.bytes());
    subedit::writeTextFile(file,
                           document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

} // namespace celadon
