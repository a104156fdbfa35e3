// Exact bounds of a sphere's image along one axis of a perspective view (the two tangents from the
// eye in the plane of that axis and the depth axis).
//   a: the center's coordinate on the axis, z: its depth (> 0 in front), r: radius
// Returns the tangents' slopes (coordinate / depth), or +-1e30 where the sphere reaches behind the eye.
vec2 tangentSlopes(float a, float z, float r) {
    float t2 = a * a + z * z - r * r;
    if (t2 <= 0.0) {
        return vec2(-1e30, 1e30); // the eye is inside the circle
    }
    float t = sqrt(t2);
    // Directions of the tangents: the center's direction turned by +- asin(r / |center|).
    vec2 low = vec2(a * t - z * r, z * t + a * r);
    vec2 high = vec2(a * t + z * r, z * t - a * r);
    return vec2(low.y > 0.0 ? low.x / low.y : (a < 0.0 || low.x < 0.0 ? -1e30 : 1e30),
                high.y > 0.0 ? high.x / high.y : (high.x > 0.0 ? 1e30 : -1e30));
}
