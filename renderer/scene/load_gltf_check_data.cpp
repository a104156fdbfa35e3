#include "renderer/scene/load_gltf_check_data.h"

#include "renderer/scene/load_bytes.h"

#include <map>
#include <numeric>
#include <utility>

namespace celadon::loaders {

namespace {

/// What one element of an accessor is made of.
struct GltfElement {
    int components = 0;
    int componentBytes = 0;
    int columns = 1; ///< of a matrix; its columns start at multiples of 4

    /// Of the element, tightly packed.
    [[nodiscard]] int bytes() const {
        const int column = components / columns * componentBytes;
        return columns == 1 ? column : columns * ((column + 3) / 4 * 4);
    }
};

/// `type` as glTF has it ("VEC3"), `componentType` as GL has it (5126); zeros when unknown.
GltfElement gltfElement(const std::string& type, std::int64_t componentType) {
    GltfElement element;
    static const std::map<std::string, std::pair<int, int>> kTypes{
        {"SCALAR", {1, 1}}, {"VEC2", {2, 1}}, {"VEC3", {3, 1}}, {"VEC4", {4, 1}},
        {"MAT2", {4, 2}},   {"MAT3", {9, 3}}, {"MAT4", {16, 4}}};
    const auto found = kTypes.find(type);
    switch (componentType) {
    case kByte:
    case kUnsignedByte:
        element.componentBytes = 1;
        break;
    case kShort:
    case kUnsignedShort:
        element.componentBytes = 2;
        break;
    case kUnsignedInt:
    case kFloat:
        element.componentBytes = 4;
        break;
    default:
        break;
    }
    if (found != kTypes.end() && element.componentBytes != 0) {
        element.components = found->second.first;
        element.columns = found->second.second;
    }
    return element;
}

class DataChecker {
public:
    DataChecker(const JsonElement& root, std::span<const std::uint64_t> bufferSizes)
        : mRoot(root),
          mBufferSizes(bufferSizes),
          mTotalBytes(std::accumulate(bufferSizes.begin(), bufferSizes.end(), std::uint64_t{0})) {}

    [[nodiscard]] CheckedData check() {
        checkBufferViews();
        checkAccessors();
        return {mViewSizes.size(), std::move(mAccessors)};
    }

private:
    const JsonElement& mRoot;
    std::span<const std::uint64_t> mBufferSizes;
    std::uint64_t mTotalBytes;
    std::vector<std::uint64_t> mViewSizes;
    std::vector<std::uint64_t> mViewStrides;
    std::vector<CheckedAccessor> mAccessors;

    static std::uint64_t offsetOf(const JsonElement& element) {
        return static_cast<std::uint64_t>(
            element.integer("byteOffset", 0, static_cast<std::int64_t>(kMaxFileBytes)).value_or(0));
    }

    void checkBufferViews() {
        for (const JsonElement& view : mRoot.objects("bufferViews", "buffer view")) {
            const std::size_t buffer =
                required(view, "buffer", view.index("buffer", mBufferSizes.size(), "buffer"));
            const std::uint64_t offset = offsetOf(view);
            const auto length = static_cast<std::uint64_t>(
                required(view, "byteLength", view.integer("byteLength", 1, INT64_MAX)));
            if (offset > mBufferSizes[buffer] || length > mBufferSizes[buffer] - offset) {
                view.fail(fmt::format("its {} bytes from {} go past the {} of buffer {}", length,
                                      offset, mBufferSizes[buffer], buffer),
                          "the file is damaged or cut short: export it again");
            }
            mViewSizes.push_back(length);
            mViewStrides.push_back(
                static_cast<std::uint64_t>(view.integer("byteStride", 0, 252).value_or(0)));
        }
    }

