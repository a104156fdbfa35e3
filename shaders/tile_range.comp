// Least and greatest view depth of the scattering surface in tiles of 8 x 8 pixels and, level by level,
// of 2 x 2 of those: a splat whose sphere no tile's range meets reaches no pixel.
#include "include/picture_group.glsl"

layout(location = 0) uniform int childLevel; // -1: from the pixels

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D surfaces;
layout(binding = 2) uniform sampler2D ranges;

layout(rg32f, binding = 0) uniform writeonly image2D result;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, imageSize(result)))) {
        return;
    }
    vec2 range = vec2(1e30, -1e30);
    if (childLevel < 0) {
        ivec2 size = textureSize(positions, 0);
        for (int i = 0; i < 64; ++i) {
            ivec2 pixel = tile * 8 + ivec2(i & 7, i >> 3);
            if (all(lessThan(pixel, size))) {
                float depth = texelFetch(positions, pixel, 0).w;
                if (depth > 0.0 && texelFetch(surfaces, pixel, 0).z >= 0.0) {
                    range = vec2(min(range.x, depth), max(range.y, depth));
                }
            }
        }
    } else {
        for (int i = 0; i < 4; ++i) {
            vec2 child = texelFetch(ranges, tile * 2 + ivec2(i & 1, i >> 1), childLevel).xy;
            range = vec2(min(range.x, child.x), max(range.y, child.y));
        }
    }
    imageStore(result, tile, vec4(range, 0.0, 0.0));
}
