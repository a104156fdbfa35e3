// Of accumulation.comp and accumulation_rough.comp: a pixel of the finer level, and the coarser level's light about it.
// The cpu backend has the same in renderer/gather/level_accumulation.cpp.
#include "include/far_ring.glsl"
#include "include/listed_pixels.glsl"
#include "include/material.glsl"
#include "include/solve.glsl"

layout(location = 0) uniform int level; // k, the finer one

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D farLight; // of level k + 1: far_light.comp

layout(rgba32f, binding = 0) uniform image2D fine;

struct Point {
    vec3 position;
    vec3 normal;
    vec2 uv;
    int material; // -1: it does not scatter
    float R_P;
    float width;  // of a pixel of level k + 1, mm
};

Point pointAt(ivec2 pixel) {
    vec4 position = texelFetch(positions, pixel, level);
    vec4 surface = texelFetch(surfaces, pixel, level);
    int material = position.w > 0.0 ? int(surface.z) : -1;
    return Point(position.xyz, texelFetch(normals, pixel, level).xyz, surface.xy, material, surface.w,
                 pixelWidthMm(position.w) * float(2 << level));
}

// Position at level k + 1; w is 0 where nothing scatters.
vec4 positionAbout(ivec2 neighbor) {
    bool isInside = all(greaterThanEqual(neighbor, ivec2(0))) && all(lessThan(neighbor, textureSize(farLight, 0)));
    return isInside ? texelFetch(positions, neighbor, level + 1) : vec4(0.0);
}

// The four pixels of level k + 1 about a pixel, and their weights.
ivec2 baseOf(ivec2 pixel) { return (pixel + 1) / 2 - 1; }
ivec2 corner(int i) { return ivec2(i & 1, i >> 1); }
float bilinear(ivec2 pixel, int i) {
    vec2 fraction = mix(vec2(0.75), vec2(0.25), vec2(pixel & 1));
    vec2 weights = mix(1.0 - fraction, fraction, vec2(corner(i)));
    return weights.x * weights.y;
}

// 0 where the surface is smooth: where a point lies between the four about it. 1: there is no interpolating.
float roughness(Point o, ivec2 pixel) {
    vec3 between = vec3(0.0);
    bool isWhole = true;
    for (int i = 0; i < 4; ++i) {
        vec4 position = positionAbout(baseOf(pixel) + corner(i));
        between += bilinear(pixel, i) * position.xyz;
        isWhole = isWhole && position.w > 0.0;
    }
    return isWhole ? smoothstep(0.1, 0.3, distance(between, o.position) / o.width) : 1.0;
}

// Where roughness() is below 1.
vec3 interpolate(Point o, ivec2 pixel) {
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 light = texelFetch(farLight, baseOf(pixel) + corner(i), 0);
        float w = bilinear(pixel, i) * similarity(o.R_P, light.a);
        sum += w * light.rgb;
        total += w;
    }
    return sum / total;
}

void addFarLight(Point o, ivec2 pixel, vec3 light) {
    vec3 energy = exp(logFarEnergy(o.material, o.uv, farRingStart(level + 1)));
    vec4 b = imageLoad(fine, pixel);
    vec3 sum = b.rgb + energy * light;
    imageStore(fine, pixel, vec4(level == 0 ? max(sum, 0.0) : sum, b.a));
}
