// Antialiasing, first pass: a pixel all of whose samples show what its center shows keeps its radiance.
// The others, at silhouettes and where the surface is seen so slantingly that its Fresnel term changes
// within a pixel, are listed for coverage_edge.comp.
#include "include/coverage.glsl"
#include "include/covered_group.glsl"

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(color)))) {
        return;
    }
    vec4 position = texelFetch(positions, pixel, 0);
    vec4 normal = texelFetch(normals, pixel, 0);
    bool covered = position.w > 0.0;
    float facing = dot(normal.xyz, directionToEye(position.xyz));
    // A sample's plane may pass one pixel beside the center's, along the ray.
    float slack = pixelWidthMm(position.w) / max(abs(facing), 0.05);
    int same = 0;
    for (int i = 0; i < sampleCount; ++i) {
        vec2 s = sampleAt(pixel, i);
        bool alike = covered ? s.y == normal.w && abs(s.x - position.w) < slack : s.x <= 0.0;
        same += alike ? 1 : 0;
    }
    if (same == sampleCount && (!covered || facing > slanting)) {
        vec4 own = covered ? vec4(texelFetch(radiance, pixel, 0).rgb, 1.0) : vec4(0.0);
        addColor(pixel, own * (jitterAndWeight.z * float(sampleCount)));
        return;
    }
    listPixel(pixel);
}
