#include "renderer/scene/load_gltf_check.h"

#include "renderer/scene/load_bytes.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace celadon::loaders {

namespace {

constexpr std::int64_t kFloat = 5126;
constexpr std::int64_t kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr double kPi = 3.14159265358979323846;

bool isUnsigned(std::int64_t componentType) {
    return componentType == kUnsignedByte || componentType == kUnsignedShort ||
           componentType == kUnsignedInt;
}

/// What the rest of the check wants to know of an accessor.
struct CheckedAccessor {
    std::string type;
    std::int64_t componentType = 0;
    std::uint64_t count = 0;
    bool hasData = false; ///< from a buffer view; else zeros, with sparse values perhaps
};

class Checker {
public:
    Checker(const JsonElement& root, std::span<const std::uint64_t> bufferSizes)
        : mRoot(root),
          mBufferSizes(bufferSizes),
          mTotalBytes(std::accumulate(bufferSizes.begin(), bufferSizes.end(), std::uint64_t{0})) {}

    void check() {
        mNodeCount = sizeOf("nodes");
        mMaterialCount = sizeOf("materials");
        mTextureCount = sizeOf("textures");
        checkBufferViews();
        checkAccessors();
        checkMeshes();
        checkLooks();
        checkCameras();
        checkLights();
        checkSkins();
        checkNodes();
        checkScenes();
    }

private:
    const JsonElement& mRoot;
    std::span<const std::uint64_t> mBufferSizes;
    std::uint64_t mTotalBytes;
    std::size_t mNodeCount = 0, mMaterialCount = 0, mTextureCount = 0, mLightCount = 0;
    std::vector<std::uint64_t> mViewSizes;
    std::vector<std::uint64_t> mViewStrides;
    std::vector<CheckedAccessor> mAccessors;

    [[nodiscard]] std::size_t sizeOf(const char* name) const {
        const auto found = mRoot.value().find(name);
        return found != mRoot.value().end() && found->is_array() ? found->size() : 0;
    }

    static std::uint64_t offsetOf(const JsonElement& element) {
        return static_cast<std::uint64_t>(
            element.integer("byteOffset", 0, static_cast<std::int64_t>(kMaxFileBytes)).value_or(0));
    }

    template<typename T>
    static T required(const JsonElement& element, const char* name, std::optional<T> value) {
        if (!value) {
            element.fail(fmt::format("'{}' is missing", name));
        }
        return *value;
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

    [[nodiscard]] std::size_t accessorIndex(const JsonElement& element, const char* name) const {
        return required(element, name, element.index(name, mAccessors.size(), "accessor"));
    }

    /// Accessor of an attribute that we read; others may be anything.
    void checkAttribute(const JsonElement& attributes, const std::string& name,
                        std::uint64_t vertices, bool isTarget) const {
        std::string_view wanted;
        if (name == "POSITION" || name == "NORMAL") {
            wanted = "VEC3";
        } else if (!isTarget && (name == "TEXCOORD_0" || name == "TEXCOORD_1")) {
            wanted = "VEC2";
        } else if (!isTarget && (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))) {
            wanted = "VEC4";
        } else {
            return;
        }
        const CheckedAccessor& accessor = mAccessors[accessorIndex(attributes, name.c_str())];
        if (accessor.type != wanted) {
            attributes.fail(fmt::format("{} is of type {}, not {}", name, accessor.type, wanted));
        }
        if (accessor.count != vertices) {
            attributes.fail(fmt::format("{} has {} elements, but there are {} vertices", name,
                                        accessor.count, vertices));
        }
        if (name.starts_with("JOINTS_") && accessor.componentType != kUnsignedByte &&
            accessor.componentType != kUnsignedShort) {
            attributes.fail(fmt::format("{} has component type {}, not 5121 or 5123", name,
                                        accessor.componentType));
        }
    }

