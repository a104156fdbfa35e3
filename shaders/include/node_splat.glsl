// From a node of the irradiance buffer to a splat: its ring of distances at one level of the splatting
// buffer (Chen et al. 2012, eqs. 13 and 14), and what a pair needs of it.
//   LEAF          nodes of level 0 only, whose profile is the material's own at their uv
//   HOMOGENEOUS   one material of one texel
//   HIERARCHICAL  nested balls and cross-faded rings instead of selection and hard rings
#include "include/material.glsl"
#include "include/range_table.glsl"
#include "include/rings.glsl"
#include "include/splat.glsl"

layout(binding = 0) uniform sampler2D nodePositions;
layout(binding = 1) uniform sampler2D nodeFluxes;
layout(binding = 2) uniform sampler2D nodeSurfaces;
layout(binding = 3) uniform sampler2D nodeCovariances;
layout(binding = 4) uniform sampler2D nodeExtents;
layout(binding = 5) uniform sampler2D nodeKepts;
layout(binding = 7) uniform sampler2DArray nodeProfiles; // of level 1 and up
layout(binding = 27) uniform sampler2D balls;

// Whether the node's profile is the material's own, at its uv.
bool hasOwnProfile(int level) {
#if defined(LEAF) || defined(HOMOGENEOUS)
    return true;
#else
    return level == 0;
#endif
}

// R_min^k: R_P Rbar(T_k), T_k the pixels of splatting level k in one R_P (eq. 14). Where Rbar is 1 no
// distance is far enough for the level: it is left out, and the level before it reaches R_cut. (To
// the letter, eq. 13 would hand everything beyond R_P to the coarsest level, however coarse.)
float ringStart(int k, float R_P, float R_cut, float depth, int material) {
    if (k == 0) {
        return 0.0;
    }
    float T = R_P / (pixelWidthMm(depth) * float(1 << k));
    float start = minimalRadius(T, material);
    return start < 0.999 ? R_P * start : R_cut;
}

// The paper's ring [low, high) of a sample at level k, in mm; empty where the level is left out.
vec2 hardRing(int k, float R_P, float R_cut, float depth, int material) {
    float low = 0.0;
    float high = R_cut;
    if (isMultiresolution()) {
        for (int j = 1; j <= k; ++j) {
            low = max(low, ringStart(j, R_P, R_cut, depth, material));
        }
        low = min(low, R_cut);
        if (k + 1 < splattingLevels()) {
            high = min(max(low, ringStart(k + 1, R_P, R_cut, depth, material)), R_cut);
        }
    }
    return vec2(low, high);
}

// @param reach receives the distance beyond which no pair lies, 0: there is none
Splat makeSplat(ivec2 node, int level, int k, out float reach) {
    Splat splat;
    vec3 position = texelFetch(nodePositions, node, level).xyz;
    vec4 surfacePoint = texelFetch(nodeSurfaces, node, level);
    vec4 covariance = texelFetch(nodeCovariances, node, level);
    vec4 extent = texelFetch(nodeExtents, node, level);
    int material = int(surfacePoint.z);

    vec3 flux = texelFetch(nodeFluxes, node, level).rgb;
    if (solve.energy.x > 0.5) {
        flux /= texelFetch(nodeKepts, node, level).rgb;
    }
    float depth = max(-(frame.view * vec4(position, 1.0)).z, 1e-3);

    reach = extent.w; // R_cut
    splat.parent = vec4(0.0, 0.0, 0.0, 1e30);
#ifdef HIERARCHICAL
    float ball = texelFetch(balls, node, level).r;
    splat.ring = vec3(ringRadius(k, depth), 0.0, ball);
    if (hasNextRing(k, depth)) {
        splat.ring.y = ringRadius(k + 1, depth);
        reach = min(reach, 1.2 * splat.ring.y);
    }
    if (level + 1 < irradianceLevels()) {
        splat.parent = vec4(texelFetch(nodePositions, node / 2, level + 1).xyz, texelFetch(balls, node / 2, level + 1).r);
    }
#else
    splat.ring = vec3(hardRing(k, extent.z, extent.w, depth, material), 0.0);
    reach = splat.ring.y > splat.ring.x ? splat.ring.y : 0.0;
#endif

    splat.center = vec4(position, covariance.x + covariance.w + extent.y);
    splat.diagonal = vec3(covariance.x, covariance.w, extent.y);
    splat.offDiagonal = vec3(covariance.y, covariance.z, extent.x);
    vec3 slope;
    if (hasOwnProfile(level)) {
        splat.texture_ = surfacePoint.xyz;
        float h = materials[material].profile.x / materials[material].profile.y;
        slope = (logProfile(material, surfacePoint.xy, 0.0) - logProfile(material, surfacePoint.xy, h)) / h;
    } else {
        splat.texture_ = vec3(vec2(node), float(material));
        float h = solve.node.x / solve.node.y;
        slope = (texelFetch(nodeProfiles, ivec3(node, 0), level - 1).rgb - texelFetch(nodeProfiles, ivec3(node, 1), level - 1).rgb) / h;
    }
    splat.flux = vec4(flux, max(slope.r, max(slope.g, slope.b)));
    return splat;
}
