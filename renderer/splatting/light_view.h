#pragma once

#include "renderer/gpu_blocks.h"
#include "renderer/scene/scene.h"

#include <vector>

/// Frusta from which lights see the scattering surface (DESIGN 3.1). No GL here.
namespace celadon {

struct LightView {
    blocks::LightBlock block{};
    int size = 0; ///< N: texels on a side of level 0
};

/// Directional and spot lights, and points well outside: one square frustum fitted to the bounding
/// sphere `target` (a spot's own cone where that is narrower). Points near or inside: six cube
/// faces. Everything of `casters` between the light and the target casts shadows.
/// Every point of the target that the light reaches lies in exactly one view.
/// @param size N >= 1
[[nodiscard]] std::vector<LightView> makeLightViews(const Light& light,
                                                    const BoundingSphere& target,
                                                    const BoundingSphere& casters, int size);

} // namespace celadon
