#pragma once

#include "renderer/scene/builtin.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/world.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Worlds, views and lights that tests of the renderer share.
namespace celadon::test {

/// The folder of real models that the environment variable CELADON_MODELS names; unset: none.
inline std::optional<std::filesystem::path> modelFolder() {
    const char* const folder = std::getenv("CELADON_MODELS");
    return folder != nullptr ? std::optional<std::filesystem::path>(folder) : std::nullopt;
}

inline bool isBuiltin(const std::string& model) {
    return model.starts_with("builtin:");
}

/// Whether the model is there: test cases of real models skip where it is not.
inline bool isAvailable(const std::string& model) {
    return isBuiltin(model) || modelFolder();
}

/// @param model "builtin:NAME", or a file below modelFolder()
/// Every mesh gets `material`; real models get a diameter of 100 mm, as builtins have. Each model
/// is read once a process: the automatic atlas of a real one takes seconds.
inline World makeWorld(const std::string& model, const MaterialPointer& material) {
    static std::map<std::string, World> worlds;
    auto found = worlds.find(model);
    if (found == worlds.end()) {
        Scene scene = isBuiltin(model) ? makeBuiltin(model.substr(std::string("builtin:").size()))
                                       : loadScene(*modelFolder() / model);
        const std::vector<MaterialPointer> named(scene.materials.size());
        WorldScale scale;
        if (!isBuiltin(model)) {
            scale.diameterMm = 100.0;
        }
        found = worlds.emplace(model, buildWorld(std::move(scene), material, named, nullptr, scale))
                    .first;
    }
    World world = found->second;
    world.materials = {material};
    return world;
}

/// The default three-quarter view.
inline Camera defaultCamera(const World& world, glm::ivec2 size) {
    return chooseCamera(world, {}, static_cast<double>(size.x) / size.y);
}

inline Light directionalLight(glm::dvec3 direction, glm::dvec3 color = glm::dvec3(1.0)) {
    Light light;
    light.direction = glm::normalize(direction);
    light.color = color;
    return light;
}

inline Light pointLight(glm::dvec3 positionMm, glm::dvec3 color = glm::dvec3(1e-2)) {
    Light light;
    light.kind = Light::Kind::Point;
    light.position = positionMm;
    light.color = color;
    return light;
}

/// From the front, above and to the left; no axis of any builtin.
inline Light frontLight(glm::dvec3 color = glm::dvec3(1.0)) {
    return directionalLight({0.35, -0.5, -0.9}, color);
}
inline Light backLight(glm::dvec3 color = glm::dvec3(1.0)) {
    return directionalLight({-0.5, -0.3, 0.8}, color);
}

} // namespace celadon::test
