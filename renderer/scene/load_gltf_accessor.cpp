#include "renderer/scene/load_gltf_accessor.h"

#include "renderer/scene/load_bytes.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace celadon::loaders {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF data is read as it lies");

const tinygltf::Accessor& accessorAt(const GltfDocument& document, int accessor) {
    return document.model.accessors[static_cast<std::size_t>(accessor)];
}

template<typename T>
T load(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// One component as a number: integers as they are, or, normalized, in [-1, 1] (glTF 2.0, 3.11).
template<typename Number>
Number component(const char* bytes, int componentType, bool normalized) {
    const auto scaled = [&](auto value) {
        if constexpr (std::is_floating_point_v<Number>) {
            if (normalized) {
                const double most = std::numeric_limits<decltype(value)>::max();
                return static_cast<Number>(std::max(static_cast<double>(value) / most, -1.0));
            }
        }
        return static_cast<Number>(value);
    };
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return scaled(load<std::int8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return scaled(load<std::uint8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return scaled(load<std::int16_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return scaled(load<std::uint16_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return scaled(load<std::uint32_t>(bytes));
    default:
        break;
    }
    if constexpr (std::is_floating_point_v<Number>) {
        return load<float>(bytes);
    } else {
        CELADON_ASSERT(!"indices and joints are unsigned: checked");
        return 0;
    }
}

/// `components` numbers an element, for all elements of the accessor.
template<typename Element, typename Number>
std::vector<Element> readElements(const GltfDocument& document, int index, int components) {
    const tinygltf::Accessor& accessor = accessorAt(document, index);
    const int componentBytes =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const std::size_t elementBytes = static_cast<std::size_t>(componentBytes * components);
    std::vector<Element> result(accessor.count, Element(Number(0)));
    const auto read = [&](const char* bytes, Element& element) {
        Number numbers[16];
        for (int k = 0; k < components; ++k) {
            numbers[k] = component<Number>(bytes + k * componentBytes, accessor.componentType,
                                           accessor.normalized);
        }
        std::memcpy(static_cast<void*>(&element), numbers, sizeof(Element));
    };
    if (accessor.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(accessor.bufferView);
        const std::string_view bytes = document.bytesOf(view);
        const std::size_t given = document.model.bufferViews[view].byteStride;
        const std::size_t stride = given == 0 ? elementBytes : given;
        for (std::size_t i = 0; i < accessor.count; ++i) {
            read(bytes.data() + accessor.byteOffset + i * stride, result[i]);
        }
    }
    if (accessor.sparse.isSparse) {
        const auto& sparse = accessor.sparse;
        const std::string_view indices =
            document.bytesOf(static_cast<std::size_t>(sparse.indices.bufferView));
        const std::string_view values =
            document.bytesOf(static_cast<std::size_t>(sparse.values.bufferView));
        const int indexBytes = tinygltf::GetComponentSizeInBytes(
            static_cast<std::uint32_t>(sparse.indices.componentType));
        for (int i = 0; i < sparse.count; ++i) {
            const auto target = component<std::uint32_t>(
                indices.data() + sparse.indices.byteOffset + std::ptrdiff_t{i} * indexBytes,
                sparse.indices.componentType, false);
            if (target >= accessor.count) {
                throw InputError(accessorPlace(document, index),
                                 fmt::format("its sparse index {} is past its {} elements", target,
                                             accessor.count),
                                 "export the model again");
            }
            read(values.data() + sparse.values.byteOffset +
                     i * static_cast<std::ptrdiff_t>(elementBytes),
                 result[target]);
        }
    }
    return result;
}

} // namespace

std::string accessorPlace(const GltfDocument& document, int accessor) {
    const std::string name = excerpt(accessorAt(document, accessor).name);
    return fmt::format("{}, accessor {}{}", quoted(document.file), accessor,
                       name.empty() ? "" : fmt::format(" '{}'", name));
}

std::vector<glm::vec2> readVec2(const GltfDocument& document, int accessor) {
    return readElements<glm::vec2, float>(document, accessor, 2);
}

std::vector<glm::vec3> readVec3(const GltfDocument& document, int accessor) {
    return readElements<glm::vec3, float>(document, accessor, 3);
}

std::vector<glm::vec4> readVec4(const GltfDocument& document, int accessor) {
    return readElements<glm::vec4, float>(document, accessor, 4);
}

std::vector<glm::mat4> readMat4(const GltfDocument& document, int accessor) {
    return readElements<glm::mat4, float>(document, accessor, 16);
}

std::vector<float> readNumbers(const GltfDocument& document, int accessor) {
    return readElements<float, float>(document, accessor, 1);
}

std::vector<std::uint32_t> readIndices(const GltfDocument& document, int accessor) {
    return readElements<std::uint32_t, std::uint32_t>(document, accessor, 1);
}

std::vector<glm::uvec4> readJoints(const GltfDocument& document, int accessor) {
    return readElements<glm::uvec4, std::uint32_t>(document, accessor, 4);
}

} // namespace celadon::loaders
