// The surface at a pixel of which the processor knows what triangle it sees; drawn as one triangle over the picture for
// each mesh.
#include "include/visible_triangle.glsl"

#ifdef VISIBLE_TRIANGLES
layout(location = 10) uniform ivec4 meshPlace; // see MeshPlace
layout(location = 11) uniform mat4 toClip;
layout(location = 12) uniform vec2 pictureSize; // pixels

layout(binding = 15) uniform usampler2D triangles; // number + 1; 0: nothing is seen

struct SurfacePoint {
    vec3 position;
    vec3 normal;
    vec2 uv;
    vec2 uv1;
#ifdef VERTEX_COLORS
    vec4 color;
#endif
} surface;

bool frontFacing;
ivec3 seenVertices;
mat3 seenPositions;
mat3 seenCorners; // cornersInClip

vec2 ndcAt(vec2 place) { return 2.0 * place / pictureSize - 1.0; }

// Whether this mesh is seen; sets all of the above.
bool seesSurface() {
    int triangle = int(texelFetch(triangles, ivec2(gl_FragCoord.xy), 0).r) - 1;
    MeshPlace mesh = MeshPlace(meshPlace.x, meshPlace.y, meshPlace.z, meshPlace.w);
    if (triangle < mesh.firstTriangle || triangle >= mesh.beyondTriangles) {
        return false;
    }
    seenVertices = verticesOf(triangle, mesh);
    seenPositions = positionsOf(seenVertices);
    seenCorners = cornersInClip(toClip, seenPositions);
    vec4 weights = weightsInside(seenCorners, ndcAt(gl_FragCoord.xy));
    frontFacing = weights.w > 0.0;
    surface.position = seenPositions * weights.xyz;
    surface.normal = normalsOf(seenVertices) * weights.xyz;
    surface.uv = texturePlacesOf(seenVertices, 0) * weights.xyz;
    surface.uv1 = texturePlacesOf(seenVertices, 1) * weights.xyz;
#ifdef VERTEX_COLORS
    surface.color = texelFetch(vertexColors, seenVertices.x) * weights.x
                    + texelFetch(vertexColors, seenVertices.y) * weights.y
                    + texelFetch(vertexColors, seenVertices.z) * weights.z;
#endif
    return true;
}

// Weights of the triangle's plane one pixel to the right and one up.
mat2x3 weightsBeside() {
    return mat2x3(weightsAt(seenCorners, ndcAt(gl_FragCoord.xy + vec2(1.0, 0.0))).xyz,
                  weightsAt(seenCorners, ndcAt(gl_FragCoord.xy + vec2(0.0, 1.0))).xyz);
}

// Changes from a pixel to the next, to the right and up.
mat2x3 positionSteps() {
    mat2x3 weights = weightsBeside();
    return mat2x3(seenPositions * weights[0] - surface.position, seenPositions * weights[1] - surface.position);
}

mat2 textureSteps(int index) {
    mat2x3 weights = weightsBeside();
    mat3x2 uv = texturePlacesOf(seenVertices, 0);
    mat3x2 uv1 = texturePlacesOf(seenVertices, 1);
    vec2 here = textureCoordinate(index, surface.uv, surface.uv1);
    return mat2(textureCoordinate(index, uv * weights[0], uv1 * weights[0]) - here,
                textureCoordinate(index, uv * weights[1], uv1 * weights[1]) - here);
}

// Of the front, any length.
vec3 faceNormal() { return cross(seenPositions[1] - seenPositions[0], seenPositions[2] - seenPositions[0]); }
#endif
