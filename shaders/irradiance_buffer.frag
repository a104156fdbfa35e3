// Irradiance buffer, level 0 (Chen et al. 2012, section 4, "buffer generation"; DESIGN 3.1).
// Flux is what the geometry intercepts: F_t H a, a the cross-section of the texel towards the light,
// since Delta A = a / (n . l) and E = F_t H (n . l): the cosines cancel and grazing texels are safe.
// The texel is a patch: its positions have the covariance C = s (I - n n^T), s = a / (12 cos^2) that of a
// square as wide as the texel is long up the slope. A disc of the texel's own trace, a / 12 (1 + 1 / cos^2),
// would not reach its neighbors there, and where light ends rings would show.
//   PATCH_VARIANCE  s over that, as SplattingSettings has it
#include "include/light.glsl"
#include "include/fresnel.glsl"
#include "include/material.glsl"
#include "include/surface.glsl"

layout(location = 0) out vec4 outPosition;   // xyz mm, depth along the light's axis in mm (0: background)
layout(location = 1) out vec4 outNormal;     // xyz, n . l
layout(location = 2) out vec4 outFlux;       // 1e-6 W (W/m^2 times mm^2) per channel, covered by scattering surface
layout(location = 3) out vec4 outSurface;    // u, v, material (-1: opaque), 1 where lit
layout(location = 4) out vec4 outCovariance; // mm^2: xx, xy, xz, yy
layout(location = 5) out vec4 outExtent;     // yz, zz, R_P, R_cut
layout(location = 6) out vec4 outKept;       // energy kept inside R_cut per channel, shortest R_P

void main() {
    if (!seesSurface()) {
        discard;
    }
    bool flip = !frontFacing && meshInfo.y != 0;
    vec3 n = facingNormal(flip);
    vec3 toLight = directionToLight(surface.position);
    float depth = -(light.view * vec4(surface.position, 1.0)).z;
    float cosine = dot(n, toLight);
    int m = meshInfo.x;

    // A plane that faces the ray at this texel sees the texel under width^2 times the cosine of the ray to the axis.
    float width = texelWidthMm(depth);
    vec3 axis = -vec3(light.view[0].z, light.view[1].z, light.view[2].z);
    float rayCosine = dot(-toLight, axis);
    float crossSection = width * width * rayCosine;

    bool lit = m >= 0 && cosine > 0.0 && (frontFacing || meshInfo.y != 0);
    vec3 flux = vec3(0.0);
    vec3 radii = vec3(0.0);
    vec3 kept = vec3(1.0);
    if (lit) {
        flux = fresnelTransmittance(cosine, materials[m].profile.z) * facingIrradiance(surface.position) * crossSection;
        radii = materialRadii(m, surface.uv);
        kept = keptEnergy(m, surface.uv);
    }
    lit = lit && flux.r + flux.g + flux.b > 0.0;

    float stretch = 1.0 / max(0.1, cosine);
    float variance = PATCH_VARIANCE * crossSection / 12.0 * stretch * stretch;
    mat3 C = variance * (mat3(1.0) - outerProduct(n, n));

    outPosition = vec4(surface.position, depth);
    outNormal = vec4(n, cosine);
    outFlux = vec4(flux, m >= 0 ? 1.0 : 0.0);
    outSurface = vec4(surface.uv, float(m), lit ? 1.0 : 0.0);
    outCovariance = vec4(C[0][0], C[0][1], C[0][2], C[1][1]);
    outExtent = vec4(C[1][2], C[2][2], radii.xy);
    outKept = vec4(kept, radii.z);
    cutOut();
}
