// What one light view adds at once, without scattering below the surface: the specular lobe of every
// surface, and the diffuse one of opaque parts; shadowed by the depths of the light's view.
#include "include/frame.glsl"
#include "include/light.glsl"
#include "include/ggx.glsl"
#include "include/look.glsl"

layout(location = 0) uniform int specular;    // 0: none
layout(location = 1) uniform int environment; // 1: a part of the map that environment_reflection.frag adds whole

layout(binding = 6) uniform sampler2D shadowMap; // reversed depth, 0 background

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec2 reached_; // of what the light adds to a broad lobe: the part that is not shadowed, all

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
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) { // of 4x4 texels a quarter
            vec4 depths = textureGather(shadowMap, (vec2(base) + 2.0 * vec2(x, y)) / float(N));
            vec2 wx = x == 0 ? vec2(1.0 - fraction.x, 1.0) : vec2(1.0, fraction.x);
            vec2 wy = y == 0 ? vec2(1.0 - fraction.y, 1.0) : vec2(1.0, fraction.y);
            lit += dot(vec4(lessThanEqual(depths, vec4(ndc.z))), wx.xyyx * wy.yyxx);
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
    Look look = lookAt(pixel);
    vec3 v = directionToEye(position.xyz);
    vec3 value = look.diffuse / 3.14159265 * cosine;
    if (specular != 0 && environment == 0) {
        value += look.weight * ggxLobe(look.normal, v, toLight, look.roughness, look.f0);
    }
    radiance = vec4(value * H * reached, 0.0);
    // Broad, so that some light is in it: how much of the environment a highlight sees changes slowly.
    float broad = ggxLobe(look.normal, v, toLight, max(look.roughness, 0.5), vec3(1.0)).r * (H.r + H.g + H.b);
    reached_ = vec2(reached, 1.0) * broad;
}
