// A selected node becomes a splat at one level of the splatting buffer: its ring of distances there
// (Chen et al. 2012, eqs. 13 and 14), and the rectangle that bounds the ring's sphere in the image.
//   LEAF          nodes of level 0, whose profile is the material's own at their uv
//   HOMOGENEOUS   one material of one texel
//   HIERARCHICAL  nested balls and cross-faded rings instead of selection and hard rings
#include "include/frame.glsl"
#include "include/light.glsl"
#include "include/material.glsl"
#include "include/range_table.glsl"
#include "include/rings.glsl"
#include "include/sphere_bounds.glsl"

layout(location = 0) in int nodeIndex;

layout(location = 0) uniform ivec4 levels; // irradiance level, texels in a row of it, splatting level, 0

layout(binding = 0) uniform sampler2D nodePositions;
layout(binding = 1) uniform sampler2D nodeFluxes;
layout(binding = 2) uniform sampler2D nodeSurfaces;
layout(binding = 3) uniform sampler2D nodeCovariances;
layout(binding = 4) uniform sampler2D nodeExtents;
layout(binding = 5) uniform sampler2D nodeKepts;
layout(binding = 7) uniform sampler2DArray nodeProfiles;
layout(binding = 27) uniform sampler2D balls;
layout(binding = 26) uniform sampler2D tileRanges; // view depths in tiles of 8 x 8 pixels and up

out Splat {
    flat vec4 rectangle; // clip coordinates: low x, low y, high x, high y; empty: cull
    flat vec4 center;    // x_i in mm; variance sigma^2 in mm^2
    flat vec4 flux;      // 1e-6 W, what lies beyond R_cut given back; steepest initial slope of -ln P in 1/mm
    flat vec3 diagonal;  // of the covariance, mm^2
    flat vec3 offDiagonal; // xy, xz, yz
    flat vec3 ring;      // paper: distances [low, high) in mm, 0; hierarchical: R^k, R^(k+1) or 0, own ball
    flat vec4 parent;    // hierarchical: the parent's position and ball, 1e30: none
    flat vec3 texture_;  // leaf: u, v, material; node: its texel
} splat;

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

// The rectangle of pixels of level k that bounds a sphere's image: low x, low y, high x, high y.
vec4 boundingPixels(vec3 inView, float radius, int k) {
    vec2 slopesX;
    vec2 slopesY;
    if (frame.eye.w > 0.5) {
        if (-inView.z + radius <= 0.0) {
            return vec4(1.0, 1.0, -1.0, -1.0); // wholly behind the eye
        }
        slopesX = tangentSlopes(inView.x, -inView.z, radius);
        slopesY = tangentSlopes(inView.y, -inView.z, radius);
    } else {
        slopesX = inView.xx + vec2(-radius, radius);
        slopesY = inView.yy + vec2(-radius, radius);
    }
    vec4 ndc = vec4(slopesX.x, slopesY.x, slopesX.y, slopesY.y) * frame.projection.xyxy;
    vec4 pixels = (ndc * 0.5 + 0.5) * frame.frameSize.xyxy / float(1 << k);
    vec2 size = frame.frameSize.zw / float(1 << k);
    // A representative point may lie anywhere in its pixel: one pixel of margin.
    return vec4(clamp(pixels.xy - 1.0, vec2(0.0), size), clamp(pixels.zw + 1.0, vec2(0.0), size));
}

// Whether some pixel within the rectangle (in pixels of level 0) lies between the two view depths.
bool meetsSurface(vec4 pixels, float nearest, float farthest) {
    float extent = max(pixels.z - pixels.x, pixels.w - pixels.y);
    int mip = clamp(int(ceil(log2(max(extent / 16.0, 1.0)))), 0, textureQueryLevels(tileRanges) - 1);
    float tileSize = float(8 << mip);
    ivec2 low = ivec2(pixels.xy / tileSize);
    // Not textureSize(tileRanges, mip): some drivers take one lane's level for all lanes.
    ivec2 high = min(ivec2(pixels.zw / tileSize), (textureSize(tileRanges, 0) >> mip) - 1);
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            vec2 range = texelFetch(tileRanges, ivec2(x, y), mip).xy;
            if (range.x <= farthest && range.y >= nearest) {
                return true;
            }
        }
    }
    return false;
}

