// Antialiasing, second pass: of each sample of a pixel at a silhouette, the radiance of the pixel
// centers around that show the same surface.
#include "include/coverage.glsl"
#include "include/list_group.glsl"

vec3 positionAt(vec2 pixel, float depth) {
    vec2 ndc = pixel / frame.frameSize.xy * 2.0 - 1.0;
    vec2 across = ndc / frame.projection.xy * (frame.eye.w > 0.5 ? depth : 1.0);
    return transpose(mat3(frame.view)) * (vec3(across, -depth) - frame.view[3].xyz);
}

// rgb times weight, weight.
vec4 searchAround(ivec2 pixel, vec2 place, vec3 position, vec3 normal, float meshId, float width) {
    ivec2 size = ivec2(frame.frameSize.xy);
    vec4 sum = vec4(0.0);
    for (int reach = 1; reach <= 3 && sum.a <= 1e-12; ++reach) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                ivec2 t = pixel + ivec2(x, y);
                if (any(lessThan(t, ivec2(0))) || any(greaterThanEqual(t, size))) {
                    continue;
                }
                vec4 p = texelFetch(positions, t, 0);
                vec4 n = texelFetch(normals, t, 0);
                if (p.w <= 0.0 || n.w != meshId) {
                    continue;
                }
                vec2 d = abs(vec2(x, y) - place);
                float near = reach == 1 ? max(1.0 - d.x, 0.0) * max(1.0 - d.y, 0.0) : 1.0;
                vec3 offset = p.xyz - position;
                float plane = max(abs(dot(offset, normal)), abs(dot(offset, n.xyz))) / width;
                float w = near * exp(-4.0 * plane) * exp(-0.5 * dot(offset, offset) / (width * width * 4.0 * float(reach * reach)))
                          * max(dot(normal, n.xyz), 0.0) + (reach > 1 ? 1e-9 : 0.0);
                w *= clamp(dot(n.xyz, directionToEye(p.xyz)) / slanting, 0.02, 1.0);
                sum += w * vec4(texelFetch(radiance, t, 0).rgb, 1.0);
            }
        }
    }
    return sum;
}

void main() {
    if (!isListed(listIndex())) {
        return;
    }
    ivec2 pixel = listedPixel(listIndex());
    vec4 own = texelFetch(radiance, pixel, 0);
    vec4 result = vec4(0.0);
    for (int i = 0; i < sampleCount; ++i) {
        vec2 s = sampleAt(pixel, i);
        if (s.x <= 0.0) {
            continue;
        }
        vec3 position = positionAt(vec2(pixel) + 0.5 + jitterAndWeight.xy, s.x);
        vec3 normal = sampleNormal(pixel, i, directionToEye(position));
        vec4 found = searchAround(pixel, samplePlaces[i] + jitterAndWeight.xy, position, normal, s.y, pixelWidthMm(s.x));
        if (found.a > 0.0) {
            result += vec4(found.rgb / found.a, 1.0);
        } else if (own.a > 0.0) {
            result += vec4(own.rgb, 1.0); // a sliver that no pixel center sees: the pixel's own surface
        }
    }
    addColor(pixel, result * jitterAndWeight.z);
}
