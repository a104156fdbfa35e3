#include "include/frame.glsl"

// What the two passes of antialiasing share: a pixel's center, and the samples of one draw about it.
layout(location = 0) uniform vec3 jitterAndWeight;  // of this draw, in pixels (x, y); 1 / all samples
layout(location = 1) uniform int sampleCount;       // of this draw
layout(location = 2) uniform vec2 samplePlaces[16]; // from the pixel's center, in pixels

layout(binding = 0) uniform sampler2D positions; // pixel centers
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D radiance;
layout(binding = 3) uniform sampler2DMS samples; // view depth of the surface's plane at the pixel's center, mesh id + 1

layout(rgba32f, binding = 0) uniform image2D color; // premultiplied; alpha is coverage

const float slanting = 0.25; // cosine of normal and view below which a pixel center stands for little

// Pixels that the first pass leaves to the second, and their groups of kListGroup.
layout(std430, binding = 0) restrict buffer Edges {
    uint groups[3];
    uint edgeCount;
    uint edges[]; // x + 65536 y
};
