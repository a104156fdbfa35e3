#pragma once

#include "subedit/exchange/subsurface_parameters.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

/// SubEdit materials as the parameters of other programs, as JSON. Pure functions: no files.
namespace celadon::app {

enum class Convention {
    OpenPbr,    ///< OpenPBR 1.x: subsurface_color, subsurface_radius, subsurface_radius_scale, ...
    Principled, ///< Blender's Principled shader: base_color, subsurface_radius, subsurface_scale,
                ///< ...
    Gltf        ///< glTF 2.0 with ratified KHR extensions, and extras.subedit
};

/// Parameters of an OpenPBR or Principled material.
/// @param name   for messages: the file
/// @param unitMm millimeters that the radius counts in: 1000 for meters
/// @param notes  what was left out or assumed, a line each, is appended
/// @throws InputError naming the field and the reason
[[nodiscard]] subedit::SubsurfaceParameters parametersFromJson(const nlohmann::json& json,
                                                               const std::string& name,
                                                               Convention convention, double unitMm,
                                                               std::vector<std::string>& notes);

/// The nearest parameters, with an array "lost" of what they cannot say.
[[nodiscard]] nlohmann::json parametersToJson(const subedit::NearestParameters& nearest,
                                              Convention convention, double unitMm);

/// A glTF material for viewers without SubEdit: base color, roughness, KHR_materials_ior,
/// KHR_materials_volume, KHR_materials_diffuse_transmission, and `extras.subedit`.
/// @param reference path of the material file, relative to the glTF
[[nodiscard]] nlohmann::json gltfMaterial(const subedit::NearestParameters& nearest,
                                          const std::string& name, const std::string& reference);

/// What a standard material cannot say of this one, a line each.
[[nodiscard]] std::vector<std::string> whatIsLost(const subedit::NearestParameters& nearest,
                                                  Convention convention);

} // namespace celadon::app
