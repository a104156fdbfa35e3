#include "renderer/scene/load_gltf_check.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_check_data.h"

#include <fmt/format.h>

#include <algorithm>

namespace celadon::loaders {

namespace {

constexpr double kPi = 3.14159265358979323846;

void checkTextureReference(const JsonElement& owner, const char* name, std::size_t textures) {
    const auto reference = owner.object(name);
    if (!reference) {
        return;
    }
    (void)required(*reference, "index", reference->index("index", textures, "texture"));
    (void)reference->integer("texCoord", 0, 1000);
    (void)reference->number("scale");
    if (const auto transform = reference->extension("KHR_texture_transform")) {
        (void)transform->numbers("offset", 2);
        (void)transform->numbers("scale", 2);
        (void)transform->number("rotation");
        (void)transform->integer("texCoord", 0, 1000);
    }
}

void checkLooks(const JsonElement& root, std::size_t bufferViews) {
    const std::size_t textures = sizeOf(root, "textures");
    for (const JsonElement& material : root.objects("materials", "material")) {
        (void)material.numbers("emissiveFactor", 3);
        (void)material.string("alphaMode");
        (void)material.number("alphaCutoff");
        checkTextureReference(material, "normalTexture", textures);
        checkTextureReference(material, "occlusionTexture", textures);
        checkTextureReference(material, "emissiveTexture", textures);
        if (const auto look = material.object("pbrMetallicRoughness")) {
            (void)look->numbers("baseColorFactor", 4);
            (void)look->number("metallicFactor");
            (void)look->number("roughnessFactor");
            checkTextureReference(*look, "baseColorTexture", textures);
            checkTextureReference(*look, "metallicRoughnessTexture", textures);
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
    const std::size_t images = sizeOf(root, "images");
    const std::size_t samplers = sizeOf(root, "samplers");
    for (const JsonElement& texture : root.objects("textures", "texture")) {
        (void)texture.index("source", images, "image");
        (void)texture.index("sampler", samplers, "sampler");
    }
    for (const JsonElement& sampler : root.objects("samplers", "sampler")) {
        for (const char* const name : {"wrapS", "wrapT", "magFilter", "minFilter"}) {
            (void)sampler.integer(name, 0, 65535);
        }
    }
    for (const JsonElement& image : root.objects("images", "image")) {
        (void)image.index("bufferView", bufferViews, "buffer view");
        (void)image.string("uri");
    }
}

void checkCameras(const JsonElement& root) {
    for (const JsonElement& camera : root.objects("cameras", "camera")) {
        const std::string type = required(camera, "type", camera.string("type"));
        if (type == "perspective") {
            const JsonElement lens = required(camera, "perspective", camera.object("perspective"));
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

/// @return how many there are
std::size_t checkLights(const JsonElement& root) {
    const auto extension = root.extension("KHR_lights_punctual");
    std::size_t count = 0;
    if (!extension) {
        return count;
    }
    for (const JsonElement& light : extension->objects("lights", "light")) {
        ++count;
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
                spot.fail(fmt::format("cones of {} and {} rad are not 0 <= inner < outer <= pi/2",
                                      inner, outer));
            }
        }
    }
    return count;
}

void checkNodes(const JsonElement& root, std::size_t lights) {
    const std::size_t meshes = sizeOf(root, "meshes");
    const std::size_t skins = sizeOf(root, "skins");
    const std::size_t cameras = sizeOf(root, "cameras");
    const std::vector<JsonElement> nodes = root.objects("nodes", "node");
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
            (void)required(*light, "light", light->index("light", lights, "light"));
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
    for (const JsonElement& scene : root.objects("scenes", "scene")) {
        std::vector<bool> listed(nodes.size(), false);
        for (const std::size_t top : scene.indices("nodes", nodes.size(), "node")) {
            if (parents[top] != kNobody || listed[top]) {
                scene.fail(fmt::format("lists node {}, which {}", top,
                                       listed[top]
                                           ? "it has already"
                                           : fmt::format("is a child of node {}", parents[top])));
            }
            listed[top] = true;
        }
    }
}

} // namespace

void checkGltf(const JsonElement& root, std::span<const std::uint64_t> bufferSizes) {
    const CheckedData data = checkData(root, bufferSizes);
    checkMeshes(root, data);
    checkLooks(root, data.bufferViews);
    checkCameras(root);
    checkNodes(root, checkLights(root));
    (void)root.index("scene", sizeOf(root, "scenes"), "scene");
}

} // namespace celadon::loaders
