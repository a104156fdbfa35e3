// Triangles that the processor found to be seen (renderer/raster), and what they are at a pixel.
#ifdef VISIBLE_TRIANGLES
layout(binding = 12) uniform samplerBuffer vertexPairs;    // position in mm and normal (three pairs), uv, uv1
layout(binding = 13) uniform usamplerBuffer cornerVertices; // of the mesh's own vertices
layout(binding = 14) uniform samplerBuffer vertexColors;

const int kVertexPairs = 5;

// Where a mesh is in these buffers.
struct MeshPlace {
    int firstTriangle; // counted through all meshes
    int firstVertex;
    int firstCorner;
    int beyondTriangles; // the first that is not of the mesh
};

// Numbers of the vertices of a triangle.
ivec3 verticesOf(int triangle, MeshPlace place) {
    int corner = place.firstCorner + 3 * (triangle - place.firstTriangle);
    return place.firstVertex + ivec3(texelFetch(cornerVertices, corner).r, texelFetch(cornerVertices, corner + 1).r,
                                     texelFetch(cornerVertices, corner + 2).r);
}

vec2 vertexPair(int vertex, int pair) { return texelFetch(vertexPairs, vertex * kVertexPairs + pair).rg; }
vec3 vertexPosition(int vertex) { return vec3(vertexPair(vertex, 0), vertexPair(vertex, 1).x); }
vec3 vertexNormal(int vertex) { return vec3(vertexPair(vertex, 1).y, vertexPair(vertex, 2)); }

mat3 positionsOf(ivec3 v) { return mat3(vertexPosition(v.x), vertexPosition(v.y), vertexPosition(v.z)); }
mat3 normalsOf(ivec3 v) { return mat3(vertexNormal(v.x), vertexNormal(v.y), vertexNormal(v.z)); }
mat3x2 texturePlacesOf(ivec3 v, int uvSet) {
    return mat3x2(vertexPair(v.x, 3 + uvSet), vertexPair(v.y, 3 + uvSet), vertexPair(v.z, 3 + uvSet));
}

// Corners of a triangle in the clip space's x, y, w.
mat3 cornersInClip(mat4 toClip, mat3 positions) {
    mat4x3 rows = mat4x3(toClip[0].xyw, toClip[1].xyw, toClip[2].xyw, toClip[3].xyw);
    return mat3(rows * vec4(positions[0], 1.0), rows * vec4(positions[1], 1.0), rows * vec4(positions[2], 1.0));
}

float crossProduct(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Barycentric coordinates, right in perspective, of what the ray through a place of the picture sees of a triangle's
// plane: the weights with which the corners, seen from the ray, cancel out. fourth: above 0 where it is the front.
vec4 weightsAt(mat3 corners, vec2 ndc) {
    vec2 a = corners[0].xy - ndc * corners[0].z;
    vec2 b = corners[1].xy - ndc * corners[1].z;
    vec2 c = corners[2].xy - ndc * corners[2].z;
    vec3 weights = vec3(crossProduct(b, c), crossProduct(c, a), crossProduct(a, b));
    float sum = weights.x + weights.y + weights.z;
    return sum != 0.0 ? vec4(weights / sum, sum) : vec4(vec3(1.0 / 3.0), 0.0);
}

// The same, kept inside: a pixel's center may lie a hair beside the triangle that was found there.
vec4 weightsInside(mat3 corners, vec2 ndc) {
    vec4 weights = weightsAt(corners, ndc);
    vec3 inside = max(weights.xyz, 0.0);
    return vec4(inside / (inside.x + inside.y + inside.z), weights.w);
}
#endif
