#include "renderer/gather/changed_texels.h"

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

/// Maps repeat.
int around(int i, int size) {
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

int texelOf(float t, int size) {
    const int i = static_cast<int>((t - std::floor(t)) * static_cast<float>(size));
    return std::min(i, size - 1);
}

} // namespace

ChangedTexels::ChangedTexels(const GatherMaterials& materials,
                             std::span<const TexelChange> changes) {
    for (const TexelChange& change : changes) {
        const subedit::MaterialMap& own = materials.map(change.material);
        const auto index = static_cast<std::size_t>(change.material);
        mMaps.resize(std::max(mMaps.size(), index + 1));
        Map& map = mMaps[index];
        map.width = own.width;
        map.height = own.height;
        map.changed.resize(static_cast<std::size_t>(own.width) *
                           static_cast<std::size_t>(own.height));
        // Filtering takes in a texel's neighbors.
        const subedit::TexelRect& rect = change.rect;
        const int columns = std::min(rect.width + 2, own.width);
        const int rows = std::min(rect.height + 2, own.height);
        for (int y = 0; y < rows; ++y) {
            const std::size_t row = static_cast<std::size_t>(around(rect.y - 1 + y, own.height)) *
                                    static_cast<std::size_t>(own.width);
            for (int x = 0; x < columns; ++x) {
                map.changed[row + static_cast<std::size_t>(around(rect.x - 1 + x, own.width))] =
                    true;
            }
        }
    }
}

bool ChangedTexels::touch(int material, glm::vec2 uv) const {
    const auto index = static_cast<std::size_t>(material);
    if (index >= mMaps.size() || mMaps[index].changed.empty()) {
        return false;
    }
    const Map& map = mMaps[index];
    return map.changed[static_cast<std::size_t>(texelOf(uv.y, map.height)) *
                           static_cast<std::size_t>(map.width) +
                       static_cast<std::size_t>(texelOf(uv.x, map.width))];
}

} // namespace celadon
