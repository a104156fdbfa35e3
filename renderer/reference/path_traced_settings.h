#pragma once

#include "subedit/medium.h"

#include <cstdint>
#include <functional>

namespace celadon {

/// What the random walk in the body needs to know, and when it stops.
struct PathTracedSettings {
    subedit::Medium medium{};        ///< of all scattering meshes
    std::uint64_t paths = 4'000'000; ///< rounded up to whole rounds
    double noise = 0.0;              ///< stops earlier at this relative error; 0: never
    std::uint64_t seed = 1;
    /// Called after each round, with paths traced so far and the relative error.
    std::function<void(std::uint64_t, double)> progress = nullptr;
};

} // namespace celadon