    void checkPrimitive(const JsonElement& primitive) const {
        const JsonElement attributes =
            required(primitive, "attributes", primitive.object("attributes"));
        (void)primitive.integer("mode", 0, 6);
        (void)primitive.index("material", mMaterialCount, "material");
        for (const auto& item : attributes.value().items()) {
            (void)accessorIndex(attributes, item.key().c_str());
        }
        std::uint64_t vertices = 0;
        if (attributes.value().contains("POSITION")) {
            const CheckedAccessor& position = mAccessors[accessorIndex(attributes, "POSITION")];
            vertices = position.count;
            if (!position.hasData && primitive.extension("KHR_draco_mesh_compression")) {
                primitive.fail("its vertices exist only compressed with KHR_draco_mesh_compression",
                               "export the model without Draco compression");
            }
            for (const auto& item : attributes.value().items()) {
                checkAttribute(attributes, item.key(), vertices, false);
            }
        }
        if (const auto indices = primitive.index("indices", mAccessors.size(), "accessor")) {
            const CheckedAccessor& accessor = mAccessors[*indices];
            if (accessor.type != "SCALAR" || !isUnsigned(accessor.componentType) ||
                !accessor.hasData) {
                primitive.fail(fmt::format("accessor {} cannot hold indices: it must be of type "
                                           "SCALAR, component type 5121, 5123 or 5125, with data",
                                           *indices));
            }
        }
        for (const JsonElement& target : primitive.objects("targets", "morph target")) {
            for (const auto& item : target.value().items()) {
                (void)accessorIndex(target, item.key().c_str());
                checkAttribute(target, item.key(), vertices, true);
            }
        }
    }

    void checkMeshes() const {
        for (const JsonElement& mesh : mRoot.objects("meshes", "mesh")) {
            (void)mesh.numbers("weights", 0);
            for (const JsonElement& primitive : mesh.objects("primitives", "primitive")) {
                checkPrimitive(primitive);
            }
        }
    }

    void checkTextureReference(const JsonElement& owner, const char* name) const {
        const auto reference = owner.object(name);
        if (!reference) {
            return;
        }
        (void)required(*reference, "index", reference->index("index", mTextureCount, "texture"));
        (void)reference->integer("texCoord", 0, 1000);
        (void)reference->number("scale");
        if (const auto transform = reference->extension("KHR_texture_transform")) {
            (void)transform->numbers("offset", 2);
            (void)transform->numbers("scale", 2);
            (void)transform->number("rotation");
            (void)transform->integer("texCoord", 0, 1000);
        }
    }

    void checkLooks() const {
        for (const JsonElement& material : mRoot.objects("materials", "material")) {
            (void)material.numbers("emissiveFactor", 3);
            checkTextureReference(material, "normalTexture");
            checkTextureReference(material, "occlusionTexture");
            checkTextureReference(material, "emissiveTexture");
            if (const auto look = material.object("pbrMetallicRoughness")) {
                (void)look->numbers("baseColorFactor", 4);
                (void)look->number("metallicFactor");
                (void)look->number("roughnessFactor");
                checkTextureReference(*look, "baseColorTexture");
                checkTextureReference(*look, "metallicRoughnessTexture");
            }
            if (const auto ior = material.extension("KHR_materials_ior")) {
                const double value = ior->number("ior").value_or(1.5);
                if (value != 0.0 && value < 1.0) { // 0 stands for a mirror, says the extension
                    ior->fail(fmt::format("'ior' is {}, below 1", value));
                }
            }
            if (const auto strength = material.extension("KHR_materials_emissive_strength")) {
                if (strength->number("emissiveStrength").value_or(1.0) < 0.0) {
                    strength->fail("'emissiveStrength' is negative");
                }
            }
        }
        const std::size_t images = sizeOf("images");
        const std::size_t samplers = sizeOf("samplers");
        for (const JsonElement& texture : mRoot.objects("textures", "texture")) {
            (void)texture.index("source", images, "image");
            (void)texture.index("sampler", samplers, "sampler");
        }
        for (const JsonElement& sampler : mRoot.objects("samplers", "sampler")) {
            for (const char* const name : {"wrapS", "wrapT", "magFilter", "minFilter"}) {
                (void)sampler.integer(name, 0, 65535);
            }
        }
        for (const JsonElement& image : mRoot.objects("images", "image")) {
            (void)image.index("bufferView", mViewSizes.size(), "buffer view");
            (void)image.string("uri");
        }
    }

    void checkCameras() const {
        for (const JsonElement& camera : mRoot.objects("cameras", "camera")) {
            const std::string type = required(camera, "type", camera.string("type"));
            if (type == "perspective") {
                const JsonElement lens =
                    required(camera, "perspective", camera.object("perspective"));
                const double yfov = required(lens, "yfov", lens.number("yfov"));
                if (!(yfov > 0.0 && yfov < kPi)) {
                    lens.fail(fmt::format("'yfov' is {}, outside 0 ... pi", yfov));
                }
            } else if (type == "orthographic") {
                const JsonElement lens =
                    required(camera, "orthographic", camera.object("orthographic"));
                if (required(lens, "ymag", lens.number("ymag")) == 0.0) {
                    lens.fail("'ymag' is 0");
                }
            } else {
                camera.fail(fmt::format("type '{}' is unknown", excerpt(type)));
            }
        }
    }

