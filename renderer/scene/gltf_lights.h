#pragma once

#include "renderer/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

/// Lights as a glTF holds them (KHR_lights_punctual): lux and candela stand for W/m^2 and W/sr
/// (DESIGN section 1).
namespace celadon::loaders {

struct NamedLight {
    std::string name;
    Light light; ///< positions in units of the file
};

/// Takes the place of all lights of a document: each gets a node in the scene that is shown, which
/// must be there.
void putLights(nlohmann::json& document, std::span<const NamedLight> lights);

} // namespace celadon::loaders
