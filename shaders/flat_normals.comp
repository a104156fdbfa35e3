// Gives the three vertices of each triangle, which are its own, the normal of its face.
#include "include/list_group.glsl"

layout(location = 0) uniform int count; // triangles
layout(location = 1) uniform int stride;

layout(std430, binding = 0) restrict buffer Drawn { float drawn[]; };
layout(std430, binding = 1) restrict readonly buffer Indices { uint indices[]; };

vec3 positionOf(uint vertex) {
    int at = int(vertex) * stride;
    return vec3(drawn[at], drawn[at + 1], drawn[at + 2]);
}

void main() {
    int i = listIndex();
    if (i >= count) {
        return;
    }
    vec3 a = positionOf(indices[3 * i]);
    vec3 u = positionOf(indices[3 * i + 1]) - a;
    vec3 v = positionOf(indices[3 * i + 2]) - a;
    float longest = max(max(dot(u, u), dot(v, v)), 1e-30);
    vec3 normal = cross(u, v) / longest; // of small triangles, squares would vanish
    float squared = dot(normal, normal);
    normal = squared > 0.0 ? normal * inversesqrt(squared) : vec3(0.0);
    for (int corner = 0; corner < 3; ++corner) {
        int at = int(indices[3 * i + corner]) * stride + 3;
        drawn[at] = normal.x;
        drawn[at + 1] = normal.y;
        drawn[at + 2] = normal.z;
    }
}
