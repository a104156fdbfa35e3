// One (sample, pixel) pair: B^k(x_o) += kernel times the sample's flux (Chen et al. 2012, eq. 12). Alpha
// counts the pairs.
#include "include/material.glsl"
#include "include/pair_kernel.glsl"
#include "include/splat.glsl"

layout(location = 0) uniform ivec4 levels; // irradiance level, texels in a row of it, splatting level, 0

layout(binding = 24) uniform sampler2D positions;
layout(binding = 25) uniform sampler2D surfaces;
layout(binding = 7) uniform sampler2DArray nodeProfiles;

flat in vec4 center;
flat in vec4 flux;
flat in vec3 diagonal;
flat in vec3 offDiagonal;
flat in vec3 ring;
#ifdef HIERARCHICAL
flat in vec4 parent;
#endif
flat in vec3 nodeTexture;

layout(location = 0) out vec4 exitance;

// ln P_xi(r) of the sample.
vec3 logSampleProfile(float r) {
#if defined(HOMOGENEOUS)
    return logProfile(0, vec2(0.5), r);
#elif defined(LEAF)
    return logProfile(int(nodeTexture.z), nodeTexture.xy, r);
#else
    float x = min(r / solve.node.x, 1.0) * solve.node.y;
    float k = min(floor(x), solve.node.y - 1.0);
    vec3 a = texelFetch(nodeProfiles, ivec3(nodeTexture.xy, k), levels.x - 1).rgb;
    vec3 b = texelFetch(nodeProfiles, ivec3(nodeTexture.xy, k + 1.0), levels.x - 1).rgb;
    return mix(a, b, x - k);
#endif
}

float sampleRange() {
#if defined(LEAF) || defined(HOMOGENEOUS)
    return materials[int(nodeTexture.z)].profile.x;
#else
    return solve.node.x;
#endif
}

vec2 pixelUv;
int pixelMaterial;

vec3 pairProfile(float r) {
#ifdef HOMOGENEOUS
    return exp(logSampleProfile(r));
#else
    return exp(0.5 * (logSampleProfile(r) + logProfile(pixelMaterial, pixelUv, r)));
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, levels.z);
    vec3 offset = position.xyz - center.xyz;
    float d2 = dot(offset, offset);
    float d = sqrt(d2);
#ifdef HIERARCHICAL
    vec4 parentBall = parent;
#else
    vec4 parentBall = vec4(0.0);
#endif
    float weight = position.w > 0.0 && d < sampleRange() ? ringWeight(position.xyz, d, ring, parentBall) : 0.0;
    int taken = weight > 0.0 ? 1 : 0;

    // Nothing below is done where the ring is missed: loops, unlike branches, are skipped by every driver.
    vec3 sum = vec3(0.0);
    float counted = 0.0;
    for (int once = 0; once < taken; ++once) {
        vec4 surfacePoint = texelFetch(surfaces, pixel, levels.z);
        pixelMaterial = int(surfacePoint.z);
        pixelUv = surfacePoint.xy;
        if (pixelMaterial < 0) {
            break;
        }
        float range = min(materials[pixelMaterial].profile.x, sampleRange());
        sum = pairKernel(offset, d2, center.w, diagonal, offDiagonal, flux.w, range) * flux.rgb * weight;
        counted = 1.0;
    }
    if (counted == 0.0) {
        discard;
    }
    exitance = vec4(sum, counted);
}
