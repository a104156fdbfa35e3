#include "include/blocks.glsl"

layout(std140, binding = 0) uniform FrameUniforms { FrameBlock frame; };

// Width in mm of a pixel of level 0 at view depth z.
float pixelWidthMm(float depth) { return depth * frame.projection.z + frame.projection.w; }

// Unit direction from a surface point towards the eye.
vec3 directionToEye(vec3 position) {
    return frame.eye.w > 0.5 ? normalize(frame.eye.xyz - position) : -frame.forward.xyz;
}
