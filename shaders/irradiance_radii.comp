// What irradiance_buffer.frag looks up in the materials' tables, anew: all of a light view that changes where
// only profiles do.
#include "include/material.glsl"
#include "include/picture_group.glsl"

layout(binding = 0) uniform sampler2D surfaces; // of the light view

layout(rgba32f, binding = 0) uniform writeonly image2D extents; // 0, 0, R_P, R_cut
layout(rgba32f, binding = 1) uniform writeonly image2D kepts;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(extents)))) {
        return;
    }
    vec4 s = texelFetch(surfaces, texel, 0);
    vec3 radii = vec3(0.0);
    vec3 kept = vec3(1.0);
    if (s.w > 0.5) {
        radii = materialRadii(int(s.z), s.xy);
        kept = keptEnergy(int(s.z), s.xy);
    }
    imageStore(extents, texel, vec4(0.0, 0.0, radii.xy));
    imageStore(kepts, texel, vec4(kept, radii.z));
}
