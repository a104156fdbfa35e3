#include "renderer/covered_tiles.h"

#include <glm/common.hpp>

#include <algorithm>

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
        level.touched.resize(count, true); // nobody wrote the background yet
        const std::size_t bytes = count * sizeof(std::uint32_t);
        level.coveredList = gl::Buffer("covered tiles", bytes, gl::BufferUse::Update);
        level.touchedList = gl::Buffer("touched tiles", bytes, gl::BufferUse::Update);
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
        for (std::size_t i = 0; i < level.covered.size(); ++i) {
            level.touched[i] = level.touched[i] || level.covered[i];
        }
        level.coveredCount = list(level.covered, level.tiles, level.coveredList);
        level.touchedCount = list(level.touched, level.tiles, level.touchedList);
    }
}

int CoveredTiles::list(const std::vector<bool>& mask, glm::ivec2 tiles, gl::Buffer& buffer) {
    std::vector<std::uint32_t> result;
    for (int y = 0; y < tiles.y; ++y) {
        for (int x = 0; x < tiles.x; ++x) {
            if (mask[indexOf({x, y}, tiles)]) {
                result.push_back(static_cast<std::uint32_t>(x) +
                                 65536u * static_cast<std::uint32_t>(y));
            }
        }
    }
    buffer.write(result);
    return static_cast<int>(result.size());
}

void CoveredTiles::dispatch(const gl::Program& program, int level) const {
    const Level& tiles = mLevels[static_cast<std::size_t>(level)];
    dispatchList(program, tiles.coveredList, tiles.coveredCount);
}

void CoveredTiles::dispatchTouched(const gl::Program& program, int level) const {
    const Level& tiles = mLevels[static_cast<std::size_t>(level)];
    dispatchList(program, tiles.touchedList, tiles.touchedCount);
}

void CoveredTiles::touchedDone() {
    for (Level& level : mLevels) {
        level.touched = level.covered;
    }
}

} // namespace celadon
