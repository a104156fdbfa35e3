// Views that explain a frame: what the splatting buffer and the solver hold, as colors. Written where
// the picture would be, as linear display colors.
#include "include/frame.glsl"
#include "include/material.glsl"
#include "include/picture_group.glsl"

layout(location = 0) uniform int mode;   // as ViewMode (view_mode_pass.h)
layout(location = 1) uniform vec4 scale; // level to show; exposure factor; least and greatest radius in mm

layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D exitances; // all levels

layout(rgba32f, binding = 0) uniform writeonly image2D result;

// Dark blue over green to red, for t in [0, 1].
vec3 heat(float t) {
    t = clamp(t, 0.0, 1.0);
    vec3 c = vec3(smoothstep(0.35, 0.75, t) - 0.45 * smoothstep(0.85, 1.0, t),
                  smoothstep(0.0, 0.45, t) - smoothstep(0.6, 1.0, t),
                  0.35 + 0.65 * smoothstep(0.0, 0.2, t) - smoothstep(0.3, 0.6, t));
    return pow(clamp(c, 0.02, 1.0), vec3(2.2));
}

// 2 pi times the integral of P r dr, P linear in ln P between the knots: Simpson's rule on each piece
// is within a percent for the segments that materials have.
vec3 diffuseAlbedo(int m, vec2 uv) {
    int n = int(materials[m].profile.y);
    float h = materials[m].profile.x / float(n);
    vec3 sum = vec3(0.0);
    vec3 logNear = logProfile(m, uv, 0.0);
    for (int k = 0; k < n; ++k) {
        float r = float(k) * h;
        vec3 logFar = logProfile(m, uv, r + h);
        sum += h / 6.0 * (exp(logNear) * r + 4.0 * exp(0.5 * (logNear + logFar)) * (r + 0.5 * h) + exp(logFar) * (r + h));
        logNear = logFar;
    }
    return 2.0 * 3.14159265 * sum;
}

vec3 checker(vec2 uv) {
    ivec2 cell = ivec2(floor(uv * 32.0));
    float light = ((cell.x + cell.y) & 1) == 0 ? 1.0 : 0.55;
    return vec3(fract(uv), 0.35) * light;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) {
        return;
    }
    vec4 position = texelFetch(positions, pixel, 0);
    if (position.w <= 0.0) {
        imageStore(result, pixel, vec4(0.0));
        return;
    }
    vec4 normal = texelFetch(normals, pixel, 0);
    vec4 surface = texelFetch(surfaces, pixel, 0);
    int m = int(surface.z);
    float facing = 0.35 + 0.65 * max(dot(normal.xyz, directionToEye(position.xyz)), 0.0);
    vec3 color = vec3(0.05) * facing; // opaque parts, where nothing is to be said
    if (mode == 5) {
        color = (0.5 + 0.5 * normal.xyz) * facing;
    } else if (m >= 0) {
        if (mode == 1) {
            color = texelFetch(exitances, pixel, 0).rgb * (scale.y / 3.14159265);
        } else if (mode == 2) {
            int level = int(scale.x);
            color = texelFetch(exitances, pixel >> level, level).rgb * (scale.y / 3.14159265);
        } else if (mode == 3) {
            color = heat(log(surface.w / scale.z) / log(max(scale.w / scale.z, 1.001))) * facing;
        } else if (mode == 4) {
            color = diffuseAlbedo(m, surface.xy);
        } else {
            color = checker(surface.xy) * facing;
        }
    }
    imageStore(result, pixel, vec4(color, 1.0));
}
