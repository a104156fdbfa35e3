// Pixels in tiles of neighbors in space.
#include "renderer/gather/pixel_tiles.h"

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace celadon {
namespace {

struct Picture {
    explicit Picture(glm::ivec2 pixels)
        : size(pixels),
          positions(static_cast<std::size_t>(4 * size.x * size.y)),
          surfaces(positions.size(), -1.0f) {}

    void set(int x, int y, glm::vec3 place, float material = 0.0f) {
        const auto i = static_cast<std::size_t>(4 * (y * size.x + x));
        positions[i] = place.x;
        positions[i + 1] = place.y;
        positions[i + 2] = place.z;
        positions[i + 3] = 1.0f;
        surfaces[i + 2] = material;
    }
    [[nodiscard]] glm::vec3 place(std::uint32_t pixel) const {
        return {positions[4 * pixel], positions[4 * pixel + 1], positions[4 * pixel + 2]};
    }
    [[nodiscard]] PixelTiles tiles(int level) const {
        return {{size, positions.data(), surfaces.data(), nullptr}, level};
    }

    glm::ivec2 size;
    std::vector<float> positions, surfaces;
};

/// A near lattice of bars before a far plane, some of it empty and some that does not scatter.
Picture lattice() {
    Picture picture({150, 70});
    for (int y = 0; y < picture.size.y; ++y) {
        for (int x = 0; x < picture.size.x; ++x) {
            if (x > 100 && y < 20) {
                continue;
            }
            const bool isBar = x % 12 < 4 || y % 12 < 4;
            picture.set(x, y, {x, y, isBar ? 0.0f : -80.0f}, x < 7 ? -1.0f : 0.0f);
        }
    }
    return picture;
}

TEST(PixelTiles, EveryPixelThatScattersIsInOneTileOfOneBlock) {
    const Picture picture = lattice();
    for (int level = 0; level < 3; ++level) {
        const PixelTiles tiles = picture.tiles(level);
        std::vector<int> seen(static_cast<std::size_t>(picture.size.x * picture.size.y), 0);
        std::size_t next = 0;
        for (std::size_t block = 0; block < tiles.blocks(); ++block) {
            EXPECT_EQ(tiles.firstTile(block), next);
            next = tiles.endTile(block);
            EXPECT_GT(next, tiles.firstTile(block));
            EXPECT_LE(next - tiles.firstTile(block), std::size_t{16} >> (2 * level));
            for (std::size_t tile = tiles.firstTile(block); tile < next; ++tile) {
                EXPECT_GE(tiles.tile(tile).size(), 1u);
                EXPECT_LE(tiles.tile(tile).size(), 64u);
                for (const std::uint32_t pixel : tiles.tile(tile)) {
                    ++seen[pixel];
                    const glm::vec2 away =
                        tiles.bounds(tile).squaredDistances(picture.place(pixel));
                    EXPECT_EQ(away.x, 0.0f);
                }
            }
        }
        for (std::size_t i = 0; i < seen.size(); ++i) {
            EXPECT_EQ(seen[i], picture.surfaces[4 * i + 2] >= 0.0f ? 1 : 0) << i;
        }
    }
}

TEST(PixelTiles, FewTilesHoldNearAndFar) {
    const Picture picture = lattice();
    const PixelTiles tiles = picture.tiles(0);
    std::size_t count = 0;
    std::size_t mixed = 0;
    for (std::size_t block = 0; block < tiles.blocks(); ++block) {
        for (std::size_t i = tiles.firstTile(block); i < tiles.endTile(block); ++i) {
            ++count;
            mixed += tiles.bounds(i).high.z - tiles.bounds(i).low.z > 1.0f ? 1 : 0;
        }
    }
    // One of a square of 32 x 32 pixels at most; tiles of 8 x 8 would all hold both.
    EXPECT_LE(mixed, tiles.blocks());
    EXPECT_GT(count, 8 * mixed);
}

TEST(PixelTiles, TilesOfPlanesAreCompact) {
    // Seen from the front, and so slantingly that a row's pixels are eight times as far apart.
    for (const float stretch : {1.0f, 8.0f}) {
        Picture picture({64, 64});
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                picture.set(x, y, {stretch * static_cast<float>(x), y, 0.0f});
            }
        }
        const PixelTiles tiles = picture.tiles(0);
        for (std::size_t i = 0; i < tiles.endTile(tiles.blocks() - 1); ++i) {
            const glm::vec3 extent = tiles.bounds(i).high - tiles.bounds(i).low;
            EXPECT_EQ(tiles.tile(i).size(), 64u);
            EXPECT_EQ(extent.x, stretch == 1.0f ? 7.0f : 24.0f);
            EXPECT_EQ(extent.y, stretch == 1.0f ? 7.0f : 15.0f);
        }
    }
}

TEST(PixelTiles, NothingHasNoBlocks) {
    EXPECT_EQ(PixelTiles().blocks(), 0u);
    EXPECT_EQ(Picture({40, 40}).tiles(0).blocks(), 0u);
    EXPECT_EQ(Picture({0, 0}).tiles(0).blocks(), 0u);
}

} // namespace
} // namespace celadon
