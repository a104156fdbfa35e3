#pragma once

#include "renderer/scene/world.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

/// The looks of a world's parts as glTF materials, with their textures.
namespace celadon {

class GltfLooks {
public:
    /// Both are added to as looks are asked for, and must outlive this.
    GltfLooks(const World& world, nlohmann::json& document, std::string& buffer)
        : mWorld(world), mDocument(document), mBuffer(buffer) {}

    /// @param look       index into World::looks
    /// @param scattering what a scattering part is to standard viewers; null: an opaque part
    /// @return index of the material in the document, made when first asked for
    std::size_t material(int look, const nlohmann::json* scattering);

private:
    [[nodiscard]] nlohmann::json opaque(const SurfaceMaterial& look);
    void addTextures(const SurfaceMaterial& look, bool isOpaque, nlohmann::json& material);
    void use(const char* extension);
    [[nodiscard]] nlohmann::json textureInfo(const TextureReference& reference);
    [[nodiscard]] std::size_t image(int index);

    const World& mWorld;
    nlohmann::json& mDocument;
    std::string& mBuffer;
    std::map<std::pair<int, const nlohmann::json*>, std::size_t> mMaterials;
    std::map<int, std::size_t> mImages; ///< of World::images
};

} // namespace celadon
