// Albedo of the specular lobe under uniform light, a F0 + b with Schlick's Fresnel term, over n.v and
// roughness (Karis 2013).
#include "include/ggx.glsl"
#include "include/picture_group.glsl"

layout(rg32f, binding = 0) uniform writeonly image2D result;

const uint kSamples = 512u;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(result);
    if (any(greaterThanEqual(texel, size))) {
        return;
    }
    vec2 at = (vec2(texel) + 0.5) / vec2(size);
    float nv = max(at.x, 1e-3);
    float alpha = ggxAlpha(at.y);
    vec3 v = vec3(sqrt(1.0 - nv * nv), 0.0, nv);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < kSamples; ++i) {
        vec3 h = sampleGgx(hammersley(i, kSamples), alpha);
        float vh = dot(v, h);
        vec3 l = 2.0 * vh * h - v;
        if (l.z <= 0.0 || vh <= 0.0) {
            continue;
        }
        float w = 4.0 * ggxVisibility(l.z, nv, alpha) * l.z * vh / max(h.z, 1e-6); // f n.l / density
        float fresnel = pow(1.0 - vh, 5.0);
        sum += w * vec2(1.0 - fresnel, fresnel);
    }
    imageStore(result, texel, vec4(sum / float(kSamples), 0.0, 0.0));
}
