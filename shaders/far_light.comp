// For accumulation.comp: what a level of the splatting buffer hands to the next finer one. Its exitance comes from beyond
// its ring's start and depends on the pixel's own material through sqrt(P_xo) alone; over that material's far energy,
// it is light that changes slowly.
// The cpu backend has the same in renderer/gather/level_accumulation.cpp.
#include "include/far_ring.glsl"
#include "include/material.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform int level;

layout(binding = 0) uniform sampler2D surfaces;
layout(binding = 1) uniform sampler2D exitances;

layout(rgba32f, binding = 0) uniform writeonly image2D farLight; // light, R_P in mm; undefined where nothing scatters

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(farLight)))) {
        return;
    }
    vec4 s = texelFetch(surfaces, pixel, level);
    if (s.z >= 0.0) {
        // A ten-thousandth of all the material's energy at least: less than that is nothing that a neighbor of another
        // range could be told by.
        vec3 energy = max(logFarEnergy(int(s.z), s.xy, farRingStart(level)), logFarEnergy(int(s.z), s.xy, 0.0) - 9.0);
        imageStore(farLight, pixel, vec4(texelFetch(exitances, pixel, level).rgb * exp(-energy), s.w));
    }
}
