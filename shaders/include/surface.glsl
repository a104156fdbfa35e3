// What the passes that draw the surface know of a fragment, and of its mesh; and whether there is surface at all.
layout(location = 0) uniform ivec4 meshInfo; // scattering material or -1, double sided, mesh id + 1, 0
layout(location = 1) uniform vec4 baseColor;
layout(location = 4) uniform ivec4 textureSets; // uv set of base color, metallic-roughness, normal, emission: -1 none
layout(location = 5) uniform float alphaCutoff; // there is no surface where alpha is below it; -1: nowhere
layout(location = 6) uniform mat3 textureTransforms[4];

layout(binding = 0) uniform sampler2D baseColorTexture; // sRGB

// Which textures any mesh of the scene has: others are left out, since software drivers look up what no branch takes.
#ifndef LOOK_TEXTURES
#define LOOK_TEXTURES bvec4(true)
#endif
bool hasTexture(int index) { return LOOK_TEXTURES[index] && textureSets[index] >= 0; }

vec2 textureCoordinate(int index, vec2 uv, vec2 uv1) {
    return (textureTransforms[index] * vec3(textureSets[index] == 1 ? uv1 : uv, 1.0)).xy;
}

#include "include/drawn_surface.glsl"
#include "include/seen_surface.glsl"

// A texture of the look, where textureSets has it.
vec4 lookTexture(sampler2D image, int index) {
    vec2 place = textureCoordinate(index, surface.uv, surface.uv1);
#ifdef VISIBLE_TRIANGLES
    mat2 steps = textureSteps(index);
    return textureGrad(image, place, steps[0], steps[1]);
#else
    return texture(image, place);
#endif
}

#ifdef CUT_OUT
// By the finest level of the texture: what is there must not depend on who looks. renderer/reference/cut_out.cpp
// says the same to rays.
bool isThere(vec2 uv, vec2 uv1, float vertexAlpha) {
    float alpha = baseColor.a * vertexAlpha;
    if (hasTexture(0)) {
        alpha *= textureLod(baseColorTexture, textureCoordinate(0, uv, uv1), 0.0).a;
    }
    return alpha >= alphaCutoff;
}
#endif

// Of the base color.
vec4 vertexColor() {
#ifdef VERTEX_COLORS
    return surface.color;
#else
    return vec4(1.0);
#endif
}

// Last in main: derivatives taken after a discard are undefined.
void cutOut() {
#if defined(CUT_OUT) && !defined(VISIBLE_TRIANGLES)
    if (alphaCutoff >= 0.0 && !isThere(surface.uv, surface.uv1, vertexColor().a)) {
        discard;
    }
#endif
}

// The shading normal, or its opposite. A degenerate interpolated normal falls back to the face's.
vec3 facingNormal(bool flip) {
    vec3 n = surface.normal;
    float squared = dot(n, n);
    if (!(squared > 1e-12)) {
        n = faceNormal();
        squared = max(dot(n, n), 1e-30);
    }
    n *= inversesqrt(squared);
    return flip ? -n : n;
}

// The side of the shading normal that the eye sees: of a back face the other one. Not where the triangle is wound against
// its neighbors, as slivers of scans are: the normals of its corners face the eye there.
vec3 seenNormal(vec3 toEye) {
    vec3 n = facingNormal(false);
    return frontFacing || dot(n, toEye) > 0.0 ? n : -n;
}
