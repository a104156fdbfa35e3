#include "renderer/scene/load_gltf_check_data.h"

#include <string_view>

namespace celadon::loaders {

namespace {

class MeshChecker {
public:
    MeshChecker(const JsonElement& root, const CheckedData& data)
        : mRoot(root),
          mAccessors(data.accessors),
          mNodeCount(sizeOf(root, "nodes")),
          mMaterialCount(sizeOf(root, "materials")) {}

    void check() const {
        for (const JsonElement& mesh : mRoot.objects("meshes", "mesh")) {
            (void)mesh.numbers("weights", 0);
            for (const JsonElement& primitive : mesh.objects("primitives", "primitive")) {
                checkPrimitive(primitive);
            }
        }
        checkSkins();
    }

private:
    const JsonElement& mRoot;
    const std::vector<CheckedAccessor>& mAccessors;
    std::size_t mNodeCount, mMaterialCount;

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
        } else if (!isTarget && name == "COLOR_0") {
            wanted = "VEC3 or VEC4";
        } else {
            return;
        }
        const CheckedAccessor& accessor = mAccessors[accessorIndex(attributes, name.c_str())];
        if (wanted.find(accessor.type) == std::string_view::npos) {
            attributes.fail(fmt::format("{} is of type {}, not {}", name, accessor.type, wanted));
        }
        if (accessor.count != vertices) {
            attributes.fail(fmt::format("{} has {} elements, but there are {} vertices", name,
                                        accessor.count, vertices));
        }
        if (name == "COLOR_0" && accessor.componentType != kUnsignedByte &&
            accessor.componentType != kUnsignedShort && accessor.componentType != kFloat) {
            attributes.fail(fmt::format("{} has component type {}, not 5121, 5123 or 5126", name,
                                        accessor.componentType));
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
};

} // namespace

void checkMeshes(const JsonElement& root, const CheckedData& data) {
    MeshChecker(root, data).check();
}

} // namespace celadon::loaders
