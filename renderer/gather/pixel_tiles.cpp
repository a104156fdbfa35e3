#include "renderer/gather/pixel_tiles.h"

#include "renderer/gather/pair_kernel.h"

#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <utility>

namespace celadon {

namespace {

constexpr int kSquare = PixelTiles::kSquare;

/// What one square of the screen comes to; ends count from its own first pixel or tile.
struct Square {
    std::vector<std::uint32_t> pixels, tileEnds, blockEnds;
    std::vector<PointBounds> bounds; ///< of the tiles
};

class SquareSorter {
    struct Item {
        glm::vec3 place;
        std::uint32_t pixel;
    };
    struct Steps {
        glm::vec3 sum{0.0f};
        float squares = 0.0f;
        void add(glm::vec3 step) {
            sum += step;
            squares += glm::dot(step, step);
        }
    };

public:
    SquareSorter(const ViewTexels& texels, std::size_t tilesOfBlock)
        : mTexels(texels), mTilesOfBlock(tilesOfBlock) {}

    Square sort(glm::ivec2 corner) {
        collect(corner);
        if (isFlat()) {
            orderFlat();
        } else {
            order(mItems);
        }
        Square square;
        PointBounds bounds;
        for (std::size_t i = 0; i < mItems.size(); ++i) {
            square.pixels.push_back(mItems[i].pixel);
            bounds.add(mItems[i].place);
            const bool isLast = i + 1 == mItems.size();
            if (isLast || (i + 1) % gather::kTilePixels == 0) {
                square.tileEnds.push_back(static_cast<std::uint32_t>(i + 1));
                square.bounds.push_back(std::exchange(bounds, {}));
                const std::size_t tiles = square.tileEnds.size();
                if (isLast || tiles % mTilesOfBlock == 0) {
                    square.blockEnds.push_back(static_cast<std::uint32_t>(tiles));
                }
            }
        }
        return square;
    }

private:
    void collect(glm::ivec2 corner) {
        mItems.clear();
        const glm::ivec2 end = glm::min(corner + kSquare, mTexels.size);
        for (int y = corner.y; y < end.y; ++y) {
            for (int x = corner.x; x < end.x; ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * mTexels.size.x + x);
                const float* const p = mTexels.positions + std::size_t{4} * pixel;
                if (p[3] > 0.0f && mTexels.surfaces[std::size_t{4} * pixel + 2] >= 0.0f) {
                    mItems.push_back({{p[0], p[1], p[2]}, pixel});
                }
            }
        }
    }

    /// Whether a whole square is seen, of a surface that neither jumps nor is very slanted: its
    /// steps from pixel to pixel go one way. The screen's order is as compact then.
    [[nodiscard]] bool isFlat() const {
        constexpr std::size_t kSide = kSquare;
        constexpr float kHalfOfSteps = 0.5f * float(kSide * (kSide - 1));
        if (mItems.size() != kSide * kSide) {
            return false;
        }
        Steps right, up;
        for (std::size_t i = 0; i < mItems.size(); ++i) {
            if (i % kSide + 1 < kSide) {
                right.add(mItems[i + 1].place - mItems[i].place);
            }
            if (i + kSide < mItems.size()) {
                up.add(mItems[i + kSide].place - mItems[i].place);
            }
        }
        const auto goOneWay = [](const Steps& steps) {
            return glm::dot(steps.sum, steps.sum) > kHalfOfSteps * steps.squares;
        };
        return goOneWay(right) && goOneWay(up) && right.squares < 4.0f * up.squares &&
               up.squares < 4.0f * right.squares;
    }

    /// Tiles of 8 x 8 pixels, row by row of vectors of 4 x 2.
    void orderFlat() {
        mOrdered.clear();
        for (int i = 0; i < kSquare * kSquare; ++i) {
            const int tile = i / 64, vector = i / 8 % 8, lane = i % 8;
            const int x = tile % 4 * 8 + vector % 2 * 4 + lane % 4;
            const int y = tile / 4 * 8 + vector / 2 * 2 + lane / 4;
            mOrdered.push_back(mItems[static_cast<std::size_t>(y * kSquare + x)]);
        }
        mItems.swap(mOrdered);
    }

    /// Halves of halves along the longest axis, of whole tiles and then of whole vectors, so that
    /// both are compact.
    void order(std::span<Item> items) {
        constexpr std::size_t kVector = 8;
        const std::size_t unit = items.size() > gather::kTilePixels ? gather::kTilePixels : kVector;
        const std::size_t units = (items.size() + unit - 1) / unit;
        if (units < 2) {
            return;
        }
        PointBounds bounds;
        for (const Item& item : items) {
            bounds.add(item.place);
        }
        const glm::vec3 extent = bounds.high - bounds.low;
        const int axis =
            extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
        const std::size_t half = unit * (units / 2);
        std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {},
                                 [axis](const Item& item) { return item.place[axis]; });
        order(items.first(half));
        order(items.subspan(half));
    }

    const ViewTexels& mTexels;
    std::size_t mTilesOfBlock;
    std::vector<Item> mItems, mOrdered;
};

} // namespace

PixelTiles::PixelTiles(const ViewTexels& texels, int level) {
    const std::size_t side = static_cast<std::size_t>(std::max(4 >> level, 1));
    const glm::ivec2 squares = (texels.size + kSquare - 1) / kSquare;
    std::vector<Square> parts(static_cast<std::size_t>(squares.x) *
                              static_cast<std::size_t>(squares.y));
    tbb::parallel_for(tbb::blocked_range<int>(0, squares.x * squares.y), [&](const auto& range) {
        SquareSorter sorter(texels, side * side);
        for (int i = range.begin(); i < range.end(); ++i) {
            parts[static_cast<std::size_t>(i)] =
                sorter.sort(glm::ivec2(i % squares.x, i / squares.x) * kSquare);
        }
    });
    mTiles = {0};
    mBlocks = {0};
    for (const Square& part : parts) {
        const auto firstPixel = static_cast<std::uint32_t>(mPixels.size());
        const auto firstTile = static_cast<std::uint32_t>(mTiles.size() - 1);
        mPixels.insert(mPixels.end(), part.pixels.begin(), part.pixels.end());
        mBounds.insert(mBounds.end(), part.bounds.begin(), part.bounds.end());
        for (const std::uint32_t end : part.tileEnds) {
            mTiles.push_back(firstPixel + end);
        }
        for (const std::uint32_t end : part.blockEnds) {
            mBlocks.push_back(firstTile + end);
        }
    }
}

} // namespace celadon
