// One level of the splatting buffer from the level below (DESIGN 3.3): of each 2x2 the
// texel of median depth among the covered scattering ones gives normal, texture coordinate and
// material, whole; position and depth are the mean of those in the median's depth cluster, so that the
// representative lies at the texel's center. Never a mean across a silhouette.
// The cpu backend has the same in renderer/gather/view_level.cpp.
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

// Of four depths, how many come before each; of equals the first do.
vec4 ranksOf(vec4 depths) {
    vec3 neighbors = vec3(lessThan(depths.yzw, depths.xyz)); // 1: the second comes before the first
    vec2 opposites = vec2(lessThan(depths.zw, depths.xy));
    float ends = depths.w < depths.x ? 1.0 : 0.0;
    return vec4(neighbors.x + opposites.x + ends, 1.0 - neighbors.x + neighbors.y + opposites.y,
                2.0 - neighbors.y - opposites.x + neighbors.z, 3.0 - neighbors.z - opposites.y - ends);
}

void main() {
    ivec2 parent = coveredPixel();
    if (any(greaterThanEqual(parent, imageSize(parentPosition)))) {
        return;
    }
    mat4 p;       // of the children: positions,
    mat4 s;       //   surface points,
    mat4 n;       //   and normals, undefined where nothing is
    bvec4 covers; // and scatters
    for (int i = 0; i < 4; ++i) {
        ivec2 child = parent * 2 + ivec2(i & 1, i >> 1);
        p[i] = texelFetch(positions, child, childLevel);
        s[i] = texelFetch(surfaces, child, childLevel);
        n[i] = texelFetch(normals, child, childLevel);
        covers[i] = p[i].w > 0.0 && s[i].z >= 0.0;
    }
    vec4 position = vec4(0.0);
    vec4 normal = vec4(0.0);
    vec4 surfacePoint = vec4(0.0, 0.0, -1.0, 0.0);
    if (any(covers)) {
        float count = dot(vec4(covers), vec4(1.0));
        vec4 depths = mix(vec4(1e30), vec4(p[0].w, p[1].w, p[2].w, p[3].w), covers);
        vec4 median = vec4(equal(ranksOf(depths), vec4(floor(0.5 * (count - 1.0))))); // 1 for one of them
        vec4 cluster = vec4(lessThan(abs(depths - dot(depths, median)), vec4(clusterDepth * 2.0 * bounds.scattering.w)));
        for (int i = 0; i < 4; ++i) {
            n[i] = cluster[i] > 0.0 ? n[i] : vec4(0.0);
        }
        surfacePoint = s * median;
        position = p * cluster / dot(cluster, vec4(1.0));
        vec3 sum = (n * cluster).xyz;
        normal = vec4(dot(sum, sum) > 1e-12 ? normalize(sum) : vec3(0.0, 0.0, 1.0), (n * median).w);
    }
    imageStore(parentPosition, parent, position);
    imageStore(parentNormal, parent, normal);
    imageStore(parentSurface, parent, surfacePoint);
}
