#include "subedit/select/weight_mask.h"

#include "subedit/assert.h"

#include <algorithm>

namespace celadon::subedit {

namespace {

bool isAllZero(const WeightMask::Tile& tile) {
    return std::all_of(tile.begin(), tile.end(), [](WeightMask::Weight w) { return w == 0; });
}

const std::shared_ptr<const WeightMask::Tile>& fullTile() {
    static const std::shared_ptr<const WeightMask::Tile> tile = [] {
        auto full = std::make_shared<WeightMask::Tile>();
        full->fill(WeightMask::kFull);
        return full;
    }();
    return tile;
}

} // namespace

WeightMask::WeightMask(int width, int height)
    : mWidth(width),
      mHeight(height),
      mTilesX((width + kTileSize - 1) / kTileSize),
      mTiles(static_cast<std::size_t>(mTilesX) *
             static_cast<std::size_t>((height + kTileSize - 1) / kTileSize)) {
    CELADON_ASSERT(width > 0 && height > 0);
}

WeightMask WeightMask::full(int width, int height) {
    WeightMask mask(width, height);
    std::fill(mask.mTiles.begin(), mask.mTiles.end(), fullTile());
    return mask;
}

WeightMask::Weight WeightMask::at(int x, int y) const {
    CELADON_ASSERT(x >= 0 && x < mWidth && y >= 0 && y < mHeight);
    const Tile* weights = tile(tileOf(x, y));
    return weights == nullptr ? Weight{0} : (*weights)[cell(x, y)];
}

WeightMask::Weight WeightMask::at(std::size_t texel) const {
    const auto width = static_cast<std::size_t>(mWidth);
    return at(static_cast<int>(texel % width), static_cast<int>(texel / width));
}

void WeightMask::set(int x, int y, Weight weight) {
    CELADON_ASSERT(x >= 0 && x < mWidth && y >= 0 && y < mHeight);
    const int t = tileOf(x, y);
    if (weight == 0 && tile(t) == nullptr) {
        return;
    }
    editTile(t)[cell(x, y)] = weight;
}

void WeightMask::set(std::size_t texel, Weight weight) {
    const auto width = static_cast<std::size_t>(mWidth);
    set(static_cast<int>(texel % width), static_cast<int>(texel / width), weight);
}

WeightMask::Tile& WeightMask::editTile(int index) {
    std::shared_ptr<const Tile>& tile = mTiles[static_cast<std::size_t>(index)];
    if (tile == nullptr) {
        tile = std::make_shared<Tile>(); // value-initialized: zero
    } else if (tile.use_count() > 1) {
        tile = std::make_shared<Tile>(*tile);
    }
    // Ours alone: made non-const by make_shared<Tile> above or earlier.
    return const_cast<Tile&>(*tile);
}

TexelRect WeightMask::tileRect(int index) const {
    const int x = index % mTilesX * kTileSize;
    const int y = index / mTilesX * kTileSize;
    return {x, y, std::min(kTileSize, mWidth - x), std::min(kTileSize, mHeight - y)};
}

bool WeightMask::isZero() const {
    return std::all_of(mTiles.begin(), mTiles.end(),
                       [](const auto& tile) { return tile == nullptr || isAllZero(*tile); });
}

std::size_t WeightMask::countNonZero() const {
    std::size_t count = 0;
    forEachNonZero([&](std::size_t, Weight) { ++count; });
    return count;
}

TexelRect WeightMask::bounds() const {
    TexelRect rect;
    for (int t = 0; t < tileCount(); ++t) {
        if (tile(t) != nullptr && !isAllZero(*tile(t))) {
            rect = unite(rect, tileRect(t));
        }
    }
    return rect;
}

void WeightMask::compact(const WeightMask& like) {
    CELADON_ASSERT(like.mTiles.size() == mTiles.size());
    for (std::size_t t = 0; t < mTiles.size(); ++t) {
        auto& tile = mTiles[t];
        if (tile == nullptr || tile == fullTile()) {
            continue;
        }
        if (isAllZero(*tile)) {
            tile.reset();
        } else if (*tile == *fullTile()) {
            tile = fullTile();
        } else if (like.mTiles[t] != nullptr && *tile == *like.mTiles[t]) {
            tile = like.mTiles[t];
        }
    }
}

std::size_t WeightMask::bytesBeyond(const WeightMask& other) const {
    std::vector<const Tile*> own;
    for (std::size_t t = 0; t < mTiles.size(); ++t) {
        const bool isShared = t < other.mTiles.size() && other.mTiles[t] == mTiles[t];
        if (mTiles[t] != nullptr && !isShared) {
            own.push_back(mTiles[t].get());
        }
    }
    std::sort(own.begin(), own.end()); // full tiles are often one
    const auto last = std::unique(own.begin(), own.end());
    return (mTiles.size() + other.mTiles.size()) * sizeof(mTiles.front()) +
           static_cast<std::size_t>(last - own.begin()) * sizeof(Tile);
}

bool WeightMask::operator==(const WeightMask& other) const {
    if (mWidth != other.mWidth || mHeight != other.mHeight) {
        return false;
    }
    static const Tile kZero{};
    for (int t = 0; t < tileCount(); ++t) {
        const Tile* a = tile(t);
        const Tile* b = other.tile(t);
        if (a != b && (a == nullptr ? kZero : *a) != (b == nullptr ? kZero : *b)) {
            return false;
        }
    }
    return true;
}

WeightMask::Weight weightFromFloat(float value) {
    if (!(value > 0.0f)) {
        return 0;
    }
    return value >= 1.0f ? WeightMask::kFull
                         : static_cast<WeightMask::Weight>(value * 65535.0f + 0.5f);
}

} // namespace celadon::subedit
