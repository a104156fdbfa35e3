#include "include/frame.glsl"
#include "include/solve.glsl"

// Hierarchical scheme: ring k of the splatting levels begins at so many pixels of level k.
float ringRadius(int k, float depth) {
    return k == 0 ? 0.0 : pixelWidthMm(depth) * float(1 << k) / solve.rings.z;
}

// Where ring k ends in the cross-fade with the next one; r_s where there is no next one: a level
// whose ring would begin beyond r_s is left out.
bool hasNextRing(int k, float depth) {
    return k + 1 < splattingLevels() && ringRadius(k + 1, depth) < solve.node.x;
}
