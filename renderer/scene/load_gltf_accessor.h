#pragma once

#include "renderer/scene/load_gltf_document.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

/// Values of accessors: strided, sparse, normalized, of any component type. The document is
/// checked, so ranges hold; bytes are copied, so that alignment does not matter.
namespace celadon::loaders {

[[nodiscard]] std::vector<glm::vec2> readVec2(const GltfDocument& document, int accessor);
[[nodiscard]] std::vector<glm::vec3> readVec3(const GltfDocument& document, int accessor);
[[nodiscard]] std::vector<glm::vec4> readVec4(const GltfDocument& document, int accessor);
[[nodiscard]] std::vector<glm::mat4> readMat4(const GltfDocument& document, int accessor);

/// Scalars, integers among them normalized where the accessor says so.
[[nodiscard]] std::vector<float> readNumbers(const GltfDocument& document, int accessor);
/// Scalars of an unsigned component type.
[[nodiscard]] std::vector<std::uint32_t> readIndices(const GltfDocument& document, int accessor);
/// Four unsigned integers an element, never normalized.
[[nodiscard]] std::vector<glm::uvec4> readJoints(const GltfDocument& document, int accessor);

/// "'a.gltf', accessor 3 'positions'".
[[nodiscard]] std::string accessorPlace(const GltfDocument& document, int accessor);

} // namespace celadon::loaders
