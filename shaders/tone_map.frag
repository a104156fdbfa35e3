// From linear radiance to what a display shows: exposure, tone curve, background, sRGB encoding. The
// same as renderer/output/tone_map.cpp, which explains the curves.

layout(location = 0) uniform vec2 exposureAndCurve; // 2^EV; 0 neutral, 1 ACES, 2 none
layout(location = 1) uniform vec3 backgroundTop;    // linear display color
layout(location = 2) uniform vec3 backgroundBottom;
layout(location = 3) uniform int selectedMaterial; // whose selection is shown over the picture; -1: none

layout(binding = 0) uniform sampler2D radiance;  // premultiplied
layout(binding = 1) uniform sampler2D surfaces;  // u, v, material of each pixel
layout(binding = 2) uniform sampler2D selection; // weights over the material's map

layout(location = 0) in vec2 unitPosition;
layout(location = 0) out vec4 display;

// Khronos 2024, "Khronos PBR Neutral Tone Mapper".
vec3 neutral(vec3 color) {
    const float F90 = 0.04;
    const float start = 0.8 - F90;
    float x = min(color.r, min(color.g, color.b));
    float offset = x < 2.0 * F90 ? x - x * x / (4.0 * F90) : F90;
    color -= offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start) {
        return color;
    }
    float d = 1.0 - start;
    float newPeak = 1.0 - d * d / (peak + d - start);
    float towardsWhite = 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0);
    return mix(color * (newPeak / peak), vec3(newPeak), towardsWhite);
}

// Narkowicz 2015, with the exposure taken out.
vec3 aces(vec3 x) {
    x *= 0.6;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

vec3 encodeSrgb(vec3 x) {
    return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

void main() {
    vec4 texel = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0);
    vec3 color = vec3(0.0);
    if (texel.a > 0.0) {
        vec3 exposed = clamp(texel.rgb / texel.a * exposureAndCurve.x, vec3(0.0), vec3(1e15));
        int curve = int(exposureAndCurve.y);
        color = clamp(curve == 0 ? neutral(exposed) : curve == 1 ? aces(exposed) : exposed, 0.0, 1.0);
    }
    vec3 background = mix(backgroundBottom, backgroundTop, unitPosition.y);
    vec3 encoded = encodeSrgb(mix(background, color, clamp(texel.a, 0.0, 1.0)));
    if (selectedMaterial >= 0) {
        vec4 surface = texelFetch(surfaces, ivec2(gl_FragCoord.xy), 0);
        if (texel.a > 0.0 && int(surface.z) == selectedMaterial) {
            float weight = textureLod(selection, fract(surface.xy), 0.0).r;
            float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 12.0) < 0.5 ? 0.42 : 0.24;
            encoded = mix(encoded, vec3(0.45, 0.95, 0.70), stripe * weight);
        }
    }
    // A dark gradient in 8 bits shows bands: triangular noise of one step hides them.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    display = vec4(encoded + (noise - 0.5) / 255.0, 1.0);
}
