// What the passes that draw the surface know of a fragment, and of its mesh; and whether there is surface at all.
in SurfacePoint {
    vec3 position;
    vec3 normal;
    vec2 uv;
    vec2 uv1;
#ifdef VERTEX_COLORS
    vec4 color;
#endif
} surface;

layout(location = 0) uniform ivec4 meshInfo; // scattering material or -1, double sided, mesh id + 1, 0
layout(location = 1) uniform vec4 baseColor;
layout(location = 4) uniform ivec4 textureSets; // uv set of base color, metallic-roughness, normal, emission: -1 none
layout(location = 5) uniform float alphaCutoff; // there is no surface where alpha is below it; -1: nowhere
layout(location = 6) uniform mat3 textureTransforms[4];

layout(binding = 0) uniform sampler2D baseColorTexture; // sRGB

vec2 textureCoordinate(int index, vec2 uv, vec2 uv1) {
    return (textureTransforms[index] * vec3(textureSets[index] == 1 ? uv1 : uv, 1.0)).xy;
}

#ifdef CUT_OUT
// By the finest level of the texture: what is there must not depend on who looks. renderer/reference/cut_out.cpp
// says the same to rays.
bool isThere(vec2 uv, vec2 uv1, float vertexAlpha) {
    float alpha = baseColor.a * vertexAlpha;
    if (textureSets.x >= 0) {
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
#ifdef CUT_OUT
    if (alphaCutoff >= 0.0 && !isThere(surface.uv, surface.uv1, vertexColor().a)) {
        discard;
    }
#endif
}

// The shading normal on the side that is seen. A degenerate interpolated normal falls back to the face's.
vec3 facingNormal(bool flip) {
    vec3 n = surface.normal;
    float squared = dot(n, n);
    if (!(squared > 1e-12)) {
        n = cross(dFdx(surface.position), dFdy(surface.position));
        squared = max(dot(n, n), 1e-30);
        n *= gl_FrontFacing ? 1.0 : -1.0;
    }
    n *= inversesqrt(squared);
    return flip ? -n : n;
}
