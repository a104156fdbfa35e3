#include "include/blocks.glsl"

// The scene's SubEdit materials, any number of them, in one array texture (renderer/gpu_materials.h). Each
// has a rectangle of texels, with a border of one texel that repeats its other side, and these layers from its
// first one on: ln P at each of its knots; radii (R_P of energy 0.95, R_cut, shortest channel's R_P); the
// fraction of each channel's energy inside R_cut; roughness and weight of the specular lobe. A second array has ln of the far energy (see accumulation)
// at each knot, in the same places.
#ifndef MATERIAL_COUNT
#define MATERIAL_COUNT 1
#endif

layout(std140, binding = 2) uniform MaterialUniforms { MaterialEntry materials[MATERIAL_COUNT]; };

layout(binding = 8) uniform sampler2DArray materialTables;
layout(binding = 9) uniform sampler2DArray farEnergies;

// Texture coordinate, in the arrays, of a point of material m; uv repeats.
vec3 materialPlace(int m, vec2 uv, float layer) {
    return vec3(fract(uv) * materials[m].place.zw + materials[m].place.xy, materials[m].layers.x + layer);
}

// Value at distance r between the two knots about it: bilinear over the map, linear along the knots. Two
// fetches of a layer each, mixed in full precision: along r the profile falls too steeply for the eight
// bits of a filter's weight.
vec3 betweenKnots(sampler2DArray tables, int m, vec2 uv, float r) {
    float n = materials[m].profile.y;
    float x = min(r / materials[m].profile.x, 1.0) * n;
    float k = min(floor(x), n - 1.0);
    vec3 place = materialPlace(m, uv, k);
    vec3 a = textureLod(tables, place, 0.0).rgb;
    vec3 b = textureLod(tables, place + vec3(0.0, 0.0, 1.0), 0.0).rgb;
    return mix(a, b, x - k);
}

// ln P at distance r (at most r_s), per channel; P in 1/mm^2.
vec3 logProfile(int m, vec2 uv, float r) { return betweenKnots(materialTables, m, uv, r); }

// R_P (energy 0.95, longest channel), R_cut, R_P of the shortest channel; mm.
vec3 materialRadii(int m, vec2 uv) {
    return textureLod(materialTables, materialPlace(m, uv, materials[m].profile.y + 1.0), 0.0).rgb;
}

// Fraction of each channel's energy inside R_cut.
vec3 keptEnergy(int m, vec2 uv) {
    return textureLod(materialTables, materialPlace(m, uv, materials[m].profile.y + 2.0), 0.0).rgb;
}

// Roughness of the specular lobe and its weight, each -1 where the material has no map of it.
vec2 materialLobe(int m, vec2 uv) {
    return textureLod(materialTables, materialPlace(m, uv, materials[m].profile.y + 3.0), 0.0).rg;
}

// ln of the integral of sqrt(P_x Pbar) r dr over [r, r_s], per channel.
vec3 logFarEnergy(int m, vec2 uv, float r) { return betweenKnots(farEnergies, m, uv, r); }
