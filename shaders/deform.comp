// Moves the vertices of one mesh: by its joints or its node, then through the deformers, into the
// buffer that the light and the camera passes draw from.
#include "include/deformer.glsl"

layout(local_size_x = 64) in;

layout(location = 0) uniform ivec4 counts; // vertices; influences each, 0: one matrix for all; deformers; flags
const int kHasMap = 1;    // vertices are numbered anew
const int kHasMiters = 2;
layout(location = 1) uniform int stride;   // floats of a drawn vertex

struct Influence {
    uint joint;
    float weight;
};

layout(std430, binding = 0) restrict readonly buffer Bound { float bound[]; }; // position and normal
layout(std430, binding = 1) restrict readonly buffer Map { uint map[]; };
layout(std430, binding = 2) restrict readonly buffer Influences { Influence influences[]; };
layout(std430, binding = 3) restrict readonly buffer Matrices { mat4 matrices[]; };
layout(std430, binding = 4) restrict writeonly buffer Drawn { float drawn[]; };
layout(std430, binding = 5) restrict readonly buffer Deformers { Deformer deformers[]; };
layout(std430, binding = 6) restrict readonly buffer Miters { float miters[]; };

mat4 matrixOf(int vertex) {
    if (counts.y == 0) {
        return matrices[0];
    }
    mat4 matrix = mat4(0.0);
    for (int k = 0; k < counts.y; ++k) {
        Influence influence = influences[vertex * counts.y + k];
        if (influence.weight > 0.0) {
            matrix += influence.weight * matrices[influence.joint];
        }
    }
    return matrix;
}

void main() {
    int i = int(gl_GlobalInvocationID.x + gl_NumWorkGroups.x * 64u * gl_GlobalInvocationID.y);
    if (i >= counts.x) {
        return;
    }
    int source = (counts.w & kHasMap) != 0 ? int(map[i]) : i;
    mat4 matrix = matrixOf(source);
    mat3 carrier = cofactors(mat3(matrix)) * (determinant(mat3(matrix)) < 0.0 ? -1.0 : 1.0);
    vec3 position =
        (matrix * vec4(bound[6 * source], bound[6 * source + 1], bound[6 * source + 2], 1.0)).xyz;
    vec3 normal = directionOr(
        carrier * vec3(bound[6 * source + 3], bound[6 * source + 4], bound[6 * source + 5]), vec3(0.0));
    vec3 miter = vec3(0.0);
    if ((counts.w & kHasMiters) != 0) {
        miter = vec3(miters[3 * i], miters[3 * i + 1], miters[3 * i + 2]);
        miter = length(miter) * directionOr(carrier * miter, vec3(0.0));
    }
    for (int k = 0; k < counts.z; ++k) {
        deform(deformers[k], position, normal, miter);
    }
    for (int k = 0; k < 3; ++k) {
        drawn[i * stride + k] = position[k];
        drawn[i * stride + 3 + k] = normal[k];
    }
}
