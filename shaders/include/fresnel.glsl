// Unpolarised dielectric Fresnel transmittance 1 - F_r from air into index eta, cosine >= 0.
// Paired with renderer/shading/fresnel.cpp.
float fresnelTransmittance(float cosine, float eta) {
    float c = clamp(cosine, 0.0, 1.0);
    float squared = eta * eta - 1.0 + c * c; // (eta cos theta_t)^2, exact where 1 - sin^2 would cancel
    if (squared < 0.0) {
        return 0.0; // total internal reflection, eta < 1
    }
    float ct = sqrt(squared) / eta;
    float parallel = (eta * c - ct) / max(eta * c + ct, 1e-20);
    float perpendicular = (c - eta * ct) / max(c + eta * ct, 1e-20);
    return 1.0 - 0.5 * (parallel * parallel + perpendicular * perpendicular);
}
