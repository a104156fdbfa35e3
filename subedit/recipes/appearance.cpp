#include "subedit/recipes/appearance.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <cmath>

namespace celadon::subedit {

Appearance mix(const Appearance& a, const Appearance& b, float t) {
    return {glm::mix(a.albedo, b.albedo, t),
            glm::exp(glm::mix(glm::log(a.effectiveRadius), glm::log(b.effectiveRadius), t)),
            std::lerp(a.roughness, b.roughness, t)};
}

void AppearanceMean::add(const Appearance& appearance) {
    mSum.albedo += appearance.albedo;
    mSum.effectiveRadius += glm::log(appearance.effectiveRadius);
    mSum.roughness += appearance.roughness;
    mCount += 1.0f;
}

Appearance AppearanceMean::result() const {
    return {mSum.albedo / mCount, glm::exp(mSum.effectiveRadius / mCount), mSum.roughness / mCount};
}

} // namespace celadon::subedit
