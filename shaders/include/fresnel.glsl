// Unpolarised dielectric Fresnel transmittance 1 - F_r from air into index eta, cosine >= 0.
// Paired with renderer/shading/fresnel.cpp.
float fresnelTransmittance(float cosine, float eta) {
    float c = clamp(cosine, 0.0, 1.0);
    float sin2t = (1.0 - c * c) / (eta * eta);
    if (sin2t >= 1.0) {
        return 0.0; // total internal reflection, eta < 1
    }
    float ct = sqrt(1.0 - sin2t);
    float parallel = (eta * c - ct) / (eta * c + ct);
    float perpendicular = (c - eta * ct) / (c + eta * ct);
    return 1.0 - 0.5 * (parallel * parallel + perpendicular * perpendicular);
}
