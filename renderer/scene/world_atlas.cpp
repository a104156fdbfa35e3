#include "renderer/scene/world_atlas.h"

#include "renderer/scene/atlas.h"

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
    const Atlas atlas = generateAtlas(meshes);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        applyAtlas(atlas.meshes[i], world.meshes[indices[i]].mesh);
    }
}

} // namespace celadon
