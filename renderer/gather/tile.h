#pragma once

#include "renderer/gather/tile_gather.h"
#include "renderer/scene/point_bounds.h"

#include <span>
#include <vector>

namespace celadon {

/// Pixels of a tile in the order of the kernel's lanes: 4 x 4 (or two 4 x 2) side by side, so that
/// the lanes of one vector are near each other.
class TileLoader {
public:
    explicit TileLoader(const GatherMaterials& materials);

    /// Finds the places of a tile's pixels. @return false where nothing scatters
    bool locate(const ViewTexels& level, glm::ivec2 corner);
    /// Whether a pixel's profile depends on changed texels. After locate().
    [[nodiscard]] bool dependsOn(const ViewTexels& level, glm::ivec2 corner,
                                 std::span<const TexelChange> changes) const;
    /// Reads the profiles of the pixels, and sets their sums to zero. After locate().
    void loadProfiles(const ViewTexels& level, glm::ivec2 corner);
    /// The tile's sums become the level's, and its pairs, spread over its pixels.
    void store(const ViewTexels& level, glm::ivec2 corner, std::uint64_t pairs) const;
    /// The tile's sums are added to the level's, which do not become negative.
    void add(const ViewTexels& level, glm::ivec2 corner) const;

    gather::Tile tile{};
    PointBounds bounds;

private:
    const GatherMaterials& mMaterials;
    std::vector<std::uint16_t> mCodes; ///< what tile.profiles points to
    int mCovered = 0;
};

} // namespace celadon
