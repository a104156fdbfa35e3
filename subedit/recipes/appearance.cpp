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

} // namespace celadon::subedit
