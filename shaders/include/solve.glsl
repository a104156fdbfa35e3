#include "include/blocks.glsl"

layout(std140, binding = 3) uniform SolveUniforms { SolveBlock solve; };

int splattingLevels() { return int(solve.rings.x); }
int irradianceLevels() { return int(solve.rings.y); }
bool isAdaptive() { return solve.energy.y > 0.5; }
bool isMultiresolution() { return solve.energy.z > 0.5; }
