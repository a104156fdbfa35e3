// Specular lobe: GGX distribution with height-correlated Smith masking (Walter et al. 2007; Heitz 2014).
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
    float alpha = max(roughness * roughness, 2e-3);
    float a2 = alpha * alpha;
    float denominator = nh * nh * (a2 - 1.0) + 1.0;
    float D = a2 / (3.14159265 * denominator * denominator);
    float V = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
    return D * V * F * nl;
}
