#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <vector>

/// What `celadon info MODEL` prints about a scene.
namespace celadon {

/// One line each, "name: value", in model units: totals, bounds, meshes, materials, pictures,
/// cameras, lights, warnings.
[[nodiscard]] std::vector<std::string> describeScene(const Scene& scene);

} // namespace celadon
