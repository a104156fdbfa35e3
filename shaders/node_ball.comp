// Hierarchical scheme: the ball about each node's mean position outside which the node may stand for
// its children. 0: small enough for its material at any distance (and every leaf). Else at least
// spread / theta_s, and wide enough that the balls of its children, grown by their fade, lie within: with
// nested balls the weights of a texel's ancestors sum to one at every distance.
#include "include/solve.glsl"
#include "include/picture_group.glsl"

layout(location = 0) uniform int level; // >= 1

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D fluxes;
layout(binding = 2) uniform sampler2D covariances;
layout(binding = 3) uniform sampler2D extents;
layout(binding = 4) uniform sampler2D kepts;
layout(binding = 5) uniform sampler2D balls; // radius in mm

const float kNeverUsed = 1e30;

layout(r32f, binding = 0) uniform writeonly image2D result;

// Largest eigenvalue of a symmetric 3x3 matrix, in closed form (Smith 1961).
float largestEigenvalue(vec3 diagonal, vec3 offDiagonal) {
    float mean = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
    vec3 d = diagonal - mean;
    float p = sqrt(max((dot(d, d) + 2.0 * dot(offDiagonal, offDiagonal)) / 6.0, 0.0));
    if (p <= 1e-12 * max(mean, 1e-12)) {
        return mean;
    }
    vec3 b = d / p;
    vec3 o = offDiagonal / p; // xy, xz, yz
    float halfDeterminant = 0.5 * (b.x * (b.y * b.z - o.z * o.z) - o.x * (o.x * b.z - o.z * o.y) + o.y * (o.x * o.z - b.y * o.y));
    return mean + 2.0 * p * cos(acos(clamp(halfDeterminant, -1.0, 1.0)) / 3.0);
}

void main() {
    ivec2 node = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(node, imageSize(result)))) {
        return;
    }
    vec3 flux = texelFetch(fluxes, node, level).rgb;
    if (flux.r + flux.g + flux.b <= 0.0) {
        imageStore(result, node, vec4(0.0));
        return;
    }
    vec4 covariance = texelFetch(covariances, node, level);
    vec2 tail = texelFetch(extents, node, level).xy;
    float lambda = largestEigenvalue(vec3(covariance.x, covariance.w, tail.y), vec3(covariance.y, covariance.z, tail.x));
    float spread = sqrt(12.0 * max(lambda, 0.0));

    // A light child far off moves the mean and the spread but little: its offset counts like
    // that of the corner children of a uniform square, 1 / sqrt(8) of the side.
    vec3 center = texelFetch(positions, node, level).xyz;
    float nested = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = node * 2 + ivec2(i & 1, i >> 1);
        vec3 childFlux = texelFetch(fluxes, child, level - 1).rgb;
        if (childFlux.r + childFlux.g + childFlux.b <= 0.0) {
            continue;
        }
        float offset = distance(texelFetch(positions, child, level - 1).xyz, center);
        spread = max(spread, sqrt(8.0) * offset);
        float childRadius = texelFetch(balls, child, level - 1).r;
        if (childRadius > 0.0) {
            nested = max(nested, (1.0 + solve.rings.w) * childRadius + offset);
        }
    }
    bool fine = nested == 0.0 && spread < solve.node.w * texelFetch(kepts, node, level).w;
    float radius = fine ? 0.0 : max(spread / solve.node.z, nested);
    // A node that would come into use beyond r_s is never used, at any distance from its mean: its
    // children may well be within r_s where the mean is not.
    imageStore(result, node, vec4(radius < solve.node.x ? radius : kNeverUsed));
}
