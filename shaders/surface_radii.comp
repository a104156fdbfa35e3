// R_P of what a level of the splatting buffer shows, anew: all in it that changes where only profiles do.
#include "include/material.glsl"
#include "include/covered_group.glsl"

layout(rgba32f, binding = 0) uniform image2D surfaces;

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(surfaces)))) {
        return;
    }
    vec4 s = imageLoad(surfaces, pixel);
    if (s.z >= 0.0) {
        imageStore(surfaces, pixel, vec4(s.xyz, materialRadii(int(s.z), s.xy).x));
    }
}
