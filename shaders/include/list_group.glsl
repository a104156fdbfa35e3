// One invocation for each element of a list (gl::Program::dispatchList), which may have more groups than fit in a row.
#include "include/group_sizes.glsl"

layout(local_size_x = kListGroup) in;

int listIndex() {
    return int(gl_GlobalInvocationID.x + gl_NumWorkGroups.x * kListGroup * gl_GlobalInvocationID.y);
}
