// Splatting buffer, level 0 (Chen et al. 2012, section 4): the object from the camera, and the looks
// that shading needs later. With COVERAGE only what antialiasing compares.
#include "include/frame.glsl"
#include "include/material.glsl"
#include "include/surface.glsl"

layout(location = 1) out vec4 outNormal;   // xyz towards the viewer, mesh id + 1
#ifdef COVERAGE
layout(location = 0) out vec2 outDepth; // view depth in mm (0: background), mesh id + 1
#else
layout(location = 0) out vec4 outPosition; // xyz mm, view depth in mm (0: background)
layout(location = 2) out vec4 outSurface;  // u, v, material (-1: opaque), R_P in mm
layout(location = 3) out vec4 outLobe;     // normal of the specular lobe, roughness
layout(location = 4) out vec4 outBase;     // base color (linear), metallic; scattering: a weighs the lobe
layout(location = 5) out vec4 outEmission; // emitted radiance, index of refraction of the lobe

layout(location = 2) uniform vec4 lobe; // metallic, roughness, index of refraction or 0, normal scale
layout(location = 3) uniform vec3 emission;

layout(binding = 1) uniform sampler2D metallicRoughnessTexture;
layout(binding = 2) uniform sampler2D normalTexture;
layout(binding = 3) uniform sampler2D emissionTexture; // sRGB

// Tangent frame from the derivatives of position and texture coordinate.
vec3 mappedNormal(vec3 n) {
    mat2x3 positionStep = positionSteps();
    mat2 step = textureSteps(2);
    float determinant = step[0].x * step[1].y - step[0].y * step[1].x;
    if (abs(determinant) < 1e-20) {
        return n;
    }
    vec3 t = (positionStep[0] * step[1].y - positionStep[1] * step[0].y) * sign(determinant);
    vec3 b = (positionStep[1] * step[0].x - positionStep[0] * step[1].x) * sign(determinant);
    t -= n * dot(n, t);
    b -= n * dot(n, b);
    if (dot(t, t) < 1e-20 || dot(b, b) < 1e-20) {
        return n;
    }
    vec3 m = lookTexture(normalTexture, 2).xyz * 2.0 - 1.0;
    m.xy *= lobe.w;
    m.y = -m.y; // v runs down: the map's green points up, against v
    vec3 mapped = normalize(t) * m.x + normalize(b) * m.y + n * m.z;
    return dot(mapped, mapped) > 1e-12 ? normalize(mapped) : n;
}
#endif

void main() {
    if (!seesSurface()) {
        discard;
    }
    vec3 n = seenNormal(directionToEye(surface.position)); // both sides are seen
    float depth = -(frame.view * vec4(surface.position, 1.0)).z;
    outNormal = vec4(n, float(meshInfo.z));
#ifdef COVERAGE
    outDepth = vec2(depth, float(meshInfo.z));
#ifdef CUT_OUT
    if (alphaCutoff >= 0.0) { // holes have smooth rims: each sample is there or not
        int there = 0;
        for (int i = 0; i < gl_NumSamples; ++i) {
#ifdef VERTEX_COLORS
            float vertexAlpha = interpolateAtSample(surface.color, i).a;
#else
            float vertexAlpha = 1.0;
#endif
            bool isSample = isThere(interpolateAtSample(surface.uv, i), interpolateAtSample(surface.uv1, i), vertexAlpha);
            there |= isSample ? 1 << i : 0;
        }
        gl_SampleMask[0] = there;
    } else {
        gl_SampleMask[0] = -1;
    }
#endif
#else
    int m = meshInfo.x;
    outPosition = vec4(surface.position, depth);
    outSurface = vec4(surface.uv, float(m), m >= 0 ? materialRadii(m, surface.uv).x : 0.0);
    vec3 specularNormal = hasTexture(2) ? mappedNormal(n) : n;
    vec2 metallicRoughness = lobe.xy;
    if (hasTexture(1)) {
        vec4 texel = lookTexture(metallicRoughnessTexture, 1);
        metallicRoughness *= texel.bg;
    }
    vec4 base = baseColor * vertexColor();
    if (hasTexture(0)) {
        base *= lookTexture(baseColorTexture, 0);
    }
    if (m >= 0) {
        vec2 painted = materialLobe(m, surface.uv); // over what the model says
        metallicRoughness = vec2(painted.y >= 0.0 ? painted.y : 1.0, painted.x >= 0.0 ? painted.x : metallicRoughness.y);
    }
    float ior = lobe.z > 0.0 ? lobe.z : (m >= 0 ? materials[max(m, 0)].profile.z : 1.5);
    outLobe = vec4(specularNormal, metallicRoughness.y);
    outBase = vec4(base.rgb, metallicRoughness.x);
    vec3 emitted = emission;
    if (hasTexture(3)) {
        emitted *= lookTexture(emissionTexture, 3).rgb;
    }
    outEmission = vec4(min(emitted, 65504.0), ior); // the largest half
    cutOut();
#endif
}
