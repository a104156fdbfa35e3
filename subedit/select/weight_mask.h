#pragma once

#include "subedit/map/texel_rect.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// How much of each texel is meant, 0 to 1 in steps of 1/65535: the selection, and what a stroke
/// has covered. Tiles that are nowhere set take no memory, and copies share their tiles until one
/// of them changes, so that a history can keep thousands.
namespace celadon::subedit {

class WeightMask {
public:
    using Weight = std::uint16_t;
    static constexpr Weight kFull = 65535;
    static constexpr int kTileSize = 32; ///< texels on a side
    using Tile = std::array<Weight, kTileSize * kTileSize>;

    WeightMask() = default;
    /// All zero.
    WeightMask(int width, int height);
    /// All `kFull`.
    [[nodiscard]] static WeightMask full(int width, int height);

    [[nodiscard]] int width() const { return mWidth; }
    [[nodiscard]] int height() const { return mHeight; }
    [[nodiscard]] int tilesX() const { return mTilesX; }
    [[nodiscard]] int tileCount() const { return static_cast<int>(mTiles.size()); }

    [[nodiscard]] Weight at(int x, int y) const;
    /// @param texel index y * width + x
    [[nodiscard]] Weight at(std::size_t texel) const;
    void set(int x, int y, Weight weight);
    void set(std::size_t texel, Weight weight);

    /// Null where all weights are zero.
    [[nodiscard]] const Tile* tile(int index) const {
        return mTiles[static_cast<std::size_t>(index)].get();
    }
    /// The tile, made or made ours if need be.
    [[nodiscard]] Tile& editTile(int index);
    /// Texels of the map that a tile covers; tiles at the right and bottom may be cut.
    [[nodiscard]] TexelRect tileRect(int index) const;
    [[nodiscard]] int tileOf(int x, int y) const { return y / kTileSize * mTilesX + x / kTileSize; }

    /// Place within its tile: row and column of a tile of full size.
    [[nodiscard]] static std::size_t cell(int x, int y) {
        return static_cast<std::size_t>(y % kTileSize) * kTileSize +
               static_cast<std::size_t>(x % kTileSize);
    }

    /// No texel has any weight.
    [[nodiscard]] bool isZero() const;
    [[nodiscard]] std::size_t countNonZero() const;
    /// The smallest rectangle of whole tiles with any weight.
    [[nodiscard]] TexelRect bounds() const;
    /// Gives back tiles that are all zero, and shares those that are all full, or as in `like`.
    void compact(const WeightMask& like);
    void compact() { compact(*this); }
    /// Bytes that this mask takes besides another, of whose tiles it may share some.
    [[nodiscard]] std::size_t bytesBeyond(const WeightMask& other) const;

    /// Calls visit(texel index, weight) for every weight above zero, tile by tile.
    template<typename Visit>
    void forEachNonZero(Visit&& visit) const {
        for (int t = 0; t < tileCount(); ++t) {
            forEachNonZeroOfTile(t, visit);
        }
    }
    template<typename Visit>
    void forEachNonZeroOfTile(int index, Visit&& visit) const {
        const Tile* weights = tile(index);
        if (weights == nullptr) {
            return;
        }
        const TexelRect rect = tileRect(index);
        for (int y = rect.y; y < rect.bottom(); ++y) {
            for (int x = rect.x; x < rect.right(); ++x) {
                const Weight w = (*weights)[cell(x, y)];
                if (w != 0) {
                    visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(mWidth) +
                              static_cast<std::size_t>(x),
                          w);
                }
            }
        }
    }

    [[nodiscard]] bool operator==(const WeightMask& other) const;

private:
    int mWidth = 0;
    int mHeight = 0;
    int mTilesX = 0;
    std::vector<std::shared_ptr<const Tile>> mTiles;
};

[[nodiscard]] inline float weightToFloat(WeightMask::Weight weight) {
    return static_cast<float>(weight) * (1.0f / 65535.0f);
}

/// @param value clamped to [0, 1]; NaN gives 0
[[nodiscard]] WeightMask::Weight weightFromFloat(float value);

} // namespace celadon::subedit
