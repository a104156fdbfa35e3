// One invocation for each pixel of a picture where something is seen, and for others (CoveredTiles).
#include "include/picture_group.glsl"

#ifdef VISIBLE_TRIANGLES
layout(std430, binding = 6) restrict readonly buffer CoveredTiles { uint coveredTiles[]; }; // x + 65536 y
#endif

ivec2 coveredPixel() {
#ifdef VISIBLE_TRIANGLES
    uint tile = coveredTiles[gl_WorkGroupID.x];
    return ivec2(tile % 65536u, tile / 65536u) * ivec2(gl_WorkGroupSize.xy) + ivec2(gl_LocalInvocationID.xy);
#else
    return ivec2(gl_GlobalInvocationID.xy);
#endif
}
