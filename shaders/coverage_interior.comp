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
    if (position.w <= 0.0 && showNothing(pixel)) {
        addColor(pixel, vec4(0.0));
        return;
    }
    float facing = dot(normal.xyz, directionToEye(position.xyz));
    // A sample's plane may pass one pixel beside the center's, along the ray.
    float slack = pixelWidthMm(position.w) / max(abs(facing), 0.05);
    if (position.w > 0.0 && facing > slanting && showAll(pixel, normal.w, position.w, slack)) {
        addColor(pixel, vec4(texelFetch(radiance, pixel, 0).rgb, 1.0) * (jitterAndWeight.z * float(sampleCount)));
        return;
    }
    listPixel(pixel);
}
