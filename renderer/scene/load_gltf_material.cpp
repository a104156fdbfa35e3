#include "renderer/scene/load_gltf_material.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_image.h"
#include "renderer/scene/load_uri.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace celadon::loaders {

namespace {

class MaterialReader {
public:
    MaterialReader(const GltfDocument& document, Scene& scene)
        : mDocument(document), mScene(scene), mImages(document.images.size(), kUnread) {}

    void read() {
        for (std::size_t i = 0; i < mDocument.model.materials.size(); ++i) {
            mPlace = fmt::format("{}, material {}", quoted(mDocument.file), i);
            const std::string& name = mDocument.model.materials[i].name;
            mPlace += name.empty() ? "" : fmt::format(" '{}'", excerpt(name));
            mScene.materials.push_back(convert(mDocument.model.materials[i]));
        }
        SurfaceMaterial none; // what glTF says for a primitive without a material
        none.baseColor = glm::vec4(1.0f);
        none.metallic = 1.0f;
        none.roughness = 1.0f;
        mScene.materials.push_back(none);
    }

private:
    static constexpr int kUnread = -2, kUnreadable = -1;
    const GltfDocument& mDocument;
    Scene& mScene;
    std::vector<int> mImages; ///< glTF image -> Scene::images
    std::string mPlace;

    void warn(const std::string& text) { mScene.warnings.push_back(mPlace + ": " + text); }

    SurfaceMaterial convert(const tinygltf::Material& source) {
        const auto clamped = [](double value) {
            return static_cast<float>(std::clamp(value, 0.0, 1.0));
        };
        SurfaceMaterial result;
        const tinygltf::PbrMetallicRoughness& look = source.pbrMetallicRoughness;
        result.name = source.name;
        for (int k = 0; k < 4; ++k) {
            result.baseColor[k] = clamped(look.baseColorFactor[static_cast<std::size_t>(k)]);
        }
        result.metallic = clamped(look.metallicFactor);
        result.roughness = clamped(look.roughnessFactor);
        result.doubleSided = source.doubleSided;
        result.baseColorTexture = reference(look.baseColorTexture);
        result.metallicRoughnessTexture = reference(look.metallicRoughnessTexture);
        result.normalTexture = reference(source.normalTexture);
        result.normalScale = static_cast<float>(source.normalTexture.scale);
        readEmission(source, result);
        const auto ior = source.extensions.find("KHR_materials_ior");
        if (ior != source.extensions.end()) {
            result.ior = static_cast<float>(numberOf(ior->second, "ior", 1.5));
        }
        readSubEdit(source, result);
        if (source.alphaMode == "MASK") {
            result.alphaCutoff =
                static_cast<float>(std::clamp(source.alphaCutoff, 0.0, 2.0)); // alpha is at most 1
        } else if (source.alphaMode != "OPAQUE") {
            warn(fmt::format("its alpha mode {} is ignored, it is opaque",
                             excerpt(source.alphaMode)));
        }
        return result;
    }

    static double numberOf(const tinygltf::Value& object, const char* name, double otherwise) {
        const tinygltf::Value& value = object.Get(name);
        return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
    }

    void readEmission(const tinygltf::Material& source, SurfaceMaterial& result) {
        double strength = 1.0;
        const auto extension = source.extensions.find("KHR_materials_emissive_strength");
        if (extension != source.extensions.end()) {
            strength = numberOf(extension->second, "emissiveStrength", 1.0);
        }
        for (int k = 0; k < 3 && source.emissiveFactor.size() == 3; ++k) {
            result.emission[k] = static_cast<float>(
                std::max(source.emissiveFactor[static_cast<std::size_t>(k)], 0.0) * strength);
        }
        if (source.emissiveTexture.index >= 0 && result.emission != glm::vec3(0.0f)) {
            result.emissiveTexture = reference(source.emissiveTexture);
            if (!result.emissiveTexture.isSet()) { // the factor alone would make all of it glow
                result.emission = glm::vec3(0.0f);
            }
        }
    }

    void readSubEdit(const tinygltf::Material& source, SurfaceMaterial& result) const {
        if (!source.extras.IsObject() || !source.extras.Has("subedit")) {
            return;
        }
        const tinygltf::Value& value = source.extras.Get("subedit");
        const auto path =
            value.IsString() ? resolveUri(mDocument.file, value.Get<std::string>()) : std::nullopt;
        if (!path) {
            throw InputError(mPlace, "'extras.subedit' is not a relative path",
                             "put the material beside the model and name it relative to it");
        }
        result.subedit = path->lexically_normal();
    }

