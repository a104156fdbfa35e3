// The surface at a fragment that the driver made of a triangle (surface.vert).
#ifndef VISIBLE_TRIANGLES
in SurfacePoint {
    vec3 position;
    vec3 normal;
    vec2 uv;
    vec2 uv1;
#ifdef VERTEX_COLORS
    vec4 color;
#endif
} surface;

#define frontFacing gl_FrontFacing

bool seesSurface() { return true; }

// Changes from a pixel to the next, to the right and up.
mat2x3 positionSteps() { return mat2x3(dFdx(surface.position), dFdy(surface.position)); }
mat2 textureSteps(int index) {
    vec2 place = textureCoordinate(index, surface.uv, surface.uv1);
    return mat2(dFdx(place), dFdy(place));
}

// Of the front, any length.
vec3 faceNormal() {
    vec3 n = cross(dFdx(surface.position), dFdy(surface.position));
    return gl_FrontFacing ? n : -n;
}
#endif
