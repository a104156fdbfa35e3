// Profile of each node of the irradiance buffer above level 0: the flux-weighted mean of sqrt(P) over
// its footprint (DESIGN 3.1), gathered from profiles, never by averaging texture coordinates. Written
// as ln P on the common knots of all materials; one invocation per node and knot.
#include "include/material.glsl"
#include "include/picture_group.glsl"

layout(std140, binding = 3) uniform SolveUniforms { SolveBlock solve; };

layout(location = 0) uniform int childLevel;

layout(binding = 0) uniform sampler2D fluxes;
layout(binding = 1) uniform sampler2D surfaces;
layout(binding = 2) uniform sampler2DArray profiles; // level 1 and up: mip 0 is level 1

layout(rgba32f, binding = 0) uniform writeonly image2DArray result;

const float kLogFloor = -30.0;

void main() {
    ivec3 parent = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(parent, imageSize(result)))) {
        return;
    }
    float r = float(parent.z) * solve.node.x / solve.node.y;
    vec3 root = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = parent.xy * 2 + ivec2(i & 1, i >> 1);
        vec3 flux = texelFetch(fluxes, child, childLevel).rgb;
        float w = flux.r + flux.g + flux.b;
        if (w <= 0.0) {
            continue;
        }
        vec3 logP;
        if (childLevel == 0) {
            vec4 point = texelFetch(surfaces, child, 0);
            int m = int(point.z);
            logP = r <= materials[m].profile.x * 1.0001 ? logProfile(m, point.xy, r) : vec3(kLogFloor);
        } else {
            logP = texelFetch(profiles, ivec3(child, parent.z), childLevel - 1).rgb;
        }
        root += w * exp(0.5 * logP);
        total += w;
    }
    vec3 logP = total > 0.0 ? max(2.0 * log(max(root / total, 1e-7)), vec3(kLogFloor)) : vec3(kLogFloor);
    imageStore(result, parent, vec4(logP, 0.0));
}
