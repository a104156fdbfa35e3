// A point that is drawn where the light view is in use: what conditional rendering asks.
#include "include/light.glsl"

void main() {
    gl_Position = vec4(light.direction.w > 0.0 ? vec3(0.0, 0.0, 0.5) : vec3(2.0), 1.0);
}
