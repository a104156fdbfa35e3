// One mesh as its file has it, and the matrices of a pose: what deform.comp and handles.comp read.
struct Influence {
    uint joint;
    float weight;
};

layout(std430, binding = 0) restrict readonly buffer Bound { float bound[]; }; // position and normal
layout(std430, binding = 1) restrict readonly buffer Map { uint map[]; };
layout(std430, binding = 2) restrict readonly buffer Influences { Influence influences[]; };
layout(binding = 0) uniform samplerBuffer matrices; // four columns each; software drivers fetch texels several times as fast

// Flags of a mesh.
const int kHasMap = 1;    // vertices are numbered anew
const int kHasMiters = 2;
const int kIsHandled = 4; // handles.comp wrote position, normal and miter of each drawn vertex

mat4 matrixAt(int index) {
    return mat4(texelFetch(matrices, 4 * index), texelFetch(matrices, 4 * index + 1),
                texelFetch(matrices, 4 * index + 2), texelFetch(matrices, 4 * index + 3));
}

mat4 matrixOf(int vertex, int influenceCount) {
    if (influenceCount == 0) {
        return matrixAt(0);
    }
    mat4 matrix = mat4(0.0);
    for (int k = 0; k < influenceCount; ++k) {
        Influence influence = influences[vertex * influenceCount + k];
        if (influence.weight > 0.0) {
            matrix += influence.weight * matrixAt(int(influence.joint));
        }
    }
    return matrix;
}

vec3 directionOr(vec3 v, vec3 otherwise) {
    float squared = dot(v, v);
    return squared > 0.0 && !isinf(squared) ? v * inversesqrt(squared) : otherwise;
}

// Carries normals: the inverse transpose times the determinant.
mat3 cofactors(mat3 m) {
    return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
}
