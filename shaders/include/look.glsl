// What a pixel's surface looks like apart from its scattering: the targets of splatting_buffer.frag.
layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D surfaces;
layout(binding = 3) uniform sampler2D lobes;
layout(binding = 4) uniform sampler2D bases;
layout(binding = 5) uniform sampler2D emissions;

struct Look {
    vec3 f0;      // of the specular lobe at normal incidence
    float weight; // of the lobe
    vec3 normal;  // of the lobe
    float roughness;
    vec3 diffuse; // albedo of an opaque part; 0 where the surface scatters
};

Look lookAt(ivec2 pixel) {
    vec4 lobe = texelFetch(lobes, pixel, 0);
    vec4 base = texelFetch(bases, pixel, 0);
    float ior = texelFetch(emissions, pixel, 0).w;
    float dielectric = (ior - 1.0) / (ior + 1.0);
    dielectric *= dielectric;
    if (texelFetch(surfaces, pixel, 0).z < 0.0) {
        return Look(mix(vec3(dielectric), base.rgb, base.a), 1.0, lobe.xyz, lobe.w, base.rgb * (1.0 - base.a) * (1.0 - dielectric));
    }
    return Look(vec3(dielectric), base.a, lobe.xyz, lobe.w, vec3(0.0));
}
