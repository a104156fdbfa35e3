#include "app/material/exchange_json.h"

#include "subedit/errors.h"
#include "subedit/medium.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace celadon::app {

using namespace subedit;
using nlohmann::json;

namespace {

/// The names that a convention has for what SubsurfaceParameters holds, and what it takes where a
/// file says nothing.
struct FieldNames {
    const char* color;
    const char* radius;
    const char* scale;
    const char* anisotropy;
    const char* eta;
    const char* roughness;
    const char* weight;
    glm::dvec3 defaultScale;
    double defaultEta;

    [[nodiscard]] bool knows(std::string_view field) const {
        return std::ranges::count(std::array<std::string_view, 7>{color, radius, scale, anisotropy,
                                                                  eta, roughness, weight},
                                  field) != 0;
    }
};

const FieldNames kOpenPbr{"subsurface_color",
                          "subsurface_radius",
                          "subsurface_radius_scale",
                          "subsurface_scatter_anisotropy",
                          "specular_ior",
                          "specular_roughness",
                          "subsurface_weight",
                          {1.0, 0.5, 0.25},
                          1.5};
const FieldNames kPrincipled{
    "base_color", "subsurface_radius", "subsurface_scale", "subsurface_anisotropy",   "ior",
    "roughness",  "subsurface_weight", glm::dvec3(1.0),    SubsurfaceParameters().eta};

/// Checked reading of one object's fields; messages name the file.
class FieldReader {
public:
    FieldReader(const json& object, const std::string& name) : mObject(object), mName(name) {
        if (!object.is_object()) {
            throw InputError(fmt::format("'{}'", name), "is no JSON object of parameters");
        }
    }

    [[nodiscard]] bool has(const char* field) const { return mObject.contains(field); }

    [[nodiscard]] double number(const char* field, double low, double high) const {
        return toNumber(find(field), field, low, high);
    }

    /// Three numbers, or one for all.
    [[nodiscard]] glm::dvec3 rgb(const char* field, double low, double high) const {
        const json& value = find(field);
        if (value.is_number()) {
            return glm::dvec3(toNumber(value, field, low, high));
        }
        if (!value.is_array() || value.size() < 3 || value.size() > 4) {
            refuse(field, "is not three numbers");
        }
        return {toNumber(value[0], field, low, high), toNumber(value[1], field, low, high),
                toNumber(value[2], field, low, high)};
    }

    [[noreturn]] void refuse(const char* field, const std::string& reason) const {
        throw InputError(fmt::format("'{}', field '{}'", mName, field), reason);
    }

private:
    [[nodiscard]] const json& find(const char* field) const {
        if (!has(field)) {
            refuse(field, "is missing");
        }
        return mObject[field];
    }
    [[nodiscard]] double toNumber(const json& value, const char* field, double low,
                                  double high) const {
        if (!value.is_number()) {
            refuse(field, "is not a number");
        }
        const double number = value.get<double>();
        if (!(number >= low && number <= high)) {
            refuse(field, fmt::format("is {}, not in [{}, {}]", number, low, high));
        }
        return number;
    }

    const json& mObject;
    const std::string& mName;
};

json toJson(const glm::dvec3& v) {
    const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6; };
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

} // namespace

SubsurfaceParameters parametersFromJson(const json& parameters, const std::string& name,
                                        Convention convention, double unitMm,
                                        std::vector<std::string>& notes) {
    const FieldNames& names = convention == Convention::OpenPbr ? kOpenPbr : kPrincipled;
    const FieldReader fields(parameters, name);
    SubsurfaceParameters p;
    p.albedo = fields.rgb(names.color, 0.0, 1.0);
    glm::dvec3 radius = fields.rgb(names.radius, 0.0, 1e9);
    if (fields.has(names.scale)) {
        radius *= fields.rgb(names.scale, 0.0, 1e9);
    } else {
        // Three radii are those of the channels already.
        const glm::dvec3 scale =
            parameters[names.radius].is_number() ? names.defaultScale : glm::dvec3(1.0);
        radius *= scale;
        notes.push_back(scale == glm::dvec3(1.0)
                            ? fmt::format("no {}: taken as 1", names.scale)
                            : fmt::format("no {}: taken as {}, {}, {}", names.scale, scale.x,
                                          scale.y, scale.z));
    }
    p.meanFreePathMm = radius * unitMm;
    for (int channel = 0; channel < 3; ++channel) {
        const double length = p.meanFreePathMm[channel];
        if (!(length >= 1e-6 && length <= 1e6)) {
            fields.refuse(names.radius, fmt::format("{} is {} mm, not in [1e-6, 1e6]",
                                                    channelName(channel), length));
        }
    }
    if (fields.has(names.anisotropy)) {
        p.anisotropy = fields.number(names.anisotropy, -0.99, 0.99);
    }
    p.eta = fields.has(names.eta) ? fields.number(names.eta, 0.5, 4.0) : names.defaultEta;
    if (fields.has(names.roughness)) {
        p.roughness = fields.number(names.roughness, 0.0, 1.0);
    }
    if (fields.has(names.weight) && fields.number(names.weight, 0.0, 1.0) < 1.0) {
        notes.push_back(fmt::format("{} is below 1: the diffuse rest is left out", names.weight));
    }
    for (const auto& [field, value] : parameters.items()) {
        if (field.starts_with("subsurface_") && !names.knows(field)) {
            notes.push_back(fmt::format("'{}' is not known, and left out", field));
        }
    }
    return p;
}

