// What the passes that draw the surface know of a fragment, of its mesh, and of its base color, whose alpha
// may cut it out.
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
layout(location = 4) uniform ivec4 textureSets; // uv set of base, metallic-roughness, normal, emission: -1 none
layout(location = 5) uniform float alphaCutoff; // -1: none
layout(location = 6) uniform mat3 textureTransforms[4];

layout(binding = 0) uniform sampler2D baseColorTexture; // sRGB

vec2 textureCoordinate(int index) {
    vec2 uv = textureSets[index] == 1 ? surface.uv1 : surface.uv;
    return (textureTransforms[index] * vec3(uv, 1.0)).xy;
}

// Base color and alpha, linear.
vec4 surfaceColor() {
    vec4 color = baseColor;
    if (textureSets.x >= 0) {
        color *= texture(baseColorTexture, textureCoordinate(0));
    }
#ifdef VERTEX_COLORS
    color *= surface.color;
#endif
    return color;
}

// Leaves no fragment where the surface is cut out. First in main: derivatives must be uniform.
void cutOut() {
#ifdef CUT_OUT
    if (surfaceColor().a < alphaCutoff) {
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
