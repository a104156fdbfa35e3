#include "renderer/scene/world_atlas.h"

#include "renderer/scene/atlas.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

namespace celadon {

void addMissingUvs(World& world) {
    std::vector<const Mesh*> meshes;
    std::vector<std::size_t> indices;
    for (std::size_t m = 0; m < world.meshes.size(); ++m) {
        const WorldMesh& part = world.meshes[m];
        if (part.scattering >= 0 && part.mesh.uvs.empty()) {
            meshes.push_back(&part.mesh);
            indices.push_back(m);
        }
    }
    if (meshes.empty()) {
        return;
    }
    world.hasAutomaticAtlas = true;
    const Atlas atlas = generateAtlas(meshes);
    // Densities that differ by so much show, on a map of even detail.
    constexpr double kStretched = 4.0;
    if (atlas.report.areaDistortionMax > kStretched) {
        world.warnings.push_back(fmt::format(
            "the automatic atlas stretches a map by up to {:.1f} in area, {:.2f} on average: give "
            "the model texture coordinates where that shows",
            atlas.report.areaDistortionMax, atlas.report.areaDistortionMean));
    }
    for (std::size_t i = 0; i < indices.size(); ++i) {
        applyAtlas(atlas.meshes[i], world.meshes[indices[i]].mesh);
    }
}

} // namespace celadon
