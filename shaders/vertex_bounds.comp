// The box of all drawn vertices, then the distance of the farthest one from its center, then the
// spheres that passes read; and how many vertices are not finite. Floats are kept as unsigned
// integers of the same order, for atomics.
#include "include/blocks.glsl"
#include "include/ordered_float.glsl"

layout(local_size_x = 64) in;

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
    int i = int(gl_GlobalInvocationID.x + gl_NumWorkGroups.x * 64u * gl_GlobalInvocationID.y);
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
    if (i < count) {
        vec3 p = vec3(drawn[i * stride], drawn[i * stride + 1], drawn[i * stride + 2]);
        if (!all(lessThanEqual(abs(p), vec3(kLargest)))) { // NaN as well
            atomicAdd(gones, 1u);
        } else if (task.x == 0) {
            for (int k = 0; k < 3; ++k) {
                atomicMin(lows[k], ordered(p[k]));
                atomicMax(highs[k], ordered(p[k]));
            }
        } else {
            for (int entry = 0; entry <= task.y; ++entry) {
                vec3 d = p - centerOf(entry);
                atomicMax(farthests[entry], floatBitsToUint(dot(d, d)));
            }
        }
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
