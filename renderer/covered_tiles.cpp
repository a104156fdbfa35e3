#include "renderer/covered_tiles.h"

#include <glm/common.hpp>

#include <algorithm>
#include <functional>

namespace celadon {

namespace {

constexpr GLuint kTilesBinding = 6; ///< storage, as covered_group.glsl has it

std::size_t indexOf(glm::ivec2 tile, glm::ivec2 tiles) {
    return static_cast<std::size_t>(tile.y) * static_cast<std::size_t>(tiles.x) +
           static_cast<std::size_t>(tile.x);
}

void dispatchList(const gl::Program& program, const gl::Buffer& tiles, int count) {
    if (count > 0) {
        tiles.bindStorage(kTilesBinding);
        program.dispatchGroups(count, glm::ivec2(CoveredTiles::kTilePx));
    }
}

} // namespace

CoveredTiles::CoveredTiles(glm::ivec2 size, int levels) {
    for (int k = 0; k < levels; ++k) {
        Level level;
        level.tiles = (size + kTilePx - 1) / kTilePx;
        const auto count = static_cast<std::size_t>(level.tiles.x * level.tiles.y);
        level.covered.resize(count);
        level.list =
            gl::Buffer("covered tiles", count * sizeof(std::uint32_t), gl::BufferUse::Update);
        mLevels.push_back(std::move(level));
        size = (size + 1) / 2;
    }
}

void CoveredTiles::find(std::span<const std::uint32_t> triangles, glm::ivec2 size,
                        const CoveredTiles* others) {
    Level& first = mLevels.front();
    if (others != nullptr) {
        first.covered = others->mLevels.front().covered;
    } else {
        first.covered.assign(first.covered.size(), false);
    }
    const auto width = static_cast<std::size_t>(size.x);
    for (std::size_t row = 0; row < triangles.size() / width; ++row) {
        const int y = static_cast<int>(row % static_cast<std::size_t>(size.y));
        for (int tile = 0; tile * kTilePx < size.x; ++tile) {
            const auto begin =
                triangles.begin() + static_cast<std::ptrdiff_t>(row * width) + tile * kTilePx;
            const int length = std::min(kTilePx, size.x - tile * kTilePx);
            if (std::any_of(begin, begin + length, [](std::uint32_t t) { return t != 0; })) {
                first.covered[indexOf({tile, y / kTilePx}, first.tiles)] = true;
            }
        }
    }
    for (std::size_t k = 1; k < mLevels.size(); ++k) {
        const Level& finer = mLevels[k - 1];
        Level& level = mLevels[k];
        level.covered.assign(level.covered.size(), false);
        for (int y = 0; y < finer.tiles.y; ++y) {
            for (int x = 0; x < finer.tiles.x; ++x) {
                const glm::ivec2 parent = glm::min(glm::ivec2(x, y) / 2, level.tiles - 1);
                if (finer.covered[indexOf({x, y}, finer.tiles)]) {
                    level.covered[indexOf(parent, level.tiles)] = true;
                }
            }
        }
    }
    for (Level& level : mLevels) {
        level.count = write(level.covered, level.tiles, level.list);
    }
}

glm::ivec4 CoveredTiles::bounds() const {
    const Level& first = mLevels.front();
    glm::ivec2 low = first.tiles;
    glm::ivec2 high(-1);
    for (int y = 0; y < first.tiles.y; ++y) {
        for (int x = 0; x < first.tiles.x; ++x) {
            if (first.covered[indexOf({x, y}, first.tiles)]) {
                low = glm::min(low, glm::ivec2(x, y));
                high = glm::max(high, glm::ivec2(x, y));
            }
        }
    }
    return high.x < 0 ? glm::ivec4(0) : kTilePx * glm::ivec4(low, high - low + 1);
}

int CoveredTiles::write(const std::vector<bool>& mask, glm::ivec2 tiles, gl::Buffer& list) {
    std::vector<std::uint32_t> result;
    for (int y = 0; y < tiles.y; ++y) {
        for (int x = 0; x < tiles.x; ++x) {
            if (mask[indexOf({x, y}, tiles)]) {
                result.push_back(static_cast<std::uint32_t>(x) +
                                 65536u * static_cast<std::uint32_t>(y));
            }
        }
    }
    list.write(result);
    return static_cast<int>(result.size());
}

void CoveredTiles::dispatch(const gl::Program& program, int level) const {
    const Level& tiles = mLevels[static_cast<std::size_t>(level)];
    dispatchList(program, tiles.list, tiles.count);
}

void TouchedTiles::dispatch(const gl::Program& program, const CoveredTiles& tiles, int level) {
    const CoveredTiles::Level& now = tiles.mLevels[static_cast<std::size_t>(level)];
    if (mCovered.size() != now.covered.size()) {
        mCovered.assign(now.covered.size(), true); // nobody wrote the background yet
        mList = gl::Buffer("touched tiles", mCovered.size() * sizeof(std::uint32_t),
                           gl::BufferUse::Update);
    }
    add(tiles, level);
    dispatchList(program, mList, CoveredTiles::write(mCovered, now.tiles, mList));
    mCovered = now.covered;
}

void TouchedTiles::add(const CoveredTiles& tiles, int level) {
    const std::vector<bool>& also = tiles.mLevels[static_cast<std::size_t>(level)].covered;
    std::transform(mCovered.begin(), mCovered.end(), also.begin(), mCovered.begin(),
                   std::logical_or());
}

} // namespace celadon
