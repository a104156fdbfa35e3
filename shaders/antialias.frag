// One jittered coverage sample: radiance of the nearest pixel of the same surface (its own four first,
// then a wider look), added up by blending. Alpha is coverage; the result is premultiplied.
#include "include/frame.glsl"

layout(location = 0) uniform vec3 jitterAndWeight; // jitter in pixels (x, y), 1 / samples

layout(binding = 0) uniform sampler2D positions; // pixel centers
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D radiance;
layout(binding = 3) uniform sampler2D samplePositions; // this jitter
layout(binding = 4) uniform sampler2D sampleNormals;

layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(samplePositions, pixel, 0);
    if (position.w <= 0.0) {
        discard;
    }
    vec4 normal = texelFetch(sampleNormals, pixel, 0);
    ivec2 size = ivec2(frame.frameSize.xy);
    float width = pixelWidthMm(position.w);
    // The sample lies at pixel center + jitter; bilinear among centers, weighted by sameness.
    vec4 sum = vec4(0.0);
    ivec2 first = ivec2(floor(jitterAndWeight.xy));
    for (int reach = 1; reach <= 3 && sum.a <= 1e-12; ++reach) {
        ivec2 low = reach == 1 ? first : ivec2(-reach);
        ivec2 high = reach == 1 ? first + 1 : ivec2(reach);
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                ivec2 t = pixel + ivec2(x, y);
                if (any(lessThan(t, ivec2(0))) || any(greaterThanEqual(t, size))) {
                    continue;
                }
                vec4 p = texelFetch(positions, t, 0);
                vec4 n = texelFetch(normals, t, 0);
                if (p.w <= 0.0 || n.w != normal.w) {
                    continue;
                }
                vec2 d = abs(vec2(x, y) - jitterAndWeight.xy);
                float near = reach == 1 ? max(1.0 - d.x, 0.0) * max(1.0 - d.y, 0.0) : 1.0;
                vec3 offset = p.xyz - position.xyz;
                float plane = max(abs(dot(offset, normal.xyz)), abs(dot(offset, n.xyz))) / width;
                float w = near * exp(-4.0 * plane) * exp(-0.5 * dot(offset, offset) / (width * width * 4.0 * float(reach * reach)))
                          * max(dot(normal.xyz, n.xyz), 0.0) + (reach > 1 ? 1e-9 : 0.0);
                sum += w * vec4(texelFetch(radiance, t, 0).rgb, 1.0);
            }
        }
    }
    if (sum.a <= 0.0) {
        // A sliver that no pixel center sees: the pixel's own surface, whatever it is, or nothing.
        vec4 own = texelFetch(radiance, pixel, 0);
        if (own.a <= 0.0) {
            discard;
        }
        sum = own;
    }
    color = vec4(sum.rgb / sum.a, 1.0) * jitterAndWeight.z;
}
