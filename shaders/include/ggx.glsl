// Specular lobe: GGX distribution with height-correlated Smith masking (Walter et al. 2007; Heitz 2014).

// Width of the distribution. Never a mirror: a sharper one is narrower than a pixel is wide on most things.
float ggxAlpha(float roughness) { return max(roughness * roughness, 2e-3); }

// Masking over 4 n.l n.v.
float ggxVisibility(float nl, float nv, float alpha) {
    float a2 = alpha * alpha;
    return 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
}

// Returns f_r times n.l; f0 is the reflectance at normal incidence.
vec3 ggxLobe(vec3 n, vec3 v, vec3 l, float roughness, vec3 f0) {
    vec3 h = normalize(v + l);
    float nl = dot(n, l);
    float nv = max(dot(n, v), 1e-4);
    if (nl <= 0.0) {
        return vec3(0.0);
    }
    float nh = clamp(dot(n, h), 0.0, 1.0);
    float vh = clamp(dot(v, h), 0.0, 1.0);
    float alpha = ggxAlpha(roughness);
    float a2 = alpha * alpha;
    float denominator = nh * nh * (a2 - 1.0) + 1.0;
    float D = a2 / (3.14159265 * denominator * denominator);
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
    return D * ggxVisibility(nl, nv, alpha) * F * nl;
}

// Point i of n, well spread over the unit square (Hammersley).
vec2 hammersley(uint i, uint n) { return vec2((float(i) + 0.5) / float(n), float(bitfieldReverse(i)) * 2.3283064365386963e-10); }

// Half vector about +z, with density D n.h.
vec3 sampleGgx(vec2 u, float alpha) {
    float cos2 = (1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x);
    float sine = sqrt(max(1.0 - cos2, 0.0));
    float phi = 6.28318531 * u.y;
    return vec3(cos(phi) * sine, sin(phi) * sine, sqrt(cos2));
}
