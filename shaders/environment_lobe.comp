// The environment under a GGX lobe about each direction, seen straight on (Karis 2013: n = v = r), by
// importance sampling; each sample looks up a level whose texels are as large as its share of the lobe
// (Krivanek and Colbert 2008).
#include "include/cube.glsl"
#include "include/ggx.glsl"
#include "include/picture_group.glsl"

layout(location = 0) uniform float roughness; // 0: the map itself

layout(binding = 0) uniform samplerCube environment;

layout(rgba32f, binding = 0) uniform writeonly imageCube result;

const uint kSamples = 96u;

vec3 radianceFrom(vec3 direction, float level) {
    vec4 texel = textureLod(environment, direction, level); // weighted by its solid angle
    return texel.rgb / texel.a;
}

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec2 size = imageSize(result);
    if (any(greaterThanEqual(texel.xy, size))) {
        return;
    }
    vec3 n = cubeDirection(texel.z, (vec2(texel.xy) + 0.5) / vec2(size));
    if (roughness <= 0.0) {
        imageStore(result, texel, vec4(radianceFrom(n, 0.0), 1.0));
        return;
    }
    vec3 t = normalize(abs(n.y) < 0.9 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
    vec3 b = cross(n, t);
    float alpha = ggxAlpha(roughness);
    float a2 = alpha * alpha;
    float edge = float(textureSize(environment, 0).x);
    float texelAngle = 4.0 * 3.14159265 / (6.0 * edge * edge);
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (uint i = 0u; i < kSamples; ++i) {
        vec3 h = sampleGgx(hammersley(i, kSamples), alpha);
        vec3 l = 2.0 * h.z * h - vec3(0.0, 0.0, 1.0);
        if (l.z <= 0.0) {
            continue;
        }
        float denominator = h.z * h.z * (a2 - 1.0) + 1.0;
        float density = a2 / (3.14159265 * denominator * denominator) * 0.25; // D n.h / (4 v.h), n = v
        float level = 0.5 * log2(1.0 / (float(kSamples) * density * texelAngle)) + 1.0;
        sum += l.z * radianceFrom(t * l.x + b * l.y + n * l.z, max(level, 0.0));
        weight += l.z;
    }
    imageStore(result, texel, vec4(sum / weight, 1.0));
}
