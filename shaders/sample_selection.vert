// Adaptive selection (Chen et al. 2012, eqs. 10 and 11, Algorithm 1): a vertex a node of one level of the
// irradiance buffer. The printed test is inverted and looks one level up only; here a node is
// selected when it is fit, or at level 0, and no ancestor of it is selected (DESIGN 3.2). An
// ancestor is selected somewhere along the chain exactly when some ancestor is fit.
//
// HIERARCHICAL: a node is used where its parent is too close to stand for it; see raster_splat.
#include "include/blocks.glsl"

layout(std140, binding = 1) uniform LightUniforms { LightBlock light; };
layout(std140, binding = 3) uniform SolveUniforms { SolveBlock solve; };

layout(location = 0) uniform ivec2 levelAndWidth; // level, texels in a row of it

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D fluxes;
layout(binding = 3) uniform sampler2D extents;
layout(binding = 4) uniform sampler2D ranges;
layout(binding = 5) uniform sampler2D kepts;

flat out int selectedNode; // -1: not selected

bool isLit(ivec2 node, int level) {
    vec3 flux = texelFetch(fluxes, node, level).rgb;
    return flux.r + flux.g + flux.b > 0.0;
}

// Eq. 10: no depth discontinuity inside, and finer than the material asks for (T_k > M, eq. 11, both
// divided by R_w: the width of the texel is less than R_P |n . l| / alpha).
bool isFit(ivec2 node, int level) {
    vec2 range = texelFetch(ranges, node, level).xy;
    if (!(range.y - range.x < solve.selection.y)) {
        return false;
    }
    float cosine = abs(texelFetch(normals, node, level).w);
    float radius = texelFetch(extents, node, level).z;
    float width = (texelFetch(positions, node, level).w * light.cone.z + light.cone.w) * float(1 << level);
    return width * solve.selection.x < radius * cosine;
}

void main() {
    int level = levelAndWidth.x;
    int levels = int(solve.rings.y);
    ivec2 node = ivec2(gl_VertexID % levelAndWidth.y, gl_VertexID / levelAndWidth.y);
    selectedNode = -1;
    gl_Position = vec4(0.0);
    if (!isLit(node, level)) {
        return;
    }
    bool adaptive = solve.energy.y > 0.5;
    bool selected = level == 0 || (adaptive && isFit(node, level));
    for (int k = level + 1; selected && adaptive && k < levels; ++k) {
        selected = !isFit(node >> (k - level), k);
    }
    if (selected) {
        selectedNode = gl_VertexID;
    }
}
