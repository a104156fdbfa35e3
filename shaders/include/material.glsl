#include "include/blocks.glsl"

// The scene's SubEdit materials. Binding units 8.. hold, per material m: ln P as a 3D texture (u, v,
// knot), linear in all three; radii (R_P of energy 0.95, R_cut, shortest channel's R_P, 0) and the
// fraction of energy inside R_cut per channel as 2D textures; ln of the far energy (see accumulation).
#ifndef MATERIAL_COUNT
#define MATERIAL_COUNT 1
#endif

layout(std140, binding = 2) uniform MaterialUniforms { MaterialEntry materials[MATERIAL_COUNT]; };

layout(binding = 8) uniform sampler3D logProfiles[MATERIAL_COUNT];
layout(binding = 12) uniform sampler2D radiusMaps[MATERIAL_COUNT];
layout(binding = 16) uniform sampler2D keptMaps[MATERIAL_COUNT];
layout(binding = 20) uniform sampler3D farEnergies[MATERIAL_COUNT];

// Texture coordinate of distance r along the knots of material m; knots lie at texel centers.
float knotCoordinate(int m, float r) {
    float n = materials[m].profile.y;
    return (min(r / materials[m].profile.x, 1.0) * n + 0.5) / (n + 1.0);
}

// Indexing an array of samplers must be dynamically uniform: hence a chain, one link a material.
#if MATERIAL_COUNT == 1
#define PER_MATERIAL(m, texture3, coordinate) textureLod(texture3[0], coordinate, 0.0)
#elif MATERIAL_COUNT == 2
#define PER_MATERIAL(m, t, c) (m == 0 ? textureLod(t[0], c, 0.0) : textureLod(t[1], c, 0.0))
#elif MATERIAL_COUNT == 3
#define PER_MATERIAL(m, t, c)                                                                      \
    (m == 0 ? textureLod(t[0], c, 0.0)                                                             \
            : (m == 1 ? textureLod(t[1], c, 0.0) : textureLod(t[2], c, 0.0)))
#else
#define PER_MATERIAL(m, t, c)                                                                      \
    (m == 0   ? textureLod(t[0], c, 0.0)                                                           \
     : m == 1 ? textureLod(t[1], c, 0.0)                                                           \
     : m == 2 ? textureLod(t[2], c, 0.0)                                                           \
              : textureLod(t[3], c, 0.0))
#endif

// ln P at distance r (at most r_s), per channel; P in 1/mm^2.
vec3 logProfile(int m, vec2 uv, float r) {
    return PER_MATERIAL(m, logProfiles, vec3(uv, knotCoordinate(m, r))).rgb;
}

// R_P (energy 0.95, longest channel), R_cut, R_P of the shortest channel; mm.
vec3 materialRadii(int m, vec2 uv) { return PER_MATERIAL(m, radiusMaps, uv).rgb; }

// Fraction of each channel's energy inside R_cut.
vec3 keptEnergy(int m, vec2 uv) { return PER_MATERIAL(m, keptMaps, uv).rgb; }

// ln of the integral of sqrt(P_x Pbar) r dr over [r, r_s], per channel.
vec3 logFarEnergy(int m, vec2 uv, float r) {
    return PER_MATERIAL(m, farEnergies, vec3(uv, knotCoordinate(m, r))).rgb;
}
