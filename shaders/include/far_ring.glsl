// What all passes of the accumulation share. The cpu backend has the same in renderer/gather/level_accumulation.cpp and, of the
// rings, in CpuBackend::accumulate().
#include "include/bounds.glsl"
#include "include/frame.glsl"
#include "include/range_table.glsl"
#include "include/solve.glsl"

layout(location = 1) uniform float meanRadius; // R_P of the mean material, mm

// Where ring k begins, for the mean material at mean depth, mm.
float farRingStart(int k) {
    float depth = max(dot(bounds.scattering.xyz - frame.eye.xyz, frame.forward.xyz), 1e-3);
    float width = pixelWidthMm(depth) * float(1 << k);
#ifdef HIERARCHICAL
    return width / solve.rings.z;
#else
    return meanRadius * minimalRadius(meanRadius / width, 0);
#endif
}

// 1 where what comes from beyond a ring changes little from a pixel to the next, such that a polynomial tells it, to 0 where
// the range is so short that hardly anything comes from there.
// @param width  a pixel's, mm
float isFarLightSmooth(float R_P, float width) { return smoothstep(2.5, 5.0, R_P / width); }

// How alike two materials are: by what their ranges differ beside the object, or beside themselves where they reach beyond it.
float similarity(float R_P, float other) {
    return exp(-8.0 * abs(R_P - other) / max(bounds.scattering.w, max(R_P, other)));
}
