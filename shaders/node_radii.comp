// Radii and kept energy of the nodes whose profiles node_profile.comp has made (DESIGN 3.3), from the
// closed form of each segment's energy. Radii are linear in energy within a segment.
// Paired with subedit/effective_radius.cpp.
#include "include/blocks.glsl"
#include "include/picture_group.glsl"

layout(std140, binding = 3) uniform SolveUniforms { SolveBlock solve; };

layout(location = 0) uniform int level;       // >= 1
layout(location = 1) uniform float cutEnergy; // fraction that R_cut holds; >= 1: R_cut = r_s

layout(binding = 0) uniform sampler2D fluxes;
layout(binding = 1) uniform sampler2DArray profiles;

layout(rgba32f, binding = 0) uniform image2D extents;
layout(rgba32f, binding = 1) uniform writeonly image2D kepts;

// Integral over [r, r + x h] of exp(a + (b - a) t) r dr, t = (r' - r) / h; x in [0, 1].
vec3 segmentEnergy(vec3 a, vec3 b, float r, float h, float x) {
    vec3 s = (b - a) * x;
    vec3 e = exp(s);
    vec3 safe = mix(s, vec3(1.0), lessThan(abs(s), vec3(0.02)));
    vec3 first = mix((e - 1.0) / safe, 1.0 + s * (0.5 + s / 6.0), lessThan(abs(s), vec3(0.02)));
    vec3 second = mix((e * (s - 1.0) + 1.0) / (safe * safe), 0.5 + s * (1.0 / 3.0 + s / 8.0), lessThan(abs(s), vec3(0.02)));
    return exp(a) * x * h * (r * first + x * h * second);
}

vec3 knot(ivec2 node, int k) { return texelFetch(profiles, ivec3(node, k), level - 1).rgb; }

vec3 energyInside(ivec2 node, float radius) {
    int n = int(solve.node.y);
    float h = solve.node.x / solve.node.y;
    vec3 sum = vec3(0.0);
    vec3 a = knot(node, 0);
    for (int k = 0; k < n && float(k) * h < radius; ++k) {
        vec3 b = knot(node, k + 1);
        float r = float(k) * h;
        sum += segmentEnergy(a, b, r, h, min((radius - r) / h, 1.0));
        a = b;
    }
    return sum;
}

// Where the running energy crosses `wanted` within a segment that starts at `r`.
vec3 crossing(vec3 radius, vec3 wanted, vec3 sum, vec3 piece, float r, float h) {
    vec3 inside = r + h * (wanted - sum) / max(piece, vec3(1e-30));
    return mix(radius, inside, lessThan(sum, wanted));
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
    int n = int(solve.node.y);
    float h = solve.node.x / solve.node.y;
    vec3 total = energyInside(node, solve.node.x);
    vec3 radius = vec3(0.0);
    vec3 cuts = vec3(0.0);
    vec3 sum = vec3(0.0);
    vec3 a = knot(node, 0);
    for (int k = 0; k < n && any(lessThan(sum, max(cutEnergy, 0.95) * total)); ++k) {
        vec3 b = knot(node, k + 1);
        float r = float(k) * h;
        vec3 piece = segmentEnergy(a, b, r, h, 1.0);
        radius = crossing(radius, 0.95 * total, sum, piece, r, h);
        cuts = crossing(cuts, cutEnergy * total, sum, piece, r, h);
        sum += piece;
        a = b;
    }
    float cut = cutEnergy < 1.0 ? min(max(cuts.r, max(cuts.g, cuts.b)), solve.node.x) : solve.node.x;
    vec3 kept = cutEnergy < 1.0 ? clamp(energyInside(node, cut) / total, 0.5, 1.0) : vec3(1.0);
    float longest = max(radius.r, max(radius.g, radius.b));
    float shortest = min(radius.r, min(radius.g, radius.b));
    vec4 extent = imageLoad(extents, node);
    imageStore(extents, node, vec4(extent.xy, longest, cut));
    imageStore(kepts, node, vec4(kept, shortest));
}
