// One (sample, pixel) pair: B^k(x_o) += mean over the sample's patch of sqrt(P_xo P_xi) times its flux
// (Chen et al. 2012, eq. 12). The patch has covariance C; along the offset to the pixel it blurs the kernel
// by q, across it lengthens the distance to d' (DESIGN 3.1: a sample is a patch, not a point). The mean
// over the disc of radius sqrt(2 q) about d' is taken at three distances, as an integral over the distance
// where the disc is wide for the profile, at one distance where it is narrow. Alpha counts the pairs.
#include "include/material.glsl"
#include "include/solve.glsl"

layout(location = 0) uniform ivec4 levels; // irradiance level, texels in a row of it, splatting level, 0

layout(binding = 24) uniform sampler2D positions;
layout(binding = 25) uniform sampler2D surfaces;
layout(binding = 7) uniform sampler2DArray nodeProfiles;

flat in vec4 center;
flat in vec4 flux;
flat in vec3 diagonal;
flat in vec3 offDiagonal;
flat in vec3 ring;
#ifdef HIERARCHICAL
flat in vec4 parent;
#endif
flat in vec3 nodeTexture;

layout(location = 0) out vec4 exitance;

// ln P_xi(r) of the sample.
vec3 logSampleProfile(float r) {
#if defined(HOMOGENEOUS)
    return logProfile(0, vec2(0.5), r);
#elif defined(LEAF)
    return logProfile(int(nodeTexture.z), nodeTexture.xy, r);
#else
    float x = min(r / solve.node.x, 1.0) * solve.node.y;
    float k = min(floor(x), solve.node.y - 1.0);
    vec3 a = texelFetch(nodeProfiles, ivec3(nodeTexture.xy, k), levels.x - 1).rgb;
    vec3 b = texelFetch(nodeProfiles, ivec3(nodeTexture.xy, k + 1.0), levels.x - 1).rgb;
    return mix(a, b, x - k);
#endif
}

float sampleRange() {
#if defined(LEAF) || defined(HOMOGENEOUS)
    return materials[int(nodeTexture.z)].profile.x;
#else
    return solve.node.x;
#endif
}

// Gauss-Legendre on [0, 1]: place and weight.
const vec2 kGauss4[4] = vec2[](vec2(0.06943184, 0.17392742), vec2(0.33000948, 0.32607258),
                               vec2(0.66999052, 0.32607258), vec2(0.93056816, 0.17392742));
const vec2 kGauss6[6] = vec2[](vec2(0.03376524, 0.08566225), vec2(0.16939531, 0.18038079),
                               vec2(0.38069041, 0.23395697), vec2(0.61930959, 0.23395697),
                               vec2(0.83060469, 0.18038079), vec2(0.96623476, 0.08566225));

// The mean over a disc of radius R whose center is at distance d, as an integral over the distance r:
// whole circles up to R - d, then arcs of half angle acos((d^2 + r^2 - R^2) / (2 d r)), which begin and
// end like a root: midpoints in an angle. Returns r and its weight. Paired with renderer/gather/pair_kernel.inl.
vec2 radialTap(int i, int inner, int outer, float d, float R) {
    float gap = abs(R - d);
    if (i < inner) {
        vec2 rule = inner == 4 ? kGauss4[i] : kGauss6[i];
        float r = gap * rule.x;
        return vec2(r, r * gap * 3.14159265 * rule.y);
    }
    float angle = 3.14159265 * (float(i - inner) + 0.5) / float(outer);
    float width = R + d - gap;
    float r = gap + width * (0.5 - 0.5 * cos(angle));
    float halfAngle = acos(clamp((d * d + r * r - R * R) / max(2.0 * d * r, 1e-20), -1.0, 1.0));
    return vec2(r, r * halfAngle * width * sin(angle) * 1.57079633 / float(outer));
}

#ifdef HIERARCHICAL
// 0 inside the ball, 1 well outside: where the node may stand for its children.
float outside(float ball, float d) {
    return ball > 0.0 ? smoothstep(ball, (1.0 + solve.rings.w) * ball, d) : 1.0;
}

// Weight of the node's part W = a_node (1 - a_parent) times that of ring k, h_k - h_(k+1). Over all nodes
// above a texel and all rings these sum to one at every distance.
float weightAt(vec3 position, float d) {
    float w = outside(ring.z, d);
    if (parent.w < 1e29) {
        w *= 1.0 - outside(parent.w, distance(position, parent.xyz));
    }
    if (ring.x > 0.0) {
        w *= smoothstep(0.8 * ring.x, 1.2 * ring.x, d);
    }
    if (ring.y > 0.0) {
        w *= 1.0 - smoothstep(0.8 * ring.y, 1.2 * ring.y, d);
    }
    return w;
}
#else
// Hard rings: [low, high).
float weightAt(vec3 position, float d) { return d >= ring.x && d < ring.y ? 1.0 : 0.0; }
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, levels.z);
    vec3 offset = position.xyz - center.xyz;
    float d2 = dot(offset, offset);
    float d = sqrt(d2);
    float weight = position.w > 0.0 && d < sampleRange() ? weightAt(position.xyz, d) : 0.0;
    int taps = weight > 0.0 ? 1 : 0;

    // Nothing below is done where the ring is missed: loops, unlike branches, are skipped by every driver.
    vec3 sum = vec3(0.0);
    float counted = 0.0;
    for (int once = 0; once < taps; ++once) {
        vec4 surfacePoint = texelFetch(surfaces, pixel, levels.z);
        int m = int(surfacePoint.z);
        if (m < 0) {
            break;
        }
        float variance = center.w;
        float along = dot(offset * offset, diagonal) + 2.0 * dot(offset.xxy * offset.yzz, offDiagonal);
        float q = d2 > 1e-8 ? min(2.0 * along / d2, 1.3 * variance) : variance;
        float closest2 = max(d2 + variance - q, 0.0);
        float closest = sqrt(closest2);
        float blur = sqrt(q);
        bool narrow = blur < 0.1 * closest && flux.w * blur < 0.25;
        bool wide = closest < 4.0 * blur && flux.w * blur > 1.0;
        float range = min(materials[m].profile.x, sampleRange());
        float discRadius = sqrt(2.0) * blur;
        bool steep = flux.w * blur > 4.0;
        int inner = closest < discRadius ? (steep ? 6 : 4) : 0;
        int outer = steep ? 10 : 8;
        int count = narrow ? 1 : (wide ? inner + outer : 3);
        vec3 kernel = vec3(0.0);
        float total = 0.0;
        for (int i = 0; i < count; ++i) {
            float r2;
            float w = 1.0;
            if (wide) {
                vec2 tap = radialTap(i, inner, outer, closest, discRadius);
                r2 = tap.x * tap.x;
                w = tap.y;
            } else if (count == 3) {
                r2 = closest2 + 0.98 * q + float(i - 1) * 1.7320508 * blur * closest;
            } else {
                r2 = closest2 + q;
            }
            float r = sqrt(max(r2, 0.0));
#ifdef HOMOGENEOUS
            vec3 value = exp(logSampleProfile(r));
#else
            vec3 value = exp(0.5 * (logSampleProfile(r) + logProfile(m, surfacePoint.xy, r)));
#endif
            kernel += r <= range ? w * value : vec3(0.0);
            total += w;
        }
        sum = kernel * flux.rgb * (weight / max(total, 1e-20));
        counted = 1.0;
    }
    if (counted == 0.0) {
        discard;
    }
    exitance = vec4(sum, counted);
}
