#include "subedit/map/material_map.h"

#include "subedit/map/repeat_tap.h"
#include "subedit/multiversion.h"

namespace celadon::subedit {

namespace {

struct FourTexels {
    const float *p00, *p10, *p01, *p11;
};

CELADON_MULTIVERSION
void interpolate(const FourTexels& texels, float x, float y, int count, float* __restrict out) {
    const float* const p00 = texels.p00;
    const float* const p10 = texels.p10;
    const float* const p01 = texels.p01;
    const float* const p11 = texels.p11;
    for (int i = 0; i < count; ++i) {
        const float top = p00[i] + (p10[i] - p00[i]) * x;
        const float bottom = p01[i] + (p11[i] - p01[i]) * x;
        out[i] = top + (bottom - top) * y;
    }
}

} // namespace

void MaterialMap::sampleLogProfile(glm::vec2 uv, float* out) const {
    const RepeatTap tx(uv.x, width);
    const RepeatTap ty(uv.y, height);
    const float* p00 = logProfile.data() + index(tx.first, ty.first, 0);
    const float* p10 = logProfile.data() + index(tx.second, ty.first, 0);
    const float* p01 = logProfile.data() + index(tx.first, ty.second, 0);
    const float* p11 = logProfile.data() + index(tx.second, ty.second, 0);
    interpolate({p00, p10, p01, p11}, tx.weight, ty.weight, knots() * 3, out);
}

} // namespace celadon::subedit
