// One level of the irradiance buffer from the level below (DESIGN 3.1). Flux of a parent is the sum of
// its children's; everything else is the mean weighted by flux, so that background and unlit surface
// never leak in. The covariance gathers the children's spread: a parent stays an honest patch.
// The hierarchical scheme also grows the ball outside which the node may stand for its children.
#include "include/blocks.glsl"
#include "include/picture_group.glsl"

layout(std140, binding = 3) uniform SolveUniforms { SolveBlock solve; };

layout(location = 0) uniform int childLevel;

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D fluxes;
layout(binding = 3) uniform sampler2D surfaces;
layout(binding = 4) uniform sampler2D covariances;
layout(binding = 5) uniform sampler2D extents;
layout(binding = 6) uniform sampler2D kepts;

layout(rgba32f, binding = 0) uniform writeonly image2D parentPosition;
layout(rgba32f, binding = 1) uniform writeonly image2D parentNormal;
layout(rgba32f, binding = 2) uniform writeonly image2D parentFlux;
layout(rgba32f, binding = 3) uniform writeonly image2D parentSurface;
layout(rgba32f, binding = 4) uniform writeonly image2D parentCovariance;
layout(rgba32f, binding = 5) uniform writeonly image2D parentExtent;
layout(rgba32f, binding = 6) uniform writeonly image2D parentKept;

void main() {
    ivec2 parent = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(parent, imageSize(parentPosition)))) {
        return;
    }
    vec4 flux = vec4(0.0);
    float weights[4];
    vec4 position = vec4(0.0);
    vec4 normal = vec4(0.0);
    vec4 surfacePoint = vec4(0.0, 0.0, -1.0, 0.0);
    vec4 extent = vec4(0.0);
    vec4 kept = vec4(0.0);
    float total = 0.0;
    float heaviest = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = parent * 2 + ivec2(i & 1, i >> 1);
        vec4 f = texelFetch(fluxes, child, childLevel);
        float w = f.r + f.g + f.b;
        weights[i] = w;
        flux += vec4(f.rgb, 0.25 * f.a);
        vec4 s = texelFetch(surfaces, child, childLevel);
        surfacePoint.w += 0.25 * s.w;
        if (w > 0.0) {
            total += w;
            position += w * texelFetch(positions, child, childLevel);
            normal += w * texelFetch(normals, child, childLevel);
            extent += w * texelFetch(extents, child, childLevel);
            kept += w * texelFetch(kepts, child, childLevel);
            if (w > heaviest) {
                heaviest = w;
                surfacePoint.xyz = s.xyz;
            }
        }
    }
    vec4 covariance = vec4(0.0);
    if (total > 0.0) {
        float scale = 1.0 / total;
        position *= scale;
        normal *= scale;
        normal.xyz = dot(normal.xyz, normal.xyz) > 1e-12 ? normalize(normal.xyz) : vec3(0.0, 0.0, 1.0);
        extent *= scale;
        kept *= scale;
        vec2 tail = vec2(0.0);
        for (int i = 0; i < 4; ++i) {
            if (weights[i] <= 0.0) {
                continue;
            }
            ivec2 child = parent * 2 + ivec2(i & 1, i >> 1);
            float w = weights[i] * scale;
            vec3 d = texelFetch(positions, child, childLevel).xyz - position.xyz;
            covariance += w * (texelFetch(covariances, child, childLevel) + vec4(d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y));
            tail += w * (texelFetch(extents, child, childLevel).xy + vec2(d.y * d.z, d.z * d.z));
        }
        extent.xy = tail;
    }
    imageStore(parentPosition, parent, position);
    imageStore(parentNormal, parent, normal);
    imageStore(parentFlux, parent, flux);
    imageStore(parentSurface, parent, surfacePoint);
    imageStore(parentCovariance, parent, covariance);
    imageStore(parentExtent, parent, extent);
    imageStore(parentKept, parent, kept);
}