json parametersToJson(const NearestParameters& nearest, Convention convention, double unitMm) {
    const FieldNames& names = convention == Convention::OpenPbr ? kOpenPbr : kPrincipled;
    const SubsurfaceParameters& p = nearest.parameters;
    const glm::dvec3 length = p.meanFreePathMm / unitMm;
    const double longest = std::max({length.x, length.y, length.z});
    json out;
    out[names.color] = toJson(p.albedo);
    out[names.weight] = 1.0;
    out[names.anisotropy] = 0.0;
    out[names.eta] = p.eta;
    out[names.roughness] = std::round(p.roughness * 1e6) / 1e6;
    // One has a number times a color, the other a color times a number; the color's largest is 1.
    if (convention == Convention::OpenPbr) {
        out[names.radius] = longest;
        out[names.scale] = toJson(length / longest);
    } else {
        out[names.radius] = toJson(length / longest);
        out[names.scale] = longest;
    }
    out["convention"] = fmt::format(
        "{}; color is the surface albedo, radius times scale the mean free path 1/sigma_t in units "
        "of {} mm",
        convention == Convention::OpenPbr ? "OpenPBR" : "Principled", unitMm);
    out["lost"] = whatIsLost(nearest, convention);
    return out;
}

json gltfMaterial(const NearestParameters& nearest, const std::string& name,
                  const std::string& reference) {
    const SubsurfaceParameters& p = nearest.parameters;
    // Attenuation per attenuationDistance (meters), as e^(-sigma_a d): d where the mean of the
    // channels falls to 1/e.
    const glm::dvec3 absorption = absorptionOf(p);
    const double mean = std::max((absorption.x + absorption.y + absorption.z) / 3.0, 1e-6);
    const glm::dvec3 attenuation(std::exp(-absorption.x / mean), std::exp(-absorption.y / mean),
                                 std::exp(-absorption.z / mean));
    const double longest = std::max({p.meanFreePathMm.x, p.meanFreePathMm.y, p.meanFreePathMm.z});
    json material;
    material["name"] = name;
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor", {p.albedo.x, p.albedo.y, p.albedo.z, 1.0}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", p.roughness}};
    material["extensions"] = {{"KHR_materials_ior", {{"ior", p.eta}}},
                              {"KHR_materials_diffuse_transmission",
                               {{"diffuseTransmissionFactor", 0.5},
                                {"diffuseTransmissionColorFactor", toJson(p.albedo)}}},
                              {"KHR_materials_volume",
                               {{"thicknessFactor", longest * 1e-3},
                                {"attenuationDistance", 1e-3 / mean},
                                {"attenuationColor", toJson(attenuation)}}}};
    material["extras"] = {{"subedit", reference}};
    return material;
}

std::vector<std::string> whatIsLost(const NearestParameters& nearest, Convention convention) {
    std::vector<std::string> lost;
    if (nearest.varies) {
        lost.push_back(
            fmt::format("variation over the surface: albedo by {:.2f}, R_P by a factor of "
                        "{:.2f}; means are given",
                        nearest.albedoSpread, nearest.radiusSpread));
    }
    if (nearest.shapeError > 0.01) {
        lost.push_back(fmt::format("the shape of the profile: up to {:.1f} % of its energy lies at "
                                   "other radii in normalized diffusion",
                                   100.0 * nearest.shapeError));
    }
    if (convention == Convention::Gltf) {
        lost.emplace_back("where scattered light leaves: diffuse transmission and volume only tint "
                          "and let through, no viewer scatters by them");
    }
    return lost;
}

} // namespace celadon::app