    template<typename Info>
    TextureReference reference(const Info& info) {
        TextureReference result;
        if (info.index < 0) {
            return result;
        }
        const tinygltf::Texture& texture =
            mDocument.model.textures[static_cast<std::size_t>(info.index)];
        if (texture.source < 0) {
            warn(fmt::format("texture {} has no picture of a kind that Celadon reads", info.index));
            return result;
        }
        result.image = image(static_cast<std::size_t>(texture.source));
        result.uvSet = info.texCoord;
        if (texture.sampler >= 0) {
            const tinygltf::Sampler& sampler =
                mDocument.model.samplers[static_cast<std::size_t>(texture.sampler)];
            result.wrapU = wrap(sampler.wrapS);
            result.wrapV = wrap(sampler.wrapT);
            result.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        const auto transform = info.extensions.find("KHR_texture_transform");
        if (transform != info.extensions.end()) {
            result.transform = matrix(transform->second);
            result.uvSet = static_cast<int>(numberOf(transform->second, "texCoord", result.uvSet));
        }
        if (result.uvSet > 1) {
            warn(fmt::format("texture {} wants texture coordinates {}, of which there are 0 and 1 "
                             "only; it is ignored",
                             info.index, result.uvSet));
            return {};
        }
        return result;
    }

    static Wrap wrap(int mode) {
        switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::ClampToEdge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::MirroredRepeat;
        default:
            return Wrap::Repeat;
        }
    }

    /// Translation * rotation * scale. The rotation is counter-clockwise as one sees it, and v
    /// points down: the sign that the sample models and viewers have, and not that of the
    /// extension's GLSL listing.
    static glm::mat3 matrix(const tinygltf::Value& transform) {
        const auto pair = [&](const char* name, double otherwise) {
            glm::dvec2 result(otherwise);
            const tinygltf::Value& value = transform.Get(name);
            if (value.IsArray() && value.ArrayLen() == 2) {
                result = {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
            }
            return result;
        };
        const glm::dvec2 offset = pair("offset", 0.0);
        const glm::dvec2 scale = pair("scale", 1.0);
        const double angle = numberOf(transform, "rotation", 0.0);
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        return glm::mat3(glm::dmat3(c * scale.x, -s * scale.x, 0.0, // column: what u does
                                    s * scale.y, c * scale.y, 0.0,  // column: what v does
                                    offset.x, offset.y, 1.0));
    }

    /// Index into Scene::images, read when first asked for.
    int image(std::size_t index) {
        int& result = mImages[index];
        if (result != kUnread) {
            return result;
        }
        result = kUnreadable;
        const GltfImage& source = mDocument.images[index];
        const std::string place =
            fmt::format("{}, image {}{}", quoted(mDocument.file), index,
                        source.name.empty() ? "" : fmt::format(" '{}'", source.name));
        try {
            Image picture = decode(source, place);
            result = static_cast<int>(mScene.images.size());
            mScene.images.push_back(std::move(picture));
        } catch (const InputError& error) {
            mScene.warnings.push_back(fmt::format("{}; going on without it", error.what()));
        }
        return result;
    }

    Image decode(const GltfImage& source, const std::string& place) const {
        Image picture;
        if (source.bufferView) {
            picture = decodeImage(mDocument.bytesOf(*source.bufferView), place);
        } else if (isDataUri(source.uri)) {
            const auto bytes = decodeDataUri(source.uri);
            if (!bytes) {
                throw InputError(place, "its data URI is not valid base64");
            }
            picture = decodeImage(*bytes, place);
        } else {
            const auto path = resolveUri(mDocument.file, source.uri);
            if (!path) {
                throw InputError(place,
                                 fmt::format("'{}' is not a relative path", excerpt(source.uri)));
            }
            picture = decodeImage(readFile(*path), quoted(*path));
            picture.name = path->filename().string();
        }
        picture.name = source.name.empty() ? picture.name : source.name;
        return picture;
    }
};

} // namespace

void addMaterials(const GltfDocument& document, Scene& scene) {
    MaterialReader(document, scene).read();
}

} // namespace celadon::loaders
