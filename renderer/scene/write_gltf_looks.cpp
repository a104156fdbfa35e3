#include "renderer/scene/write_gltf_looks.h"

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/load_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon {

using nlohmann::json;

namespace {

// glTF 2.0, section 5.26.
constexpr int kNearest = 9728;
constexpr int kLinear = 9729;
constexpr int kLinearMipmapLinear = 9987;

int wrapCode(Wrap wrap) {
    switch (wrap) {
    case Wrap::ClampToEdge:
        return 33071;
    case Wrap::MirroredRepeat:
        return 33648;
    case Wrap::Repeat:
        break;
    }
    return 10497;
}

/// Offset, rotation and scale of which a matrix is made, as MaterialReader::matrix() makes it.
json transformJson(const glm::mat3& m) {
    const float scaleX = std::hypot(m[0][0], m[0][1]);
    const float angle = std::atan2(-m[0][1], m[0][0]);
    const float scaleY = m[1][0] * std::sin(angle) + m[1][1] * std::cos(angle);
    return {{"offset", {m[2][0], m[2][1]}}, {"rotation", angle}, {"scale", {scaleX, scaleY}}};
}

} // namespace

std::size_t GltfLooks::material(int look, const json* scattering) {
    const auto [place, isNew] = mMaterials.try_emplace({look, scattering}, mMaterials.size());
    if (isNew) {
        const SurfaceMaterial& surface = mWorld.looks[static_cast<std::size_t>(look)];
        json made = scattering != nullptr ? *scattering : opaque(surface);
        if (const auto extensions = made.find("extensions"); extensions != made.end()) {
            for (const auto& [name, value] : extensions->items()) {
                use(name.c_str());
            }
        }
        addTextures(surface, scattering == nullptr, made);
        mDocument["materials"].push_back(std::move(made));
    }
    return place->second;
}

json GltfLooks::opaque(const SurfaceMaterial& look) {
    const glm::vec4& base = look.baseColor;
    json made = {{"name", look.name},
                 {"doubleSided", look.doubleSided},
                 {"pbrMetallicRoughness",
                  {{"baseColorFactor", json::array({base.r, base.g, base.b, base.a})},
                   {"metallicFactor", look.metallic},
                   {"roughnessFactor", look.roughness}}}};
    if (look.ior) {
        made["extensions"]["KHR_materials_ior"] = {{"ior", *look.ior}};
    }
    return made;
}

/// What a scattering part has besides its scattering, and an opaque one besides its numbers.
void GltfLooks::addTextures(const SurfaceMaterial& look, bool isOpaque, json& material) {
    json lobe = material.value("pbrMetallicRoughness", json::object());
    if (look.baseColorTexture.isSet() && (isOpaque || look.alphaCutoff)) {
        lobe["baseColorTexture"] = textureInfo(look.baseColorTexture);
    }
    if (look.metallicRoughnessTexture.isSet()) {
        lobe["metallicRoughnessTexture"] = textureInfo(look.metallicRoughnessTexture);
    }
    if (!lobe.empty()) {
        material["pbrMetallicRoughness"] = std::move(lobe);
    }
    if (look.normalTexture.isSet()) {
        material["normalTexture"] = textureInfo(look.normalTexture);
        material["normalTexture"]["scale"] = look.normalScale;
    }
    if (look.emission != glm::vec3(0.0f)) {
        const float brightest = std::max({look.emission.r, look.emission.g, look.emission.b});
        const float strength = std::max(brightest, 1.0f);
        material["emissiveFactor"] = json::array(
            {look.emission.r / strength, look.emission.g / strength, look.emission.b / strength});
        if (strength > 1.0f) {
            material["extensions"]["KHR_materials_emissive_strength"] = {
                {"emissiveStrength", strength}};
            use("KHR_materials_emissive_strength");
        }
        if (look.emissiveTexture.isSet()) {
            material["emissiveTexture"] = textureInfo(look.emissiveTexture);
        }
    }
    if (look.alphaCutoff) {
        material["alphaMode"] = "MASK";
        material["alphaCutoff"] = *look.alphaCutoff;
    }
}

void GltfLooks::use(const char* extension) {
    json& used = mDocument["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension) == used.end()) {
        used.push_back(extension);
    }
}

json GltfLooks::textureInfo(const TextureReference& reference) {
    json& samplers = mDocument["samplers"];
    samplers.push_back({{"wrapS", wrapCode(reference.wrapU)},
                        {"wrapT", wrapCode(reference.wrapV)},
                        {"magFilter", reference.nearest ? kNearest : kLinear},
                        {"minFilter", reference.nearest ? kNearest : kLinearMipmapLinear}});
    const std::size_t sampler = samplers.size() - 1;
    json& textures = mDocument["textures"];
    textures.push_back({{"source", image(reference.image)}, {"sampler", sampler}});
    json info = {{"index", textures.size() - 1}, {"texCoord", reference.uvSet}};
    if (reference.transform != glm::mat3(1.0f)) {
        info["extensions"]["KHR_texture_transform"] = transformJson(reference.transform);
        use("KHR_texture_transform");
    }
    return info;
}

std::size_t GltfLooks::image(int index) {
    const auto [place, isNew] = mImages.try_emplace(index, mImages.size());
    if (isNew) {
        const Image& picture = mWorld.images[static_cast<std::size_t>(index)];
        const std::size_t view =
            loaders::appendView(mDocument, mBuffer, loaders::encodePng(picture));
        json made = {{"bufferView", view}, {"mimeType", "image/png"}};
        if (!picture.name.empty()) {
            made["name"] = picture.name;
        }
        mDocument["images"].push_back(std::move(made));
    }
    return place->second;
}

} // namespace celadon
