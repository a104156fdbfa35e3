// What one light view adds at once, without scattering below the surface: the specular lobe of every
// surface, and the diffuse one of opaque parts; shadowed by the depths of the light's view.
#include "include/frame.glsl"
#include "include/light.glsl"
#include "include/ggx.glsl"

layout(location = 0) uniform int specular; // 0: none

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D lobes;
layout(binding = 4) uniform sampler2D bases;
layout(binding = 5) uniform sampler2D emissions;
layout(binding = 6) uniform sampler2D shadowMap; // reversed depth, 0 background

layout(location = 0) out vec4 radiance;

// Part of a 3x3 neighborhood of the shadow map that the light reaches, bilinear between texels. The
// point is moved off its surface by what a texel spans there, so that it does not shadow itself.
float visibility(vec3 position, vec3 n, vec3 toLight) {
    float depth = -(light.view * vec4(position, 1.0)).z;
    float width = texelWidthMm(depth);
    float cosine = dot(n, toLight);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    vec3 shifted = position + (n * (0.75 + 2.0 * sine) + toLight) * width;
    vec4 clip = light.viewProjection * vec4(shifted, 1.0);
    vec3 ndc = clip.xyz / clip.w;
    if (clip.w <= 0.0 || any(greaterThan(abs(ndc.xy), vec2(1.0)))) {
        return light.position.w > 0.5 ? 0.0 : 1.0; // another face of the cube; beyond every caster
    }
    int N = int(light.direction.w);
    vec2 texel = (ndc.xy * 0.5 + 0.5) * float(N) - 0.5;
    ivec2 base = ivec2(floor(texel));
    vec2 fraction = texel - vec2(base);
    float lit = 0.0;
    for (int y = -1; y <= 2; ++y) {
        for (int x = -1; x <= 2; ++x) {
            ivec2 t = clamp(base + ivec2(x, y), ivec2(0), ivec2(N - 1));
            float wx = x == -1 ? 1.0 - fraction.x : (x == 2 ? fraction.x : 1.0);
            float wy = y == -1 ? 1.0 - fraction.y : (y == 2 ? fraction.y : 1.0);
            lit += texelFetch(shadowMap, t, 0).r > ndc.z ? 0.0 : wx * wy;
        }
    }
    return lit / 9.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w <= 0.0) {
        discard;
    }
    vec3 n = texelFetch(normals, pixel, 0).xyz;
    vec3 toLight = directionToLight(position.xyz);
    float cosine = dot(n, toLight);
    vec3 H = facingIrradiance(position.xyz);
    if (cosine <= 0.0 || H.r + H.g + H.b <= 0.0) {
        discard;
    }
    float reached = visibility(position.xyz, n, toLight);
    if (reached <= 0.0) {
        discard;
    }
    bool opaque = texelFetch(surfaces, pixel, 0).z < 0.0;
    vec4 lobe = texelFetch(lobes, pixel, 0);
    vec4 base = texelFetch(bases, pixel, 0);
    float ior = texelFetch(emissions, pixel, 0).w;
    float dielectric = (ior - 1.0) / (ior + 1.0);
    vec3 f0 = vec3(dielectric * dielectric);
    vec3 diffuse = vec3(0.0);
    if (opaque) {
        f0 = mix(f0, base.rgb, base.a);
        diffuse = base.rgb * (1.0 - base.a) * (1.0 - dielectric * dielectric) / 3.14159265 * cosine;
    }
    vec3 v = directionToEye(position.xyz);
    vec3 lobeValue = specular != 0 ? ggxLobe(lobe.xyz, v, toLight, lobe.w, f0) : vec3(0.0);
    radiance = vec4((diffuse + lobeValue) * H * reached, 0.0);
}
