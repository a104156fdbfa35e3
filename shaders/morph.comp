// Adds one morph target, times its weight, to the vertices that it moves; each occurs once.
#include "include/list_group.glsl"

layout(location = 0) uniform int count;
layout(location = 1) uniform float weight;

layout(std430, binding = 0) restrict buffer Vertices { float vertices[]; };            // 6 each
layout(std430, binding = 1) restrict readonly buffer Moved { uint moved[]; };          // their numbers
layout(std430, binding = 2) restrict readonly buffer Changes { float changes[]; };     // 6 each

void main() {
    int i = listIndex();
    if (i >= count) {
        return;
    }
    int vertex = 6 * int(moved[i]);
    for (int k = 0; k < 6; ++k) {
        vertices[vertex + k] += weight * changes[6 * i + k];
    }
}
