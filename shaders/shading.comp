// Outgoing radiance of each visible pixel: L = F_t(w_o) / (pi c) B (Chen et al. 2012, eq. 7; c as
// DESIGN 1 has it), plus what direct_light.frag found and what the surface emits.
#include "include/frame.glsl"
#include "include/fresnel.glsl"
#include "include/material.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform float leastCosine; // of normal and view

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D exitances;
layout(binding = 4) uniform sampler2D direct;
layout(binding = 5) uniform sampler2D emissions;

layout(rgba32f, binding = 0) uniform writeonly image2D radiance;

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) {
        return;
    }
    vec4 position = texelFetch(positions, pixel, 0);
    vec4 result = vec4(0.0);
    if (position.w > 0.0) {
        result = vec4(texelFetch(direct, pixel, 0).rgb + texelFetch(emissions, pixel, 0).rgb, 1.0);
        int m = int(texelFetch(surfaces, pixel, 0).z);
        if (m >= 0) {
            float cosine = dot(texelFetch(normals, pixel, 0).xyz, directionToEye(position.xyz));
            float transmitted = fresnelTransmittance(max(cosine, leastCosine), materials[m].profile.z);
            result.rgb += transmitted * materials[m].profile.w / 3.14159265 * texelFetch(exitances, pixel, 0).rgb;
        }
    }
    imageStore(radiance, pixel, result);
}
