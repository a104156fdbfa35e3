// Bounds of what lies below each node of the irradiance buffer, for tiles that walk it from the top down
// (tile_gather.comp). The tree goes on above the buffer's last level until few roots are left. In the paper's
// scheme also whether the node is fit.
#include "include/fit.glsl"
#include "include/picture_group.glsl"

layout(location = 0) uniform ivec2 request; // level, levels of the irradiance buffer

layout(binding = 5) uniform sampler2D tree;

// Center in mm; farthest position of a lit texel from it, -1: none is lit.
layout(rgba32f, binding = 0) uniform writeonly image2D result;
#ifndef HIERARCHICAL
layout(r32f, binding = 1) uniform writeonly image2D fits; // 1: fit
#endif

void main() {
    ivec2 node = ivec2(gl_GlobalInvocationID.xy);
    int level = request.x;
    if (any(greaterThanEqual(node, imageSize(result)))) {
        return;
    }
    bool isInBuffer = level < request.y && all(lessThan(node, textureSize(positions, 0) >> level));
    bool lit = isInBuffer && isLit(node, level);
    vec4 bound = vec4(0.0, 0.0, 0.0, -1.0);
    if (lit) {
        bound = vec4(texelFetch(positions, node, level).xyz, 0.0);
    }
    vec4 children[4];
    vec3 low = vec3(1e30);
    vec3 high = vec3(-1e30);
    for (int i = 0; i < 4 && level > 0; ++i) {
        children[i] = texelFetch(tree, node * 2 + ivec2(i & 1, i >> 1), level - 1);
        if (children[i].w >= 0.0) {
            low = min(low, children[i].xyz);
            high = max(high, children[i].xyz);
        }
    }
    if (!lit && low.x <= high.x) { // above the buffer
        bound = vec4(0.5 * (low + high), 0.0);
    }
    for (int i = 0; i < 4 && level > 0; ++i) {
        if (children[i].w >= 0.0) {
            bound.w = max(bound.w, distance(children[i].xyz, bound.xyz) + children[i].w);
        }
    }
    imageStore(result, node, bound);
#ifndef HIERARCHICAL
    bool fit = lit && (level == 0 || (isAdaptive() && level < irradianceLevels() && isFit(node, level)));
    imageStore(fits, node, vec4(fit ? 1.0 : 0.0));
#endif
}
