// The deformed surface, from the camera (CAMERA) or from a light.
#include "include/bounds.glsl"
#include "include/frame.glsl"
#include "include/light.glsl"

layout(location = 0) in vec3 inPosition; // mm
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec2 inUv1;
#ifdef VERTEX_COLORS
layout(location = 4) in vec4 inColor;
#endif

out SurfacePoint {
    vec3 position;
    vec3 normal;
    vec2 uv;
    vec2 uv1;
#ifdef VERTEX_COLORS
    vec4 color;
#endif
} surface;

void main() {
    surface.position = inPosition;
    surface.normal = inNormal;
    surface.uv = inUv;
    surface.uv1 = inUv1;
#ifdef VERTEX_COLORS
    surface.color = inColor;
#endif
#ifdef CAMERA
    gl_Position = frame.viewProjection * vec4(inPosition, 1.0);
    if (frame.eye.w < 0.5) {
        // Orthographic: depth from 1 to 0 over the scene, a hair wider, so that rounding clips nothing.
        float beyond = dot(inPosition - bounds.scene.xyz, frame.forward.xyz);
        gl_Position.z = 0.5 - 0.5 * beyond / max(1.001 * bounds.scene.w, 1e-6);
    }
#else
    gl_Position = light.viewProjection * vec4(inPosition, 1.0);
#endif
}
