// For accumulation.comp: far light such that what is interpolated linearly between its pixels is what a cubic would find.
// The light of a sample is a convex function of the place, nearly everywhere, and chords run above it: linear
// interpolation alone makes far rings brighter, by 3/32 of the second difference along each axis, since every pixel of
// the finer level lies a quarter of a pixel beside a center. That is taken away beforehand (what results are the
// weights of Catmull and Rom 1974).
// The cpu backend has the same in renderer/gather/level_accumulation.cpp.
#include "include/far_ring.glsl"
#include "include/covered_group.glsl"

layout(location = 0) uniform int level;

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D farLight; // of far_light.comp

layout(rgba32f, binding = 0) uniform writeonly image2D sharpened;

// The second difference along an axis; 0 where the surface is not smooth there, or its material changes.
vec3 secondDifference(ivec2 pixel, ivec2 axis, vec4 light, vec3 position) {
    ivec2 before = pixel - axis;
    ivec2 after = pixel + axis;
    if (any(lessThan(before, ivec2(0))) || any(greaterThanEqual(after, imageSize(sharpened)))) {
        return vec3(0.0);
    }
    vec4 from = texelFetch(positions, before, level);
    vec4 to = texelFetch(positions, after, level);
    vec3 bend = from.xyz + to.xyz - 2.0 * position;
    vec3 chord = to.xyz - from.xyz;
    if (from.w <= 0.0 || to.w <= 0.0 || dot(bend, bend) > 0.25 * dot(chord, chord)) {
        return vec3(0.0);
    }
    vec4 a = texelFetch(farLight, before, 0);
    vec4 b = texelFetch(farLight, after, 0);
    float alike = min(similarity(light.a, a.a), similarity(light.a, b.a));
    return alike * (a.rgb + b.rgb - 2.0 * light.rgb);
}

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(sharpened)))) {
        return;
    }
    vec4 position = texelFetch(positions, pixel, level);
    if (position.w <= 0.0) {
        return;
    }
    vec4 light = texelFetch(farLight, pixel, 0);
    vec3 bend = secondDifference(pixel, ivec2(1, 0), light, position.xyz) + secondDifference(pixel, ivec2(0, 1), light, position.xyz);
    float width = pixelWidthMm(position.w) * float(1 << level);
    imageStore(sharpened, pixel, vec4(light.rgb - 3.0 / 32.0 * isFarLightSmooth(light.a, width) * bend, light.a));
}
