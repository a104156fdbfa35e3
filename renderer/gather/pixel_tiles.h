#pragma once

#include "renderer/gather/view_texels.h"
#include "renderer/scene/point_bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace celadon {

/// The pixels of one level of the splatting buffer where something scatters, in tiles of such as
/// are near each other in space: not on the screen, where near and far meet at each silhouette.
class PixelTiles {
public:
    /// A tile's pixels: row times width plus column.
    using Tile = std::span<const std::uint32_t>;

    /// Pixels on a side of what is put in order at once: a part of a level has the tiles of the
    /// whole if it begins at multiples of it.
    static constexpr int kSquare = 32;

    PixelTiles() = default;
    /// @param level  which: of coarser ones fewer tiles share a block
    PixelTiles(const ViewTexels& texels, int level);

    /// Tiles that are near each other; they may share what they look for.
    [[nodiscard]] std::size_t blocks() const { return mBlocks.empty() ? 0 : mBlocks.size() - 1; }
    [[nodiscard]] std::size_t firstTile(std::size_t block) const { return mBlocks[block]; }
    [[nodiscard]] std::size_t endTile(std::size_t block) const { return mBlocks[block + 1]; }
    [[nodiscard]] Tile tile(std::size_t i) const {
        return Tile(mPixels).subspan(mTiles[i], mTiles[i + 1] - mTiles[i]);
    }
    [[nodiscard]] const PointBounds& bounds(std::size_t tile) const { return mBounds[tile]; }

private:
    std::vector<std::uint32_t> mPixels;
    std::vector<std::uint32_t> mTiles;  ///< first pixel of each, and the end
    std::vector<std::uint32_t> mBlocks; ///< first tile of each, and the end
    std::vector<PointBounds> mBounds;   ///< of each tile
};

} // namespace celadon
