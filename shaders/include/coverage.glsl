#include "include/frame.glsl"
#include "include/bounds.glsl"
#include "include/listed_pixels.glsl"
#include "include/visible_triangle.glsl"

// What the two passes of antialiasing share: a pixel's center, and the samples of one draw about it.
layout(location = 0) uniform vec3 jitterAndWeight;  // of this draw, in pixels (x, y); 1 / all samples
layout(location = 1) uniform int sampleCount;       // of this draw
layout(location = 2) uniform vec2 samplePlaces[16]; // from the pixel's center, in pixels
layout(location = 18) uniform bool isFirst;         // nothing of this picture is in `color` yet

layout(binding = 0) uniform sampler2D positions; // pixel centers
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D radiance;

layout(rgba32f, binding = 0) uniform image2D color; // premultiplied; alpha is coverage

void addColor(ivec2 pixel, vec4 added) {
    imageStore(color, pixel, isFirst ? added : imageLoad(color, pixel) + added);
}

#ifdef VISIBLE_TRIANGLES
layout(binding = 3) uniform usampler2DArray sampleTriangles; // [sample]: number + 1; 0: nothing
layout(binding = 4) uniform sampler2DArray sampleDepths;     // over w, of the triangle's plane at the pixel's center
layout(binding = 5) uniform sampler2D sampleRanges;          // of these depths; 0: nothing is seen, -1: not the same in all
layout(std430, binding = 1) restrict readonly buffer MeshPlaces { MeshPlace meshPlaces[]; };

// See surface.vert.
float viewDepth(float z) {
    if (frame.eye.w > 0.5) {
        return frame.viewProjection[3].z / z;
    }
    float beyond = (1.0 - 2.0 * z) * max(1.001 * bounds.scene.w, 1e-6);
    return beyond - (frame.view * vec4(bounds.scene.xyz, 1.0)).z;
}

int meshOf(int triangle) {
    int low = 0;
    int beyond = meshPlaces.length();
    while (beyond - low > 1) {
        int middle = (low + beyond) / 2;
        if (triangle < meshPlaces[middle].firstTriangle) {
            beyond = middle;
        } else {
            low = middle;
        }
    }
    return low;
}
#else
layout(binding = 3) uniform sampler2DMS samples; // sampleAt()
layout(binding = 4) uniform sampler2DMS sampleNormals;
#endif

// View depth of a sample's surface, of its plane at the pixel's center, and mesh id + 1; 0, 0: nothing is there.
vec2 sampleAt(ivec2 pixel, int i) {
#ifdef VISIBLE_TRIANGLES
    int triangle = int(texelFetch(sampleTriangles, ivec3(pixel, i), 0).r) - 1;
    if (triangle < 0) {
        return vec2(0.0);
    }
    return vec2(viewDepth(texelFetch(sampleDepths, ivec3(pixel, i), 0).r), float(meshOf(triangle) + 1));
#else
    return texelFetch(samples, pixel, i).xy;
#endif
}

// Whether all samples show one mesh, at a view depth near the given one.
bool showAll(ivec2 pixel, float mesh, float depth, float slack) {
#ifdef VISIBLE_TRIANGLES
    vec2 range = texelFetch(sampleRanges, pixel, 0).rg;
    float shown = float(meshOf(int(texelFetch(sampleTriangles, ivec3(pixel, 0), 0).r) - 1) + 1);
    return range.x > 0.0 && shown == mesh && abs(viewDepth(range.x) - depth) < slack && abs(viewDepth(range.y) - depth) < slack;
#else
    int same = 0;
    for (int i = 0; i < sampleCount; ++i) {
        vec2 s = sampleAt(pixel, i);
        same += s.y == mesh && abs(s.x - depth) < slack ? 1 : 0;
    }
    return same == sampleCount;
#endif
}

// Whether no sample shows anything.
bool showNothing(ivec2 pixel) {
#ifdef VISIBLE_TRIANGLES
    return texelFetch(sampleRanges, pixel, 0).g == 0.0;
#else
    bool isEmpty = true;
    for (int i = 0; i < sampleCount; ++i) {
        isEmpty = isEmpty && sampleAt(pixel, i).x <= 0.0;
    }
    return isEmpty;
#endif
}

// Towards the viewer, at the pixel's center; of a sample that shows something. As seenNormal() in surface.glsl.
vec3 sampleNormal(ivec2 pixel, int i, vec3 toEye) {
#ifdef VISIBLE_TRIANGLES
    int triangle = int(texelFetch(sampleTriangles, ivec3(pixel, i), 0).r) - 1;
    ivec3 v = verticesOf(triangle, meshPlaces[meshOf(triangle)]);
    mat3 positions = positionsOf(v);
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / frame.frameSize.xy - 1.0;
    vec4 weights = weightsAt(cornersInClip(frame.viewProjection, positions), ndc);
    vec3 n = normalsOf(v) * weights.xyz;
    n = dot(n, n) > 1e-12 ? n : cross(positions[1] - positions[0], positions[2] - positions[0]);
    return n * (inversesqrt(max(dot(n, n), 1e-30)) * (weights.w > 0.0 || dot(n, toEye) > 0.0 ? 1.0 : -1.0));
#else
    return texelFetch(sampleNormals, pixel, i).xyz;
#endif
}

const float slanting = 0.25; // cosine of normal and view below which a pixel center stands for little
