// Radii and kept energy of the nodes whose profiles node_profile.comp has made (DESIGN 3.3), from the
// closed form of each segment's energy. Paired with subedit/effective_radius.cpp.
#include "include/blocks.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 3) uniform SolveUniforms { SolveBlock solve; };

layout(location = 0) uniform int level;       // >= 1
layout(location = 1) uniform float cutEnergy; // fraction that R_cut holds; >= 1: R_cut = r_s

layout(binding = 0) uniform sampler2D fluxes;
layout(binding = 1) uniform sampler2DArray profiles;

layout(rgba32f, binding = 0) uniform image2D extents;
layout(rgba32f, binding = 1) uniform writeonly image2D kepts;

// Integral over [r, r + x h] of exp(a + (b - a) t) r dr, t = (r' - r) / h, for one channel; x in [0, 1].
float segmentEnergy(float a, float b, float r, float h, float x) {
    float s = (b - a) * x;
    float e = exp(s);
    bool small = abs(s) < 0.02;
    float first = small ? 1.0 + s * (0.5 + s / 6.0) : (e - 1.0) / s;
    float second = small ? 0.5 + s * (1.0 / 3.0 + s / 8.0) : (e * (s - 1.0) + 1.0) / (s * s);
    return exp(a) * x * h * (r * first + x * h * second);
}

float radiusOfEnergy(ivec2 node, int c, float wanted, out float total) {
    int n = int(solve.node.y);
    float h = solve.node.x / solve.node.y;
    float sum = 0.0;
    float radius = solve.node.x;
    float a = texelFetch(profiles, ivec3(node, 0), level - 1)[c];
    total = wanted;
    for (int k = 0; k < n; ++k) {
        float b = texelFetch(profiles, ivec3(node, k + 1), level - 1)[c];
        float r = float(k) * h;
        float piece = segmentEnergy(a, b, r, h, 1.0);
        if (sum < wanted && sum + piece >= wanted) {
            float low = 0.0;
            float high = 1.0;
            for (int i = 0; i < 12; ++i) {
                float x = 0.5 * (low + high);
                if (sum + segmentEnergy(a, b, r, h, x) < wanted) {
                    low = x;
                } else {
                    high = x;
                }
            }
            radius = r + high * h;
        }
        sum += piece;
        a = b;
    }
    total = sum;
    return radius;
}

float energyInside(ivec2 node, int c, float radius) {
    int n = int(solve.node.y);
    float h = solve.node.x / solve.node.y;
    float sum = 0.0;
    float a = texelFetch(profiles, ivec3(node, 0), level - 1)[c];
    for (int k = 0; k < n; ++k) {
        float b = texelFetch(profiles, ivec3(node, k + 1), level - 1)[c];
        float r = float(k) * h;
        float x = clamp((radius - r) / h, 0.0, 1.0);
        if (x <= 0.0) {
            break;
        }
        sum += segmentEnergy(a, b, r, h, x);
        a = b;
    }
    return sum;
}

void main() {
    ivec2 node = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(node, imageSize(extents)))) {
        return;
    }
    vec3 flux = texelFetch(fluxes, node, level).rgb;
    if (flux.r + flux.g + flux.b <= 0.0) {
        return;
    }
    vec3 radius;
    vec3 total;
    float cut = 0.0;
    for (int c = 0; c < 3; ++c) {
        float energy;
        radiusOfEnergy(node, c, 1e30, energy);
        total[c] = energy;
        float unused;
        radius[c] = radiusOfEnergy(node, c, 0.95 * energy, unused);
        cut = max(cut, cutEnergy < 1.0 ? radiusOfEnergy(node, c, cutEnergy * energy, unused) : solve.node.x);
    }
    vec3 kept = vec3(1.0);
    if (cutEnergy < 1.0) {
        for (int c = 0; c < 3; ++c) {
            kept[c] = clamp(energyInside(node, c, cut) / total[c], 0.5, 1.0);
        }
    }
    float longest = max(radius.r, max(radius.g, radius.b));
    float shortest = min(radius.r, min(radius.g, radius.b));
    vec4 extent = imageLoad(extents, node);
    imageStore(extents, node, vec4(extent.xy, longest, cut));
    imageStore(kepts, node, vec4(kept, shortest));
}
