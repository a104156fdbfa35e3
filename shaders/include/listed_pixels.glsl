// Pixels that a pass leaves to a second one (renderer/listed_pixels.h).
#include "include/group_sizes.glsl"

layout(std430, binding = 0) restrict buffer ListedPixels {
    uint groups[3]; // of kListGroup, for an indirect dispatch
    uint listedCount;
    uint listedPixels[]; // x + 65536 y
};

const uint kGroupsOfARow = 32768u; // every driver allows 65535

void listPixel(ivec2 pixel) {
    uint index = atomicAdd(listedCount, 1u);
    uint group = index / kListGroup;
    if (index % kListGroup == 0u) {
        atomicMax(groups[0], min(group + 1u, kGroupsOfARow));
        atomicMax(groups[1], group / kGroupsOfARow + 1u);
    }
    listedPixels[index] = uint(pixel.x) + 65536u * uint(pixel.y);
}

bool isListed(int index) { return uint(index) < listedCount; }
ivec2 listedPixel(int index) { return ivec2(listedPixels[index] % 65536u, listedPixels[index] / 65536u); }
