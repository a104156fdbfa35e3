#pragma once

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

/// The two texels about a coordinate along one axis of a map that repeats; texel i has its center
/// at (i + 1/2) / size.
struct RepeatTap {
    int first, second;
    float weight; ///< of `second`

    RepeatTap(float coordinate, int size) {
        const bool isWithin = coordinate >= 0.0f && coordinate < 1.0f; // nearly always
        const float once = isWithin ? coordinate : coordinate - std::floor(coordinate);
        // From the center before texel 0 on: what is cut off is the number of the second one.
        const float place = once * static_cast<float>(size) + 0.5f;
        const int after = std::clamp(static_cast<int>(place), 0, size);
        first = after > 0 ? after - 1 : size - 1;
        second = after < size ? after : 0;
        weight = place - static_cast<float>(after);
    }
};

} // namespace celadon::subedit
