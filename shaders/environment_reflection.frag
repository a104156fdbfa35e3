// The environment in the specular lobe, by the split sum (renderer/shading/environment_reflection.h). The part
// of it that other surface hides is taken from the shadows of the lights that stand for the environment,
// weighted by a broad lobe: a ratio, so that unshadowed places keep the exact reflection.
#include "include/frame.glsl"
#include "include/look.glsl"

layout(location = 0) uniform vec4 turn; // cosine and sine of the environment's turn about +y, strength

layout(binding = 6) uniform sampler2D reach; // as direct_light.frag sums it up
layout(binding = 10) uniform samplerCube environmentLobes;
layout(binding = 11) uniform sampler2D lobeAlbedos;

layout(location = 0) out vec4 radiance;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w <= 0.0) {
        discard;
    }
    Look look = lookAt(pixel);
    vec3 n = texelFetch(normals, pixel, 0).xyz;
    vec3 v = directionToEye(position.xyz);
    vec3 r = reflect(-v, look.normal);
    // A mapped normal may reflect from below the surface: nothing comes from there.
    float horizon = clamp(1.0 + dot(r, n), 0.0, 1.0);
    vec3 inMap = vec3(r.x * turn.x - r.z * turn.y, r.y, r.z * turn.x + r.x * turn.y);
    float level = look.roughness * float(textureQueryLevels(environmentLobes) - 1);
    vec3 light = textureLod(environmentLobes, inMap, level).rgb * turn.z;
    vec2 albedo = textureLod(lobeAlbedos, vec2(clamp(dot(look.normal, v), 0.0, 1.0), look.roughness), 0.0).rg;
    vec2 sums = texelFetch(reach, pixel, 0).rg;
    float visible = sums.y > 0.0 ? sums.x / sums.y : 1.0;
    radiance = vec4(light * (look.f0 * albedo.x + albedo.y) * (look.weight * visible * horizon * horizon), 0.0);
}
