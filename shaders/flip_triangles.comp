// Turns every triangle over: a pose mirrored its mesh.
#include "include/list_group.glsl"

layout(location = 0) uniform int count;

layout(std430, binding = 0) restrict buffer Indices { uint indices[]; };

void main() {
    int i = listIndex();
    if (i < count) {
        uint second = indices[3 * i + 1];
        indices[3 * i + 1] = indices[3 * i + 2];
        indices[3 * i + 2] = second;
    }
}
