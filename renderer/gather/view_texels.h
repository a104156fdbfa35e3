#pragma once

#include <glm/vec2.hpp>

namespace celadon {

/// One level of the splatting buffer: RGBA, rows from the bottom.
struct ViewTexels {
    glm::ivec2 size{0};
    const float* positions = nullptr; ///< xyz mm, view depth; 0 depth: background
    const float* surfaces = nullptr;  ///< u, v, material (< 0: not scattering), R_P
    float* exitance = nullptr;        ///< 1e-6 W/mm^2, that is W/m^2; alpha counts pairs
};

} // namespace celadon
