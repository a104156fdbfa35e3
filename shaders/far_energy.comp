// For accumulation.comp: ln of the far energy of each texel of a level of the splatting buffer.
#include "include/far_ring.glsl"
#include "include/material.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform int level;

layout(binding = 0) uniform sampler2D surfaces;

layout(rgba32f, binding = 0) uniform writeonly image2D result;

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) {
        return;
    }
    vec4 s = texelFetch(surfaces, pixel, level);
    imageStore(result, pixel, vec4(s.z >= 0.0 ? logFarEnergy(int(s.z), s.xy, farRingStart(level)) : vec3(0.0), 0.0));
}
