// The box of all drawn vertices, then the distance of the farthest one from its center, then the
// spheres that passes read; and how many vertices are not finite. Floats are kept as unsigned
// integers of the same order, for atomics.
#include "include/blocks.glsl"
#include "include/ordered_float.glsl"

layout(local_size_x = 64) in;

const int kPerInvocation = 32; // vertices: with gpu_deformation.cpp

layout(location = 0) uniform int count;
layout(location = 1) uniform int stride;
layout(location = 2) uniform ivec2 task; // 0: boxes, 1: distances, 2: spheres; also into the second entry (what scatters)

struct Bounds {
    uint low[3];
    uint high[3];
    uint farthest; // squared distance, of floats >= 0
    uint gone;
};

layout(std430, binding = 0) restrict readonly buffer Drawn { float drawn[]; };
layout(std430, binding = 1) restrict coherent buffer AllBounds { Bounds bounds[2]; };
layout(std430, binding = 2) restrict writeonly buffer Spheres { BoundsBlock spheres; };

shared uint lows[3];
shared uint highs[3];
shared uint farthests[2];
shared uint gones;

vec3 centerOf(int entry) {
    vec3 low = vec3(restored(bounds[entry].low[0]), restored(bounds[entry].low[1]), restored(bounds[entry].low[2]));
    vec3 high = vec3(restored(bounds[entry].high[0]), restored(bounds[entry].high[1]), restored(bounds[entry].high[2]));
    return 0.5 * low + 0.5 * high;
}

vec4 sphereOf(int entry) {
    bool empty = bounds[entry].low[0] > bounds[entry].high[0];
    return empty ? vec4(0.0, 0.0, 0.0, 1.0) : vec4(centerOf(entry), sqrt(uintBitsToFloat(bounds[entry].farthest)));
}

void main() {
    if (task.x == 2) {
        if (gl_GlobalInvocationID.x == 0u) {
            spheres.scattering = sphereOf(1);
            spheres.scene = sphereOf(0);
        }
        return;
    }
    const float kLargest = 1e15; // its square is still finite
    bool isFirst = gl_LocalInvocationIndex == 0u;
    if (isFirst) {
        for (int k = 0; k < 3; ++k) {
            lows[k] = 0xffffffffu;
            highs[k] = 0u;
        }
        farthests[0] = 0u;
        farthests[1] = 0u;
        gones = 0u;
    }
    barrier();
    uvec3 low = uvec3(0xffffffffu);
    uvec3 high = uvec3(0u);
    vec2 farthest = vec2(0.0);
    uint gone = 0u;
    vec3 centers[2] = vec3[2](vec3(0.0), vec3(0.0));
    for (int entry = 0; entry <= task.y && task.x == 1; ++entry) {
        centers[entry] = centerOf(entry);
    }
    // Neighbors lie side by side in memory: each invocation takes every 64th vertex of its group's.
    int first = int(gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y) * 64 * kPerInvocation +
                int(gl_LocalInvocationIndex);
    for (int k = 0; k < kPerInvocation; ++k) {
        int i = first + 64 * k;
        if (i >= count) {
            break;
        }
        vec3 p = vec3(drawn[i * stride], drawn[i * stride + 1], drawn[i * stride + 2]);
        if (!all(lessThanEqual(abs(p), vec3(kLargest)))) { // NaN as well
            ++gone;
        } else if (task.x == 0) {
            uvec3 key = uvec3(ordered(p.x), ordered(p.y), ordered(p.z));
            low = min(low, key);
            high = max(high, key);
        } else {
            vec3 d = p - centers[0];
            vec3 e = p - centers[1];
            farthest = max(farthest, vec2(dot(d, d), dot(e, e)));
        }
    }
    for (int k = 0; k < 3 && task.x == 0; ++k) {
        atomicMin(lows[k], low[k]);
        atomicMax(highs[k], high[k]);
    }
    for (int entry = 0; entry <= task.y && task.x == 1; ++entry) {
        atomicMax(farthests[entry], floatBitsToUint(farthest[entry]));
    }
    if (gone > 0u) {
        atomicAdd(gones, gone);
    }
    barrier();
    if (!isFirst) {
        return;
    }
    for (int entry = 0; entry <= task.y; ++entry) {
        if (task.x == 0) {
            for (int k = 0; k < 3; ++k) {
                atomicMin(bounds[entry].low[k], lows[k]);
                atomicMax(bounds[entry].high[k], highs[k]);
            }
            atomicAdd(bounds[entry].gone, gones);
        } else {
            atomicMax(bounds[entry].farthest, farthests[entry]);
        }
    }
}
