#include "renderer/scene/light.h"

#include "renderer/scene/camera.h"
#include "renderer/scene/number_list.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace celadon {

namespace {

constexpr const char* kForms = "write directional:DX,DY,DZ[:R,G,B], point:X,Y,Z[:R,G,B] or "
                               "spot:X,Y,Z:DX,DY,DZ:INNER,OUTER[:R,G,B]";

/// One `--light` argument, cut at its colons.
class LightArgument {
public:
    explicit LightArgument(std::string_view text) : mText(text) {
        for (std::size_t start = 0;;) {
            const std::size_t colon = text.find(':', start);
            mFields.push_back(text.substr(start, colon - start));
            if (colon == std::string_view::npos) {
                break;
            }
            start = colon + 1;
        }
    }

    [[nodiscard]] std::string_view kind() const { return mFields.front(); }

    void expectFields(std::size_t withoutColor) const {
        if (mFields.size() != withoutColor && mFields.size() != withoutColor + 1) {
            fail(fmt::format("'{}' takes {} fields and perhaps a color, not {}", kind(),
                             withoutColor - 1, mFields.size() - 1));
        }
    }

    [[nodiscard]] std::vector<double> numbers(std::size_t field, std::size_t count,
                                              const char* what) const {
        std::optional<std::vector<double>> numbers = parseNumbers(mFields[field]);
        if (!numbers || numbers->size() != count) {
            fail(fmt::format("the {} '{}' is not {} finite numbers", what, mFields[field], count));
        }
        return *std::move(numbers);
    }

    [[nodiscard]] glm::dvec3 triple(std::size_t field, const char* what) const {
        const std::vector<double> xyz = numbers(field, 3, what);
        return {xyz[0], xyz[1], xyz[2]};
    }

    [[nodiscard]] glm::dvec3 direction(std::size_t field) const {
        const glm::dvec3 d = triple(field, "direction");
        // Divided by the largest component first: the square of 1e-200 is zero.
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        if (largest == 0.0) {
            fail("the direction is zero");
        }
        return glm::normalize(d / largest);
    }

    [[nodiscard]] glm::dvec3 color(std::size_t field) const {
        if (field >= mFields.size()) {
            return glm::dvec3(1.0);
        }
        const glm::dvec3 rgb = triple(field, "color");
        if (rgb.x < 0.0 || rgb.y < 0.0 || rgb.z < 0.0) {
            fail("the color is negative");
        }
        return rgb;
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw UsageError(fmt::format("--light '{}'", mText), reason, kForms);
    }

private:
    std::string_view mText;
    std::vector<std::string_view> mFields;
};

/// Whether hardly anything that scatters faces a light from there. As much of a closed surface, and
/// of one seen from both sides, faces a light as turns its back, whatever its shape: this is about
/// open surfaces alone, such as a plane seen from its front.
bool turnsItsBack(const World& world, const glm::dvec3& toLight) {
    constexpr double kHardly = 0.1;
    double facing = 0.0;
    double averted = 0.0;
    for (const WorldMesh& part : world.meshes) {
        const Mesh& mesh = part.mesh;
        const auto look = static_cast<std::size_t>(mesh.material);
        if (part.scattering < 0) {
            continue;
        }
        const bool isDoubleSided = look < world.looks.size() && world.looks[look].doubleSided;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
            const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
            const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
            const double area = glm::dot(glm::cross(b - a, c - a), toLight);
            facing += isDoubleSided ? std::abs(area) : std::max(area, 0.0);
            averted += isDoubleSided ? std::abs(area) : std::max(-area, 0.0);
        }
    }
    return facing < kHardly * averted;
}

} // namespace

const char* lightKindName(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::Directional:
        return "directional";
    case Light::Kind::Point:
        return "point";
    case Light::Kind::Spot:
        return "spot";
    }
    return "";
}

Light parseLight(std::string_view text) {
    const LightArgument argument(text);
    Light light;
    if (argument.kind() == "directional") {
        argument.expectFields(2);
        light.kind = Light::Kind::Directional;
        light.direction = argument.direction(1);
        light.color = argument.color(2);
    } else if (argument.kind() == "point") {
        argument.expectFields(2);
        light.kind = Light::Kind::Point;
        light.position = argument.triple(1, "position");
        light.color = argument.color(2);
    } else if (argument.kind() == "spot") {
        argument.expectFields(4);
        light.kind = Light::Kind::Spot;
        light.position = argument.triple(1, "position");
        light.direction = argument.direction(2);
        const std::vector<double> cones = argument.numbers(3, 2, "pair of half angles");
        if (cones[0] < 0.0 || cones[0] >= cones[1] || cones[1] > 90.0) {
            argument.fail(fmt::format("the half angles {} and {} are not 0 <= INNER < OUTER <= 90",
                                      cones[0], cones[1]));
        }
        light.innerConeRadians = glm::radians(cones[0]);
        light.outerConeRadians = glm::radians(cones[1]);
        light.color = argument.color(4);
    } else {
        argument.fail(fmt::format("'{}' is no kind of light", argument.kind()));
    }
    return light;
}

SpotFalloff spotFalloff(const Light& light) {
    if (light.kind != Light::Kind::Spot) {
        return {};
    }
    constexpr double kLeastWidth = 1e-7; // about the resolution of a float cosine near 1
    const double cosInner = std::cos(light.innerConeRadians);
    const double cosOuter = std::cos(light.outerConeRadians);
    const double scale = 1.0 / std::max(cosInner - cosOuter, kLeastWidth);
    return {scale, -cosOuter * scale};
}

double spotFactor(const Light& light, double cosAngle) {
    const SpotFalloff falloff = spotFalloff(light);
    const double ramp = std::clamp(falloff.scale * cosAngle + falloff.offset, 0.0, 1.0);
    return ramp * ramp;
}

Light defaultLight(const Camera& camera, const World& world) {
    // Where the light comes from, in the camera's frame (right, up, towards the viewer): 40 degrees
    // up, and 97 degrees away from the viewer, so just behind the plane of the picture.
    const glm::dvec3 source = glm::normalize(glm::dvec3(0.76, 0.63, -0.12));
    // White diffuse paper that faces it would leave with a radiance of 1.6 W/m^2/sr; what glows
    // through from behind then lies around 0.1 to 0.5, where the default exposure wants it.
    constexpr double kIrradiance = 5.0;
    const CameraFrame frame = cameraFrame(camera);
    Light light;
    light.kind = Light::Kind::Directional;
    light.direction = -(source.x * frame.right + source.y * frame.up - source.z * frame.forward);
    if (turnsItsBack(world, -light.direction)) {
        light.direction = frame.forward; // reaches whatever the camera sees
    }
    light.color = glm::dvec3(kIrradiance);
    return light;
}

} // namespace celadon
