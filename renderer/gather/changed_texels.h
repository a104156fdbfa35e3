#pragma once

#include "renderer/gather/gather_materials.h"
#include "subedit/map/texel_rect.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace celadon {

/// Texels of a material that were edited.
struct TexelChange {
    int material = 0;
    subedit::TexelRect rect;
};

/// A stroke touches several charts, far from each other on the map: when there are too many
/// rectangles, one that grows least takes the new one in.
void addChange(std::vector<TexelChange>& changes, const TexelChange& added);

/// Where on the materials' maps a profile is no longer what it was.
class ChangedTexels {
public:
    /// Nothing has changed.
    ChangedTexels() = default;
    ChangedTexels(const GatherMaterials& materials, std::span<const TexelChange> changes);

    /// Whether the profile at a texture coordinate may depend on a changed texel.
    [[nodiscard]] bool touch(int material, glm::vec2 uv) const;

private:
    struct Map {
        int width = 0, height = 0;
        std::vector<bool> changed; ///< [height][width], of texels and their neighbors; or empty
    };
    std::vector<Map> mMaps; ///< of each material
};

} // namespace celadon
