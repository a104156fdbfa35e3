// Accumulation, coarse to fine (Chen et al. 2012, section 4, eq. 17; DESIGN 3.4): B^k += upsampled B^(k+1).
// Departures from eq. 17, each measured: distances count along and off the surface instead of in
// depth only; a far ring depends on the pixel's own material through sqrt(P_xo), so that factor (the
// far energy F) is divided out before interpolation and multiplied in after; a pixel with no
// reliable neighbor looks further around. Never a hole, never a leak across a silhouette.
#include "include/far_ring.glsl"
#include "include/material.glsl"
#include "include/solve.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform int level; // k, the finer one

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D coarse; // B of every level
layout(binding = 4) uniform sampler2D farEnergy; // logarithms at level k + 1, beyond its ring's start

layout(rgba32f, binding = 0) uniform image2D fine;

struct Point {
    vec3 position;
    vec3 normal;
    float R_P;
};

Point fetchPoint(ivec2 pixel, int mip, out bool covered) {
    vec4 p = texelFetch(positions, pixel, mip);
    vec4 s = texelFetch(surfaces, pixel, mip);
    covered = p.w > 0.0 && s.z >= 0.0;
    return Point(p.xyz, texelFetch(normals, pixel, mip).xyz, s.w);
}

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(fine)))) {
        return;
    }
    bool covered;
    Point o = fetchPoint(pixel, level, covered);
    if (!covered) {
        return;
    }
    float depth = texelFetch(positions, pixel, level).w;
    float width = pixelWidthMm(depth) * float(2 << level);
    vec4 surfacePoint = texelFetch(surfaces, pixel, level);
    vec3 ownFactor = logFarEnergy(int(surfacePoint.z), surfacePoint.xy, farRingStart(level + 1));

    vec2 position = (vec2(pixel) + 0.5) * 0.5 - 0.5;
    ivec2 base = ivec2(floor(position));
    vec2 fraction = position - vec2(base);
    ivec2 size = textureSize(coarse, level + 1);

    vec3 sum = vec3(0.0);
    float total = 0.0;
    float reliable = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
        int low = pass == 0 ? 0 : -2;
        int high = pass == 0 ? 1 : 3;
        for (int y = low; y <= high; ++y) {
            for (int x = low; x <= high; ++x) {
                ivec2 neighbor = base + ivec2(x, y);
                if (any(lessThan(neighbor, ivec2(0))) || any(greaterThanEqual(neighbor, size))) {
                    continue;
                }
                bool neighborCovered;
                Point j = fetchPoint(neighbor, level + 1, neighborCovered);
                if (!neighborCovered) {
                    continue;
                }
                vec3 offset = j.position - o.position;
                float delta2 = dot(offset, offset) / (width * width);
                float plane = max(abs(dot(o.normal, offset)), abs(dot(j.normal, offset))) / width;
                float facing = max(dot(o.normal, j.normal), 0.0);
                float bilinear = pass == 0 ? (x == 0 ? 1.0 - fraction.x : fraction.x) * (y == 0 ? 1.0 - fraction.y : fraction.y) : 0.05;
                float similar = exp(-8.0 * abs(o.R_P - j.R_P) / bounds.scattering.w);
                float w = bilinear * exp(-0.25 * delta2 - plane) * (facing * facing + 0.001) * similar + (pass == 0 ? 1e-9 : 1e-12);
                reliable += bilinear * exp(-0.25 * max(delta2 - 2.0, 0.0) - plane) * facing;
                vec3 b = texelFetch(coarse, neighbor, level + 1).rgb;
                vec3 factor = exp(ownFactor - texelFetch(farEnergy, neighbor, 0).rgb);
                sum += w * b * clamp(factor, vec3(0.05), vec3(20.0));
                total += w;
            }
        }
        if (reliable >= 0.15) {
            break;
        }
    }
    if (total > 0.0) {
        vec4 b = imageLoad(fine, pixel);
        imageStore(fine, pixel, vec4(b.rgb + sum / total, b.a));
    }
}
