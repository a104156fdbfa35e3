// What the two buffer passes know of a fragment, and of its mesh.
in SurfacePoint {
    vec3 position;
    vec3 normal;
    vec2 uv;
    vec2 uv1;
} surface;

layout(location = 0) uniform ivec4 meshInfo; // scattering material or -1, double sided, mesh id + 1, 0

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
