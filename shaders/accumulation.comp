// Accumulation, coarse to fine (Chen et al. 2012, section 4, eq. 17; DESIGN 3.4): B^k += upsampled B^(k+1).
// Departures from eq. 17, each measured. A far ring depends on the pixel's own material through sqrt(P_xo): that factor, the
// far energy, is divided out before interpolation and multiplied in after. On a smooth surface weights are bilinear and
// nothing else, so that what changes linearly is reproduced; interpolation is cubic where far_light_sharpening.comp came
// before. At silhouettes, where light falls off along what curves away and no neighbor lies beyond, a line is fitted
// to what is around, by distances along and off the surface. Never a hole, never a leak across a silhouette.
#include "include/far_ring.glsl"
#include "include/material.glsl"
#include "include/solve.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform int level; // k, the finer one

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D farLight; // of level k + 1: far_light.comp

layout(rgba32f, binding = 0) uniform image2D fine;

struct Point {
    vec3 position;
    vec3 normal;
    float R_P;
};

// Position at level k + 1; w is 0 where nothing scatters.
vec4 positionAbout(ivec2 neighbor) {
    bool isInside = all(greaterThanEqual(neighbor, ivec2(0))) && all(lessThan(neighbor, textureSize(farLight, 0)));
    return isInside ? texelFetch(positions, neighbor, level + 1) : vec4(0.0);
}

// How alike two materials are.
float similarity(float R_P, float other) { return exp(-8.0 * abs(R_P - other) / bounds.scattering.w); }

float bilinear(int i, vec2 fraction) {
    return ((i & 1) == 0 ? 1.0 - fraction.x : fraction.x) * ((i >> 1) == 0 ? 1.0 - fraction.y : fraction.y);
}

vec3 interpolate(Point o, ivec2 base, vec2 fraction) {
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 light = texelFetch(farLight, base + ivec2(i & 1, i >> 1), 0);
        float w = bilinear(i, fraction) * similarity(o.R_P, light.a);
        sum += w * light.rgb;
        total += w;
    }
    return sum / total;
}

// Weighted least squares of light that is linear along the way from the neighbors' mean position to this point.
// @param width  a pixel's of level k + 1, mm
// @param count  25; 0 where no fit is wanted, and nothing is done then
vec3 fit(Point o, ivec2 center, float width, int count) {
    const float leastVariance = 0.05; // in widths squared: below, the slope is not to be trusted
    const float farthest = 1.5;       // in widths: nor is it beyond
    float total = 1e-30;
    vec3 place = vec3(0.0); // sums of offsets, light, their products
    vec3 light = vec3(0.0);
    mat3 places = mat3(0.0);
    mat3 lights = mat3(0.0); // a column for each part of the offset
    for (int i = 0; i < count; ++i) {
        ivec2 neighbor = center + ivec2(i % 5, i / 5) - 2;
        vec4 position = positionAbout(neighbor);
        if (position.w <= 0.0) {
            continue;
        }
        vec4 its = texelFetch(farLight, neighbor, 0);
        vec3 normal = texelFetch(normals, neighbor, level + 1).xyz;
        vec3 offset = (position.xyz - o.position) / width;
        float plane = max(abs(dot(o.normal, offset)), abs(dot(normal, offset)));
        float facing = max(dot(o.normal, normal), 0.0);
        float w = exp(-0.2 * dot(offset, offset) - plane) * similarity(o.R_P, its.a) * (facing * facing + 0.001) + 1e-12;
        total += w;
        place += w * offset;
        light += w * its.rgb;
        places += outerProduct(w * offset, offset);
        lights += outerProduct(w * its.rgb, offset);
    }
    place /= total;
    light /= total;
    float away = length(place);
    vec3 along = away > 1e-6 ? -place / away : vec3(0.0);
    float variance = max(dot(along, places * along) / total - away * away, 0.0);
    vec3 slope = (lights * along / total + light * away) / (variance + leastVariance);
    return light + isFarLightSmooth(o.R_P, width) * min(away, farthest) * slope;
}

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(fine)))) {
        return;
    }
    vec4 own = texelFetch(positions, pixel, level);
    vec4 surfacePoint = texelFetch(surfaces, pixel, level);
    if (own.w <= 0.0 || surfacePoint.z < 0.0) {
        return;
    }
    Point o = Point(own.xyz, texelFetch(normals, pixel, level).xyz, surfacePoint.w);
    float width = pixelWidthMm(own.w) * float(2 << level);
    vec2 place = (vec2(pixel) + 0.5) * 0.5 - 0.5;
    ivec2 base = ivec2(floor(place));
    vec2 fraction = place - vec2(base);

    // Smooth is where this point lies between the four about it.
    vec3 between = vec3(0.0);
    float present = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 position = positionAbout(base + ivec2(i & 1, i >> 1));
        float w = position.w > 0.0 ? bilinear(i, fraction) : 0.0;
        between += w * position.xyz;
        present += w;
    }
    bool isWhole = present > 0.999;
    float rough = isWhole ? smoothstep(0.1, 0.3, distance(between, o.position) / width) : 1.0;
    vec3 light = isWhole ? interpolate(o, base, fraction) : vec3(0.0);
    light = mix(light, fit(o, pixel / 2, width, rough > 0.0 ? 25 : 0), rough);
    vec3 energy = exp(logFarEnergy(int(surfacePoint.z), surfacePoint.xy, farRingStart(level + 1)));
    vec4 b = imageLoad(fine, pixel);
    vec3 sum = b.rgb + energy * light;
    imageStore(fine, pixel, vec4(level == 0 ? max(sum, 0.0) : sum, b.a));
}