void main() {
    int level = levels.x;
    int k = levels.z;
    ivec2 node = ivec2(nodeIndex % levels.y, nodeIndex / levels.y);
    vec3 position = texelFetch(nodePositions, node, level).xyz;
    vec4 surfacePoint = texelFetch(nodeSurfaces, node, level);
    vec4 covariance = texelFetch(nodeCovariances, node, level);
    vec4 extent = texelFetch(nodeExtents, node, level);
    int material = int(surfacePoint.z);

    vec3 flux = texelFetch(nodeFluxes, node, level).rgb;
    if (solve.energy.x > 0.5) {
        flux /= texelFetch(nodeKepts, node, level).rgb;
    }
    float R_P = extent.z;
    float R_cut = extent.w;
    vec3 inView = (frame.view * vec4(position, 1.0)).xyz;
    float depth = max(-inView.z, 1e-3);

    float high = R_cut; // no pair lies beyond
    splat.parent = vec4(0.0, 0.0, 0.0, 1e30);
#ifdef HIERARCHICAL
    float ball = texelFetch(balls, node, level).r;
    splat.ring = vec3(ringRadius(k, depth), 0.0, ball);
    if (hasNextRing(k, depth)) {
        splat.ring.y = ringRadius(k + 1, depth);
        high = min(high, 1.2 * splat.ring.y);
    }
    if (level + 1 < irradianceLevels()) {
        splat.parent = vec4(texelFetch(nodePositions, node / 2, level + 1).xyz, texelFetch(balls, node / 2, level + 1).r);
    }
#else
    float low = 0.0;
    if (isMultiresolution()) {
        for (int j = 1; j <= k; ++j) {
            low = max(low, ringStart(j, R_P, R_cut, depth, material));
        }
        low = min(low, R_cut);
        if (k + 1 < splattingLevels()) {
            high = min(max(low, ringStart(k + 1, R_P, R_cut, depth, material)), R_cut);
        }
    }
    splat.ring = vec3(low, high, 0.0);
    if (high <= low) {
        high = 0.0;
    }
#endif

    splat.center = vec4(position, covariance.x + covariance.w + extent.y);
    splat.diagonal = vec3(covariance.x, covariance.w, extent.y);
    splat.offDiagonal = vec3(covariance.y, covariance.z, extent.x);
#ifdef LEAF
    splat.texture_ = surfacePoint.xyz;
    float h = materials[material].profile.x / materials[material].profile.y;
    vec3 slope = (logProfile(material, surfacePoint.xy, 0.0) - logProfile(material, surfacePoint.xy, h)) / h;
#else
    splat.texture_ = vec3(vec2(node), float(material));
    float h = solve.node.x / solve.node.y;
    vec3 slope = (texelFetch(nodeProfiles, ivec3(node, 0), level - 1).rgb - texelFetch(nodeProfiles, ivec3(node, 1), level - 1).rgb) / h;
#endif
    splat.flux = vec4(flux, max(slope.r, max(slope.g, slope.b)));

    splat.rectangle = vec4(1.0, 1.0, -1.0, -1.0);
    if (high > 0.0) {
        vec4 pixels = boundingPixels(inView, high, k);
        float nearest = -inView.z - high;
        float farthest = -inView.z + high;
        if (splat.parent.w < 1e29) {
            vec3 parentInView = (frame.view * vec4(splat.parent.xyz, 1.0)).xyz;
            float radius = (1.0 + solve.rings.w) * splat.parent.w;
            vec4 inParent = boundingPixels(parentInView, radius, k);
            pixels = vec4(max(pixels.xy, inParent.xy), min(pixels.zw, inParent.zw));
            nearest = max(nearest, -parentInView.z - radius);
            farthest = min(farthest, -parentInView.z + radius);
        }
        if (all(lessThan(pixels.xy, pixels.zw)) && meetsSurface(pixels * float(1 << k), nearest, farthest)) {
            splat.rectangle = pixels * float(1 << k) / frame.frameSize.zwzw * 2.0 - 1.0;
        }
    }
    gl_Position = vec4(0.0);
}