    void checkLights() {
        const auto extension = mRoot.extension("KHR_lights_punctual");
        if (!extension) {
            return;
        }
        for (const JsonElement& light : extension->objects("lights", "light")) {
            ++mLightCount;
            const std::string type = required(light, "type", light.string("type"));
            if (type != "directional" && type != "point" && type != "spot") {
                light.fail(fmt::format("type '{}' is unknown", excerpt(type)));
            }
            for (const double channel : light.numbers("color", 3).value_or(std::vector{1.0})) {
                if (channel < 0.0) {
                    light.fail("'color' is negative");
                }
            }
            if (light.number("intensity").value_or(1.0) < 0.0) {
                light.fail("'intensity' is negative");
            }
            if (type == "spot") {
                const JsonElement spot = required(light, "spot", light.object("spot"));
                const double inner = spot.number("innerConeAngle").value_or(0.0);
                const double outer = spot.number("outerConeAngle").value_or(kPi / 4.0);
                // Exporters round pi/2 up, and write equal cones for a hard border.
                if (inner < 0.0 || outer <= 0.0 || inner > outer || outer > kPi / 2.0 + 1e-3) {
                    spot.fail(fmt::format(
                        "cones of {} and {} rad are not 0 <= inner < outer <= pi/2", inner, outer));
                }
            }
        }
    }

    void checkSkins() const {
        for (const JsonElement& skin : mRoot.objects("skins", "skin")) {
            const std::size_t joints = skin.indices("joints", mNodeCount, "node").size();
            if (joints == 0) {
                skin.fail("has no joints");
            }
            const auto matrices = skin.index("inverseBindMatrices", mAccessors.size(), "accessor");
            if (matrices && (mAccessors[*matrices].type != "MAT4" ||
                             mAccessors[*matrices].componentType != kFloat ||
                             mAccessors[*matrices].count < joints)) {
                skin.fail(
                    fmt::format("accessor {} does not hold {} matrices of type MAT4, component "
                                "type 5126",
                                *matrices, joints));
            }
        }
    }

    void checkNodes() const {
        const std::size_t meshes = sizeOf("meshes");
        const std::size_t skins = sizeOf("skins");
        const std::size_t cameras = sizeOf("cameras");
        const std::vector<JsonElement> nodes = mRoot.objects("nodes", "node");
        constexpr std::size_t kNobody = SIZE_MAX;
        std::vector<std::size_t> parents(nodes.size(), kNobody);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const JsonElement& node = nodes[i];
            (void)node.index("mesh", meshes, "mesh");
            (void)node.index("skin", skins, "skin");
            (void)node.index("camera", cameras, "camera");
            (void)node.numbers("matrix", 16);
            (void)node.numbers("translation", 3);
            (void)node.numbers("rotation", 4);
            (void)node.numbers("scale", 3);
            (void)node.numbers("weights", 0);
            if (const auto light = node.extension("KHR_lights_punctual")) {
                (void)required(*light, "light", light->index("light", mLightCount, "light"));
            }
            for (const std::size_t child : node.indices("children", nodes.size(), "node")) {
                if (parents[child] != kNobody) {
                    nodes[child].fail(
                        fmt::format("is a child of node {} and of node {}", parents[child], i));
                }
                parents[child] = i;
            }
        }
        // With one parent at most, what cannot be reached from a node without one is a cycle.
        std::vector<std::size_t> open;
        std::size_t reached = 0;
        std::vector<bool> seen(nodes.size(), false);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (parents[i] == kNobody) {
                open.push_back(i);
            }
        }
        while (!open.empty()) {
            const std::size_t node = open.back();
            open.pop_back();
            seen[node] = true;
            ++reached;
            for (const std::size_t child : nodes[node].indices("children", nodes.size(), "node")) {
                open.push_back(child);
            }
        }
        if (reached < nodes.size()) {
            const auto first = std::find(seen.begin(), seen.end(), false) - seen.begin();
            nodes[static_cast<std::size_t>(first)].fail("is its own ancestor");
        }
        for (const JsonElement& scene : mRoot.objects("scenes", "scene")) {
            std::vector<bool> listed(nodes.size(), false);
            for (const std::size_t root : scene.indices("nodes", nodes.size(), "node")) {
                if (parents[root] != kNobody || listed[root]) {
                    scene.fail(fmt::format(
                        "lists node {}, which {}", root,
                        listed[root] ? "it has already"
                                     : fmt::format("is a child of node {}", parents[root])));
                }
                listed[root] = true;
            }
        }
    }

    void checkScenes() const { (void)mRoot.index("scene", sizeOf("scenes"), "scene"); }
};

