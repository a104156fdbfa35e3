#include "renderer/scene/gltf_lights.h"

#include "renderer/scene/light.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace celadon::loaders {

using nlohmann::json;

namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

void dropExtension(json& object) {
    if (object.contains("extensions")) {
        object["extensions"].erase(kExtension);
        if (object["extensions"].empty()) {
            object.erase("extensions");
        }
    }
}

void dropLights(json& document) {
    dropExtension(document);
    for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
        if (document.contains(list)) {
            std::erase(document[list].get_ref<json::array_t&>(), json(kExtension));
            if (document[list].empty()) { // which the format does not allow
                document.erase(list);
            }
        }
    }
    if (document.contains("nodes")) {
        for (json& node : document["nodes"]) {
            dropExtension(node);
        }
    }
}

/// x, y, z, w: turns -z, where a light of a node shines, to a direction.
json rotationTo(const glm::dvec3& direction) {
    const glm::dvec3 to = glm::normalize(direction);
    const glm::dvec3 axis = glm::cross(glm::dvec3(0.0, 0.0, -1.0), to);
    glm::dvec4 q(axis, 1.0 - to.z);
    q = glm::length(q) > 1e-6 ? glm::normalize(q) : glm::dvec4(0.0, 1.0, 0.0, 0.0);
    return {q.x, q.y, q.z, q.w};
}

json describe(const NamedLight& named) {
    const Light& light = named.light;
    const double intensity = std::max({light.color.r, light.color.g, light.color.b});
    const glm::dvec3 color = intensity > 0.0 ? light.color / intensity : glm::dvec3(1.0);
    json made = {{"name", named.name},
                 {"type", lightKindName(light.kind)},
                 {"color", {color.r, color.g, color.b}},
                 {"intensity", intensity}};
    if (light.kind == Light::Kind::Spot) {
        made["spot"] = {{"innerConeAngle", light.innerConeRadians},
                        {"outerConeAngle", light.outerConeRadians}};
    }
    return made;
}

} // namespace

void putLights(json& document, std::span<const NamedLight> lights) {
    dropLights(document);
    if (lights.empty()) {
        return;
    }
    document["extensionsUsed"].push_back(kExtension);
    json& list = document["extensions"][kExtension]["lights"];
    json& scene = document["scenes"][document.value("scene", std::size_t{0})];
    for (const NamedLight& named : lights) {
        json node = {{"name", named.name},
                     {"extensions", {{kExtension, {{"light", list.size()}}}}}};
        if (named.light.kind != Light::Kind::Directional) {
            const glm::dvec3& p = named.light.position;
            node["translation"] = {p.x, p.y, p.z};
        }
        if (named.light.kind != Light::Kind::Point) {
            node["rotation"] = rotationTo(named.light.direction);
        }
        list.push_back(describe(named));
        scene["nodes"].push_back(document["nodes"].size());
        document["nodes"].push_back(std::move(node));
    }
}

} // namespace celadon::loaders
