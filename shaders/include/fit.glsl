// Whether a node of the irradiance buffer may stand for its texels in the paper's scheme (Chen et al.
// 2012, eqs. 10 and 11).
#include "include/bounds.glsl"
#include "include/light.glsl"
#include "include/solve.glsl"

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D fluxes;
layout(binding = 3) uniform sampler2D extents;
layout(binding = 4) uniform sampler2D ranges;

bool isLit(ivec2 node, int level) {
    vec3 flux = texelFetch(fluxes, node, level).rgb;
    return flux.r + flux.g + flux.b > 0.0;
}

// Eq. 10: no depth discontinuity inside, and finer than the material asks for (T_k > M, eq. 11, both
// divided by R_w: the width of the texel is less than R_P |n . l| / alpha).
bool isFit(ivec2 node, int level) {
    vec2 range = texelFetch(ranges, node, level).xy;
    if (!(range.y - range.x < solve.selection.y * bounds.scattering.w)) {
        return false;
    }
    float cosine = solve.selection.w > 0.0 ? abs(texelFetch(normals, node, level).w) : 1.0;
    float radius = texelFetch(extents, node, level).z;
    float width = texelWidthMm(texelFetch(positions, node, level).w) * float(1 << level);
    return width * solve.selection.x < radius * cosine;
}
