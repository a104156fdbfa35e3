#pragma once

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/rig.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A glTF that is checked and in memory: its structures from tinygltf, its bytes, its pictures'
/// whereabouts.
namespace celadon::loaders {

/// A picture that is not decoded yet.
struct GltfImage {
    std::string name;
    std::string uri; ///< as in the file: a relative path, or a data URI; or empty
    std::optional<std::size_t> bufferView;
};

/// A channel of an animation with its sampler; the keys are not read yet.
struct GltfChannel {
    std::size_t node = 0;
    AnimatedValue value = AnimatedValue::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::size_t input = 0; ///< accessors
    std::size_t output = 0;
};

struct GltfAnimation {
    std::string name;
    std::vector<GltfChannel> channels;
};

struct GltfDocument {
    std::filesystem::path file;
    tinygltf::Model model;                 ///< without buffers, images and animations
    std::vector<std::string> storage;      ///< bytes that did not come with the file itself
    std::vector<std::string_view> buffers; ///< each exactly byteLength long
    std::vector<GltfImage> images;
    std::vector<GltfAnimation> animations;
    DeformerStack deformers; ///< in the extras of its scene
    std::vector<std::string> warnings;

    GltfDocument() = default;
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;
    GltfDocument(GltfDocument&&) = delete;
    GltfDocument& operator=(GltfDocument&&) = delete;

    [[nodiscard]] std::string_view bytesOf(std::size_t bufferView) const;
};

/// Fills `document`. `content` must outlive it.
/// @throws InputError with the element; see load_gltf_check.h
void openGltf(const std::filesystem::path& file, std::string_view content, GltfDocument& document);

} // namespace celadon::loaders