/// Extensions that a file may require of us.
constexpr std::array kSupported{"KHR_lights_punctual",   "KHR_texture_transform",
                                "KHR_mesh_quantization", "KHR_materials_ior",
                                "KHR_materials_unlit",   "KHR_materials_emissive_strength"};

/// Optional extensions that may be ignored without a word.
constexpr std::array kSilent{"KHR_draco_mesh_compression",
                             "EXT_meshopt_compression",
                             "KHR_materials_variants",
                             "KHR_xmp_json_ld",
                             "KHR_xmp",
                             "KHR_animation_pointer",
                             "KHR_node_visibility",
                             "MSFT_lod",
                             "EXT_texture_webp",
                             "KHR_texture_basisu"};

template<std::size_t N>
bool contains(const std::array<const char*, N>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> extensionNames(const JsonElement& root, const char* member) {
    std::vector<std::string> names;
    const auto found = root.value().find(member);
    if (found == root.value().end()) {
        return names;
    }
    for (const nlohmann::json& name : found->is_array() ? *found : nlohmann::json::array()) {
        if (name.is_string()) {
            names.push_back(excerpt(name.get_ref<const std::string&>()));
        }
    }
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

} // namespace

int GltfElement::columnStride() const {
    const int tight = components / std::max(columns, 1) * componentBytes;
    return columns == 1 ? tight : (tight + 3) / 4 * 4;
}

int GltfElement::bytes() const {
    return columns * columnStride();
}

GltfElement gltfElement(const std::string& type, std::int64_t componentType) {
    GltfElement element;
    static const std::map<std::string, std::pair<int, int>> kTypes{
        {"SCALAR", {1, 1}}, {"VEC2", {2, 1}}, {"VEC3", {3, 1}}, {"VEC4", {4, 1}},
        {"MAT2", {4, 2}},   {"MAT3", {9, 3}}, {"MAT4", {16, 4}}};
    const auto found = kTypes.find(type);
    switch (componentType) {
    case 5120:
    case kUnsignedByte:
        element.componentBytes = 1;
        break;
    case 5122:
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

void checkGltfVersion(const JsonElement& root) {
    const auto asset = root.object("asset");
    const std::string version = asset ? asset->string("version").value_or("") : "";
    if (version.empty()) {
        root.fail("does not say its version ('asset.version')", "is it a glTF? export it again");
    }
    const auto least = asset->string("minVersion");
    if (!version.starts_with("2.") || (least && *least != "2.0")) {
        root.fail(fmt::format("is glTF {}, not 2.0", excerpt(least ? *least : version)),
                  "export it as glTF 2.0");
    }
    std::vector<std::string> missing;
    for (const std::string& name : extensionNames(root, "extensionsRequired")) {
        if (!contains(kSupported, name)) {
            missing.push_back(name);
        }
    }
    if (missing.empty()) {
        return;
    }
    const std::string first = missing.front();
    const char* remedy = "export it without";
    if (first == "KHR_draco_mesh_compression") {
        remedy = "export it without Draco compression";
    } else if (first == "EXT_meshopt_compression") {
        remedy = "export it without meshopt compression";
    } else if (first == "KHR_texture_basisu") {
        remedy = "export it with PNG or JPEG pictures";
    }
    root.fail(fmt::format("requires {}, which Celadon does not have", joined(missing)), remedy);
}

std::vector<std::string> unsupportedExtensions(const JsonElement& root) {
    std::vector<std::string> ignored;
    for (const std::string& name : extensionNames(root, "extensionsUsed")) {
        if (!contains(kSupported, name) && !contains(kSilent, name)) {
            ignored.push_back(name);
        }
    }
    if (ignored.empty()) {
        return {};
    }
    return {fmt::format("{}: ignores {}", root.where(), joined(ignored))};
}

void checkGltf(const JsonElement& root, std::span<const std::uint64_t> bufferSizes) {
    Checker(root, bufferSizes).check();
}

} // namespace celadon::loaders
