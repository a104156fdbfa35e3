// Stands in until atlas.cpp is there; listed last in the library, so that the real one wins.
#include "renderer/scene/atlas.h"
#include "subedit/errors.h"

namespace celadon {

Atlas generateAtlas(std::span<const Mesh* const> /*meshes*/, const AtlasSettings& /*settings*/) {
    throw InputError("the model", "it has no texture coordinates, and the atlas is not in yet");
}

void applyAtlas(const AtlasMesh& /*atlas*/, Mesh& /*mesh*/) {}

} // namespace celadon
