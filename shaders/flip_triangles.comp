// Turns every triangle over: a pose mirrored its mesh.
layout(local_size_x = 64) in;

layout(location = 0) uniform int count;

layout(std430, binding = 0) restrict buffer Indices { uint indices[]; };

void main() {
    int i = int(gl_GlobalInvocationID.x + gl_NumWorkGroups.x * 64u * gl_GlobalInvocationID.y);
    if (i < count) {
        uint second = indices[3 * i + 1];
        indices[3 * i + 1] = indices[3 * i + 2];
        indices[3 * i + 2] = second;
    }
}
