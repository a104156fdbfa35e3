#include "include/blocks.glsl"

layout(std140, binding = 1) uniform LightUniforms { LightBlock light; };

// Unit direction from a surface point towards the light.
vec3 directionToLight(vec3 position) {
    return light.position.w > 0.5 ? normalize(light.position.xyz - position) : -light.direction.xyz;
}

// KHR_lights_punctual: smooth between the outer and the inner cone; 1 where the light is no spot.
float spotFactor(vec3 toLight) {
    if (light.color.w < 0.5) {
        return 1.0;
    }
    float cosAngle = dot(light.direction.xyz, -toLight);
    float t = clamp((cosAngle - light.cone.y) / max(light.cone.x - light.cone.y, 1e-6), 0.0, 1.0);
    return t * t;
}

// Width in mm of a texel of level 0 at depth z of the light's view.
float texelWidthMm(float depth) { return depth * light.cone.z + light.cone.w; }

// Irradiance in W/m^2 on a plane that faces the light.
vec3 facingIrradiance(vec3 position) {
    if (light.position.w < 0.5) {
        return light.color.rgb;
    }
    vec3 offset = (light.position.xyz - position) * 1e-3; // m
    return light.color.rgb * spotFactor(normalize(offset)) / max(dot(offset, offset), 1e-12);
}
