// Moves the vertices of one mesh: by its joints or its node, then through the deformers, into the
// buffer that the light and the camera passes draw from.
#include "include/vertex_pose.glsl"
#include "include/deformer.glsl"
#include "include/list_group.glsl"

layout(location = 0) uniform ivec4 counts; // vertices; influences each, 0: one matrix for all; deformers; flags
layout(location = 1) uniform int stride;   // floats of a drawn vertex

layout(std430, binding = 4) restrict writeonly buffer Drawn { float drawn[]; };
layout(std430, binding = 6) restrict readonly buffer Miters { float miters[]; };
// (7: include/lattice.glsl)

void main() {
    int i = listIndex();
    if (i >= counts.x) {
        return;
    }
    int source = (counts.w & kHasMap) != 0 ? int(map[i]) : i;
    bool isHandled = (counts.w & kIsHandled) != 0;
    int at = isHandled ? 9 * i : 6 * source;
    mat4 matrix = matrixOf(source, counts.y);
    mat3 carrier = cofactors(mat3(matrix)) * (determinant(mat3(matrix)) < 0.0 ? -1.0 : 1.0);
    vec3 position = (matrix * vec4(bound[at], bound[at + 1], bound[at + 2], 1.0)).xyz;
    vec3 normal = directionOr(carrier * vec3(bound[at + 3], bound[at + 4], bound[at + 5]), vec3(0.0));
    vec3 miter = vec3(0.0);
    if ((counts.w & kHasMiters) != 0) {
        miter = isHandled ? vec3(bound[at + 6], bound[at + 7], bound[at + 8])
                          : vec3(miters[3 * i], miters[3 * i + 1], miters[3 * i + 2]);
        miter = length(miter) * directionOr(carrier * miter, vec3(0.0));
    }
    for (int k = 0; k < counts.z; ++k) {
        deform(deformerAt(k), position, normal, miter);
    }
    for (int k = 0; k < 3; ++k) {
        drawn[i * stride + k] = position[k];
        drawn[i * stride + 3 + k] = normal[k];
    }
}
