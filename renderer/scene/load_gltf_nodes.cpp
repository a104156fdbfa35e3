#include "renderer/scene/load_gltf_nodes.h"

#include "renderer/scene/load_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace celadon::loaders {

namespace {

constexpr double kPi = 3.14159265358979323846;

glm::dvec3 unit(const glm::dvec4& v, const glm::dvec3& otherwise) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0.0 && std::isfinite(length) ? glm::dvec3(v) / length : otherwise;
}

bool isFinite(const glm::dvec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Camera makeCamera(const tinygltf::Camera& source, const glm::dmat4& world,
                  const glm::dvec3& center) {
    Camera camera;
    camera.name = source.name;
    camera.eye = glm::dvec3(world[3]);
    const glm::dvec3 forward = -unit(world[2], {0.0, 0.0, 1.0});
    const double depth = glm::dot(center - camera.eye, forward);
    camera.at = camera.eye + forward * (depth > 0.0 ? depth : 1.0);
    camera.up = unit(world[1], {0.0, 1.0, 0.0});
    if (source.type == "perspective") {
        camera.fovYDegrees = source.perspective.yfov * 180.0 / kPi;
    } else {
        camera.orthographicHeight = 2.0 * std::abs(source.orthographic.ymag);
    }
    return camera;
}

/// KHR_lights_punctual; lux and candela stand for W/m^2 and W/sr (DESIGN section 1).
Light makeLight(const tinygltf::Light& source, const glm::dmat4& world) {
    Light light;
    light.kind = source.type == "directional" ? Light::Kind::Directional
                 : source.type == "point"     ? Light::Kind::Point
                                              : Light::Kind::Spot;
    light.position = glm::dvec3(world[3]);
    light.direction = -unit(world[2], {0.0, 0.0, 1.0});
    light.color = glm::dvec3(source.intensity);
    if (source.color.size() == 3) {
        light.color *= glm::dvec3(source.color[0], source.color[1], source.color[2]);
    }
    if (light.kind == Light::Kind::Spot) {
        light.outerConeRadians = std::min(source.spot.outerConeAngle, 0.5 * kPi);
        // The seam of a hard cone gets a width, so that inner < outer.
        light.innerConeRadians =
            std::min(source.spot.innerConeAngle, light.outerConeRadians * (1.0 - 1e-4));
    }
    return light;
}

} // namespace

std::vector<std::size_t> shownNodes(const GltfDocument& document) {
    const tinygltf::Model& model = document.model;
    std::vector<std::size_t> open;
    if (model.scenes.empty()) {
        std::vector<bool> isChild(model.nodes.size(), false);
        for (const tinygltf::Node& node : model.nodes) {
            for (const int child : node.children) {
                isChild[static_cast<std::size_t>(child)] = true;
            }
        }
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (!isChild[i]) {
                open.push_back(i);
            }
        }
    } else {
        const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
        for (const int node : model.scenes[scene].nodes) {
            open.push_back(static_cast<std::size_t>(node));
        }
    }
    std::reverse(open.begin(), open.end());
    std::vector<std::size_t> shown;
    while (!open.empty()) {
        const std::size_t node = open.back();
        open.pop_back();
        shown.push_back(node);
        const std::vector<int>& children = model.nodes[node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            open.push_back(static_cast<std::size_t>(*child));
        }
    }
    return shown;
}

void addCamerasAndLights(const GltfDocument& document, const std::vector<glm::dmat4>& world,
                         const std::vector<std::size_t>& shown, Rig& rig, Scene& scene) {
    const glm::dvec3 center = boundingSphere(scene).center;
    for (const std::size_t index : shown) {
        const tinygltf::Node& node = document.model.nodes[index];
        const auto light = node.extensions.find("KHR_lights_punctual");
        const bool hasLight = light != node.extensions.end();
        if ((node.camera >= 0 || hasLight) && !isFinite(world[index][3])) {
            scene.warnings.push_back(fmt::format("{}, node {}: its camera or light is beyond all "
                                                 "numbers, and ignored",
                                                 quoted(document.file), index));
            continue;
        }
        if (node.camera >= 0) {
            rig.cameraNodes.push_back(static_cast<int>(index));
            scene.cameras.push_back(
                makeCamera(document.model.cameras[static_cast<std::size_t>(node.camera)],
                           world[index], center));
        }
        if (hasLight) {
            rig.lightNodes.push_back(static_cast<int>(index));
            const auto number =
                static_cast<std::size_t>(light->second.Get("light").GetNumberAsInt());
            scene.lights.push_back(makeLight(document.model.lights[number], world[index]));
        }
    }
}

} // namespace celadon::loaders
