#include "renderer/splatting/light_view.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

/// A frustum grows by so much, so that the sphere's rim stays inside the outermost texel centers.
constexpr double kMargin = 1.0005;

/// Closer than so many radii a point light gets cube faces: the single frustum would be wider than
/// about 106 degrees, and its outer texels stretched by more than three.
constexpr double kNearestSingleFrustum = 1.25;

glm::dvec3 anyPerpendicular(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(axis, other));
}

/// Reversed depth: 1 at `nearPlane`, 0 at infinity.
glm::dmat4 infinitePerspective(double tanHalf, double nearPlane) {
    glm::dmat4 m(0.0);
    m[0][0] = 1.0 / tanHalf;
    m[1][1] = 1.0 / tanHalf;
    m[2][3] = -1.0;
    m[3][2] = nearPlane;
    return m;
}

glm::dmat4 orthographic(double halfWidth, double nearPlane, double farPlane) {
    glm::dmat4 m(1.0);
    m[0][0] = 1.0 / halfWidth;
    m[1][1] = 1.0 / halfWidth;
    m[2][2] = 1.0 / (farPlane - nearPlane);
    m[3][2] = farPlane / (farPlane - nearPlane);
    return m;
}

LightView describe(const Light& light, int size, const glm::dmat4& view,
                   const glm::dmat4& projection, double widthScale, double widthOffset) {
    LightView result;
    result.size = size;
    result.block.view = glm::mat4(view);
    result.block.viewProjection = glm::mat4(projection * view);
    const bool directional = light.kind == Light::Kind::Directional;
    result.block.position = glm::vec4(directional ? glm::vec3(0.0f) : glm::vec3(light.position),
                                      directional ? 0.0 : 1.0);
    result.block.direction = glm::vec4(glm::vec3(light.direction), float(size));
    result.block.color =
        glm::vec4(glm::vec3(light.color), light.kind == Light::Kind::Spot ? 1.0f : 0.0f);
    result.block.cone =
        glm::vec4(float(std::cos(light.innerConeRadians)), float(std::cos(light.outerConeRadians)),
                  float(widthScale), float(widthOffset));
    return result;
}

LightView perspectiveView(const Light& light, const glm::dvec3& axis, const glm::dvec3& up,
                          double tanHalf, double nearPlane, int size) {
    const glm::dmat4 view = glm::lookAt(light.position, light.position + axis, up);
    return describe(light, size, view, infinitePerspective(tanHalf, nearPlane),
                    2.0 * tanHalf / size, 0.0);
}

LightView directionalView(const Light& light, const BoundingSphere& target,
                          const BoundingSphere& casters, int size) {
    const double halfWidth = std::max(target.radius, 1e-9) * kMargin;
    // The eye stands before every caster, so that depths are positive and 0 can mean background.
    const double reach =
        glm::length(casters.center - target.center) + casters.radius + target.radius;
    const double distance = 1.01 * reach + halfWidth;
    const glm::dvec3 eye = target.center - light.direction * distance;
    const glm::dmat4 view = glm::lookAt(eye, target.center, anyPerpendicular(light.direction));
    return describe(light, size, view, orthographic(halfWidth, 0.0, 2.0 * distance), 0.0,
                    2.0 * halfWidth / size);
}

} // namespace

std::vector<LightView> makeLightViews(const Light& light, const BoundingSphere& target,
                                      const BoundingSphere& casters, int size) {
    if (light.kind == Light::Kind::Directional) {
        return {directionalView(light, target, casters, size)};
    }
    const glm::dvec3 offset = target.center - light.position;
    const double distance = glm::length(offset);
    const double radius = target.radius * kMargin;
    const double nearPlane = 1e-4 * std::max(target.radius, distance);
    const bool outside = distance > kNearestSingleFrustum * radius;
    const double sphereTan =
        outside ? radius / std::sqrt(distance * distance - radius * radius) : 1e30;
    const double coneTan = light.kind == Light::Kind::Spot && light.outerConeRadians < 1.0
                               ? std::tan(light.outerConeRadians) * kMargin
                               : 1e30;
    if (coneTan < sphereTan) {
        return {perspectiveView(light, light.direction, anyPerpendicular(light.direction), coneTan,
                                nearPlane, size)};
    }
    if (outside) {
        const glm::dvec3 axis = offset / distance;
        return {perspectiveView(light, axis, anyPerpendicular(axis), sphereTan, nearPlane, size)};
    }
    std::vector<LightView> faces;
    for (int face = 0; face < 6; ++face) {
        glm::dvec3 axis(0.0);
        axis[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
        glm::dvec3 up(0.0);
        up[(face / 2 + 1) % 3] = 1.0;
        faces.push_back(perspectiveView(light, axis, up, 1.0, nearPlane, size));
    }
    return faces;
}

} // namespace celadon