    /// `count` elements of `elementBytes` from `offset` on, `stride` apart, lie within the view.
    void checkRange(const JsonElement& element, std::size_t view, std::uint64_t offset,
                    std::uint64_t stride, std::uint64_t elementBytes, std::uint64_t count) const {
        const std::uint64_t size = mViewSizes[view];
        const bool fits = offset <= size &&
                          (count == 0 || (elementBytes <= size - offset &&
                                          count - 1 <= (size - offset - elementBytes) / stride));
        if (!fits) {
            element.fail(
                fmt::format("{} elements of {} bytes, {} apart, from {} go past the {} bytes "
                            "of buffer view {}",
                            count, elementBytes, stride, offset, size, view),
                "the file is damaged or cut short: export it again");
        }
    }

    void checkAccessors() {
        for (const JsonElement& accessor : mRoot.objects("accessors", "accessor")) {
            CheckedAccessor result;
            result.type = required(accessor, "type", accessor.string("type"));
            result.componentType = required(accessor, "componentType",
                                            accessor.integer("componentType", 0, INT64_MAX));
            result.count = static_cast<std::uint64_t>(required(
                accessor, "count", accessor.integer("count", 0, std::int64_t{kMaxElements} * 8)));
            const GltfElement element = gltfElement(result.type, result.componentType);
            if (element.bytes() == 0) {
                accessor.fail(fmt::format("type '{}' of component type {} is unknown",
                                          excerpt(result.type), result.componentType));
            }
            const auto elementBytes = static_cast<std::uint64_t>(element.bytes());
            const auto view = accessor.index("bufferView", mViewSizes.size(), "buffer view");
            const std::uint64_t offset = offsetOf(accessor);
            if (view) {
                const std::uint64_t stride =
                    mViewStrides[*view] == 0 ? elementBytes : mViewStrides[*view];
                if (stride < elementBytes) {
                    accessor.fail(fmt::format("its elements of {} bytes are {} bytes apart",
                                              elementBytes, stride));
                }
                checkRange(accessor, *view, offset, stride, elementBytes, result.count);
                result.hasData = true;
            } else if (result.count * elementBytes > 8 * mTotalBytes + 65536) {
                // Zeros take no space in the file. They serve sparse morph targets, whose size that
                // of the data bounds.
                accessor.fail(
                    fmt::format("{} zeros without a buffer view, in a file of {} bytes of "
                                "data",
                                result.count, mTotalBytes));
            }
            if (const auto sparse = accessor.object("sparse")) {
                checkSparse(*sparse, result.count, elementBytes);
            }
            mAccessors.push_back(std::move(result));
        }
    }

    void checkSparse(const JsonElement& sparse, std::uint64_t elements,
                     std::uint64_t elementBytes) const {
        const auto count = static_cast<std::uint64_t>(required(
            sparse, "count", sparse.integer("count", 1, static_cast<std::int64_t>(elements))));
        const JsonElement indices = required(sparse, "indices", sparse.object("indices"));
        const JsonElement values = required(sparse, "values", sparse.object("values"));
        const std::int64_t type =
            required(indices, "componentType", indices.integer("componentType", 0, INT64_MAX));
        if (!isUnsigned(type)) {
            indices.fail(fmt::format("component type {} is not an unsigned one", type));
        }
        const auto indexBytes = static_cast<std::uint64_t>(gltfElement("SCALAR", type).bytes());
        const std::size_t indexView = required(
            indices, "bufferView", indices.index("bufferView", mViewSizes.size(), "buffer view"));
        const std::size_t valueView = required(
            values, "bufferView", values.index("bufferView", mViewSizes.size(), "buffer view"));
        checkRange(indices, indexView, offsetOf(indices), indexBytes, indexBytes, count);
        checkRange(values, valueView, offsetOf(values), elementBytes, elementBytes, count);
    }
};

} // namespace

bool isUnsigned(std::int64_t componentType) {
    return componentType == kUnsignedByte || componentType == kUnsignedShort ||
           componentType == kUnsignedInt;
}

std::size_t sizeOf(const JsonElement& root, const char* name) {
    const auto found = root.value().find(name);
    return found != root.value().end() && found->is_array() ? found->size() : 0;
}

CheckedData checkData(const JsonElement& root, std::span<const std::uint64_t> bufferSizes) {
    return DataChecker(root, bufferSizes).check();
}

} // namespace celadon::loaders
