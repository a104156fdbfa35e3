#include "renderer/gather/changed_texels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace celadon {

namespace {

/// Rectangles of edits that are told apart until they are brought up to date.
constexpr std::size_t kMostChanges = 48;

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

void addChange(std::vector<TexelChange>& changes, const TexelChange& added) {
    TexelChange* closest = nullptr;
    std::size_t leastGrowth = std::numeric_limits<std::size_t>::max();
    for (TexelChange& change : changes) {
        if (change.material != added.material) {
            continue;
        }
        const std::size_t growth = unite(change.rect, added.rect).texels() - change.rect.texels();
        if (growth < leastGrowth) {
            leastGrowth = growth;
            closest = &change;
        }
    }
    const bool isFull = changes.size() >= kMostChanges;
    if (closest != nullptr && (isFull || leastGrowth <= added.rect.texels() / 2)) {
        closest->rect = unite(closest->rect, added.rect);
    } else {
        changes.push_back(added);
    }
}

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
