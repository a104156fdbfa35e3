#pragma once

#include "renderer/gather/pixel_tiles.h"
#include "renderer/gather/tile_gather.h"

#include <span>
#include <vector>

namespace celadon {

/// Pixels of a tile as the lanes of the kernel.
class TileLoader {
public:
    explicit TileLoader(const GatherMaterials& materials);

    /// Finds the places of a tile's pixels.
    void locate(const ViewTexels& level, PixelTiles::Tile pixels);
    /// Whether a pixel's profile depends on changed texels. After locate(), as all that follow.
    [[nodiscard]] bool dependsOn(const ChangedTexels& changed) const;
    /// Reads the profiles of the pixels, and sets their sums to zero.
    void loadProfiles();
    /// The tile's sums become the level's, and its pairs, spread over its pixels.
    void store(std::uint64_t pairs) const;
    /// The tile's sums are added to the level's, which do not become negative.
    void add() const;

    gather::Tile tile{};

private:
    [[nodiscard]] const float* surface(std::size_t lane) const {
        return mLevel->surfaces + std::size_t{4} * mPixels[lane];
    }
    [[nodiscard]] float* exitance(std::size_t lane) const {
        return mLevel->exitance + std::size_t{4} * mPixels[lane];
    }

    const GatherMaterials& mMaterials;
    const ViewTexels* mLevel = nullptr;
    PixelTiles::Tile mPixels;
    std::vector<std::uint16_t> mCodes; ///< what tile.profiles points to
};

} // namespace celadon
