// Accumulation, second pass: pixels at silhouettes and folds, where light falls off along what curves away and no neighbor
// lies beyond. A line is fitted to what is around, by distances along and off the surface. Never a hole, never a leak
// across a silhouette.
// The cpu backend has the same in renderer/gather/level_accumulation.cpp.
#include "include/upsampling.glsl"
#include "include/list_group.glsl"

// Weighted least squares of light that is linear along the way from the neighbors' mean position to this point.
vec3 fit(Point o, ivec2 center) {
    const float leastVariance = 0.05; // in widths squared: below, the slope is not to be trusted
    const float farthest = 1.5;       // in widths: nor is it beyond
    float total = 1e-30;
    vec3 place = vec3(0.0); // sums of offsets, light, their products
    vec3 light = vec3(0.0);
    mat3 places = mat3(0.0);
    mat3 lights = mat3(0.0); // a column for each part of the offset
    for (int i = 0; i < 25; ++i) {
        ivec2 neighbor = center + ivec2(i % 5, i / 5) - 2;
        vec4 position = positionAbout(neighbor);
        if (position.w <= 0.0) {
            continue;
        }
        vec4 its = texelFetch(farLight, neighbor, 0);
        vec3 normal = texelFetch(normals, neighbor, level + 1).xyz;
        vec3 offset = (position.xyz - o.position) / o.width;
        float plane = max(abs(dot(o.normal, offset)), abs(dot(normal, offset)));
        float facing = max(dot(o.normal, normal), 0.0);
        float w = exp(-0.2 * dot(offset, offset) - plane) * similarity(o.R_P, its.a) * (facing * facing + 0.001) + 1e-12;
        total += w;
        place += w * offset;
        light += w * its.rgb;
        places += outerProduct(w * offset, offset);
        lights += outerProduct(w * its.rgb, offset);
    }
    place /= total;
    light /= total;
    float away = length(place);
    vec3 along = away > 1e-6 ? -place / away : vec3(0.0);
    float variance = max(dot(along, places * along) / total - away * away, 0.0);
    vec3 slope = (lights * along / total + light * away) / (variance + leastVariance);
    return light + isFarLightSmooth(o.R_P, o.width) * min(away, farthest) * slope;
}

void main() {
    if (!isListed(listIndex())) {
        return;
    }
    ivec2 pixel = listedPixel(listIndex());
    Point o = pointAt(pixel);
    float rough = roughness(o, pixel);
    vec3 light = fit(o, pixel / 2);
    addFarLight(o, pixel, rough < 1.0 ? mix(interpolate(o, pixel), light, rough) : light);
}
