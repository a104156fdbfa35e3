#include "include/blocks.glsl"

layout(std140, binding = 4) uniform BoundsUniforms { BoundsBlock bounds; };
