// Minimum and maximum depth of each texel's footprint (Chen et al. 2012, after Nichols et al. 2009).
// Background counts as far away, so that silhouettes are never fit. Level 0 is derived from positions.
#include "include/picture_group.glsl"

layout(location = 0) uniform int childLevel; // -1: make level 0

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D ranges;
layout(rg32f, binding = 0) uniform writeonly image2D result;

const float kFarAway = 1e30;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(result)))) {
        return;
    }
    vec2 range = vec2(kFarAway, -kFarAway);
    if (childLevel < 0) {
        float depth = texelFetch(positions, texel, 0).w;
        range = vec2(depth > 0.0 ? depth : kFarAway);
    } else {
        for (int i = 0; i < 4; ++i) {
            vec2 child = texelFetch(ranges, texel * 2 + ivec2(i & 1, i >> 1), childLevel).xy;
            range = vec2(min(range.x, child.x), max(range.y, child.y));
        }
    }
    imageStore(result, texel, vec4(range, 0.0, 0.0));
}
