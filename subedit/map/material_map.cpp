#include "subedit/map/material_map.h"

#include <cmath>

namespace celadon::subedit {

namespace {

struct LinearTap {
    int first, second;
    float weight; ///< of `second`
};

/// The two texels around coordinate t in [0, 1) on a repeating axis of `size` texels.
LinearTap repeatTap(float t, int size) {
    const float position = (t - std::floor(t)) * static_cast<float>(size) - 0.5f;
    const float base = std::floor(position);
    const int i = static_cast<int>(base);
    return {(i + size) % size, (i + 1 + size) % size, position - base};
}

} // namespace

void MaterialMap::sampleLogProfile(glm::vec2 uv, float* out) const {
    const LinearTap tx = repeatTap(uv.x, width);
    const LinearTap ty = repeatTap(uv.y, height);
    const float* p00 = logProfile.data() + index(tx.first, ty.first, 0);
    const float* p10 = logProfile.data() + index(tx.second, ty.first, 0);
    const float* p01 = logProfile.data() + index(tx.first, ty.second, 0);
    const float* p11 = logProfile.data() + index(tx.second, ty.second, 0);
    for (int i = 0; i < knots() * 3; ++i) {
        const float top = p00[i] + (p10[i] - p00[i]) * tx.weight;
        const float bottom = p01[i] + (p11[i] - p01[i]) * tx.weight;
        out[i] = top + (bottom - top) * ty.weight;
    }
}

} // namespace celadon::subedit
