// One invocation for each pixel or texel of a picture (gl::Program::dispatchOver).
#include "include/group_sizes.glsl"

layout(PICTURE_GROUP) in;
