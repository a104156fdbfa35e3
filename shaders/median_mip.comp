// One level of the splatting buffer from the level below (DESIGN 3.3): of each 2x2 the
// texel of median depth among the covered scattering ones gives normal, texture coordinate and
// material, whole; position and depth are the mean of those in the median's depth cluster, so that the
// representative lies at the texel's center. Never a mean across a silhouette.
#include "include/bounds.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform int childLevel;
layout(location = 1) uniform float clusterDepth; // of R_w

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;

layout(rgba32f, binding = 0) uniform writeonly image2D parentPosition;
layout(rgba32f, binding = 1) uniform writeonly image2D parentNormal;
layout(rgba32f, binding = 2) uniform writeonly image2D parentSurface;

void main() {
    ivec2 parent = coveredPixel();
    if (any(greaterThanEqual(parent, imageSize(parentPosition)))) {
        return;
    }
    vec4 p[4];
    int order[4]; // covered children by depth
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = parent * 2 + ivec2(i & 1, i >> 1);
        p[i] = texelFetch(positions, child, childLevel);
        if (p[i].w > 0.0 && texelFetch(surfaces, child, childLevel).z >= 0.0) {
            int j = count++;
            while (j > 0 && p[order[j - 1]].w > p[i].w) {
                order[j] = order[j - 1];
                --j;
            }
            order[j] = i;
        }
    }
    vec4 position = vec4(0.0);
    vec4 normal = vec4(0.0);
    vec4 surfacePoint = vec4(0.0, 0.0, -1.0, 0.0);
    if (count > 0) {
        int median = order[(count - 1) / 2];
        ivec2 child = parent * 2 + ivec2(median & 1, median >> 1);
        surfacePoint = texelFetch(surfaces, child, childLevel);
        float meshId = texelFetch(normals, child, childLevel).w;
        float members = 0.0;
        for (int j = 0; j < count; ++j) {
            int i = order[j];
            if (abs(p[i].w - p[median].w) < clusterDepth * 2.0 * bounds.scattering.w) {
                position += p[i];
                normal.xyz += texelFetch(normals, parent * 2 + ivec2(i & 1, i >> 1), childLevel).xyz;
                members += 1.0;
            }
        }
        position /= members;
        normal = vec4(dot(normal.xyz, normal.xyz) > 1e-12 ? normalize(normal.xyz) : vec3(0.0, 0.0, 1.0), meshId);
    }
    imageStore(parentPosition, parent, position);
    imageStore(parentNormal, parent, normal);
    imageStore(parentSurface, parent, surfacePoint);
}
