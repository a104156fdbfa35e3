// A latitude-longitude map (renderer/scene/environment.h) onto the faces of a cube: the mean of 4 x 4 points
// of each texel, weighted by the texel's solid angle, which is alpha: so that means over texels, which mips and
// filters are, keep the light.
#include "include/cube.glsl"
#include "include/picture_group.glsl"

layout(binding = 0) uniform sampler2D panorama;

layout(rgba32f, binding = 0) uniform writeonly imageCube result;

vec3 radianceFrom(vec3 d) {
    float u = atan(d.x, -d.z) / 6.28318531 + 0.5;
    float v = acos(clamp(d.y, -1.0, 1.0)) / 3.14159265;
    return textureLod(panorama, vec2(u, v), 0.0).rgb;
}

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec2 size = imageSize(result);
    if (any(greaterThanEqual(texel.xy, size))) {
        return;
    }
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 st = (vec2(texel.xy) + (vec2(i & 3, i >> 2) + 0.5) / 4.0) / vec2(size);
        sum += radianceFrom(cubeDirection(texel.z, st));
    }
    vec2 c = (vec2(texel.xy) + 0.5) / vec2(size) * 2.0 - 1.0;
    float angle = pow(1.0 + dot(c, c), -1.5);
    imageStore(result, texel, vec4(sum / 16.0, 1.0) * angle);
}
