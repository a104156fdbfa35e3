#include "renderer/scene/describe_scene.h"

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/rig.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace celadon {

namespace {

constexpr double kPi = 3.14159265358979323846;

std::string vectorText(const glm::dvec3& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

std::string nameText(const std::string& name) {
    return name.empty() ? "" : fmt::format(" '{}'", name);
}

std::string pictureText(const Scene& scene, const TextureReference& texture) {
    const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    return fmt::format("picture {}{}", texture.image, nameText(image.name));
}

std::string boundsText(const Scene& scene) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const Mesh& mesh : scene.meshes) {
        for (const std::uint32_t index : mesh.indices) {
            low = glm::min(low, glm::dvec3(mesh.positions[index]));
            high = glm::max(high, glm::dvec3(mesh.positions[index]));
        }
    }
    return vectorText(low) + " to " + vectorText(high);
}

std::string surfaceText(const Mesh& mesh) {
    std::string text = mesh.uvs.empty()    ? "no texture coordinates"
                       : mesh.uvs1.empty() ? "texture coordinates"
                                           : "two sets of texture coordinates";
    return text + (mesh.colors.empty() ? "" : ", vertex colors");
}

std::string materialText(const Scene& scene, const SurfaceMaterial& material) {
    std::string text =
        fmt::format("base color ({:.3g}, {:.3g}, {:.3g}), roughness {:.3g}, metallic {:.3g}",
                    material.baseColor.x, material.baseColor.y, material.baseColor.z,
                    material.roughness, material.metallic);
    if (material.ior) {
        text += fmt::format(", ior {:.4g}", *material.ior);
    }
    if (material.doubleSided) {
        text += ", double sided";
    }
    if (material.alphaCutoff) {
        text += fmt::format(", cut out where alpha is below {:.3g}", *material.alphaCutoff);
    }
    if (material.baseColorTexture.isSet()) {
        text += ", base color from " + pictureText(scene, material.baseColorTexture);
    }
    if (material.metallicRoughnessTexture.isSet()) {
        text += ", roughness from " + pictureText(scene, material.metallicRoughnessTexture);
    }
    if (material.normalTexture.isSet()) {
        text += ", normals from " + pictureText(scene, material.normalTexture);
    }
    if (material.emission != glm::vec3(0.0f)) {
        text += fmt::format(", emits ({:.3g}, {:.3g}, {:.3g}) W/m^2/sr", material.emission.x,
                            material.emission.y, material.emission.z);
    }
    if (material.emissiveTexture.isSet()) {
        text += " times " + pictureText(scene, material.emissiveTexture);
    }
    if (material.subedit) {
        text += fmt::format(", SubEdit material '{}'", material.subedit->string());
    }
    return text;
}

std::string lightText(const Light& light) {
    const std::string color = vectorText(light.color);
    switch (light.kind) {
    case Light::Kind::Directional:
        return fmt::format("directional, travels along {}, {} W/m^2", vectorText(light.direction),
                           color);
    case Light::Kind::Point:
        return fmt::format("point at {}, {} W/sr", vectorText(light.position), color);
    case Light::Kind::Spot:
        return fmt::format("spot at {}, travels along {}, cones {:.4g} and {:.4g} degrees, {} W/sr",
                           vectorText(light.position), vectorText(light.direction),
                           light.innerConeRadians * 180.0 / kPi,
                           light.outerConeRadians * 180.0 / kPi, color);
    }
    return {};
}

std::string cameraText(const Camera& camera) {
    const std::string lens =
        camera.orthographicHeight
            ? fmt::format("orthographic, {:.6g} units high", *camera.orthographicHeight)
            : fmt::format("perspective, {:.4g} degrees high", camera.fovYDegrees);
    return fmt::format("{}, from {} at {}", lens, vectorText(camera.eye), vectorText(camera.at));
}

} // namespace

std::vector<std::string> describeScene(const Scene& scene) {
    std::vector<std::string> lines;
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    for (const Mesh& mesh : scene.meshes) {
        triangles += mesh.triangleCount();
        vertices += mesh.positions.size();
    }
    const BoundingSphere sphere = boundingSphere(scene);
    lines.push_back(fmt::format("name: {}", scene.name));
    lines.push_back(fmt::format("meshes: {}", scene.meshes.size()));
    lines.push_back(fmt::format("triangles: {}", triangles));
    lines.push_back(fmt::format("vertices: {}", vertices));
    if (!scene.meshes.empty()) {
        lines.push_back(fmt::format("bounds: {}", boundsText(scene)));
    }
    lines.push_back(fmt::format("bounding sphere: center {}, diameter {:.6g}",
                                vectorText(sphere.center), 2.0 * sphere.radius));
    lines.push_back(scene.millimetersPerUnit
                        ? fmt::format("millimeters per unit: {:.6g}", *scene.millimetersPerUnit)
                        : std::string("millimeters per unit: not given by the file"));
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        lines.push_back(fmt::format("mesh {}{}: {} triangle{}, {} vertices, {}, material {}", i,
                                    nameText(mesh.name), mesh.triangleCount(),
                                    mesh.triangleCount() == 1 ? "" : "s", mesh.positions.size(),
                                    surfaceText(mesh), mesh.material));
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        lines.push_back(fmt::format("material {}{}: {}", i, nameText(scene.materials[i].name),
                                    materialText(scene, scene.materials[i])));
    }
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        lines.push_back(fmt::format("picture {}{}: {} x {}", i, nameText(scene.images[i].name),
                                    scene.images[i].width, scene.images[i].height));
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        lines.push_back(fmt::format("camera {}{}: {}", i, nameText(scene.cameras[i].name),
                                    cameraText(scene.cameras[i])));
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        lines.push_back(fmt::format("light {}: {}", i, lightText(scene.lights[i])));
    }
    for (std::size_t i = 0; scene.rig && i < scene.rig->animations.size(); ++i) {
        const Animation& animation = scene.rig->animations[i];
        lines.push_back(fmt::format("animation {}{}: {:.6g} s, {} channel{}", i,
                                    nameText(animation.name), animation.durationSeconds,
                                    animation.channels.size(),
                                    animation.channels.size() == 1 ? "" : "s"));
    }
    const DeformerStack none;
    const DeformerStack& stack = scene.rig && scene.rig->deformers ? *scene.rig->deformers : none;
    for (std::size_t i = 0; i < stack.size(); ++i) {
        const AnimatedDeformer& deformer = stack[i];
        const double last = deformer.lastSeconds();
        lines.push_back(fmt::format("deformer {}: {}{}{}", i, deformerName(deformer.kind),
                                    last > 0.0 ? fmt::format(", keys to {:.6g} s", last) : "",
                                    deformer.isOn ? "" : ", off"));
    }
    for (const std::string& warning : scene.warnings) {
        lines.push_back("warning: " + warning);
    }
    return lines;
}

} // namespace celadon
