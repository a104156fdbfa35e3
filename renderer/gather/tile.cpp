#include "renderer/gather/tile.h"

#include <algorithm>
#include <limits>

namespace celadon {

namespace {

/// Pixel of a lane within the tile.
glm::ivec2 pixelOf(int lane) {
    const int quarter = lane / 16;
    const int within = lane % 16;
    return {(quarter % 2) * 4 + within % 4, (quarter / 2) * 4 + within / 4};
}

/// Of a lane's pixel in a level's texels; it must lie within.
std::size_t indexOf(const ViewTexels& level, glm::ivec2 corner, int lane) {
    const glm::ivec2 pixel = corner + pixelOf(lane);
    return 4 * (std::size_t(pixel.y) * std::size_t(level.size.x) + std::size_t(pixel.x));
}

} // namespace

TileLoader::TileLoader(const GatherMaterials& materials)
    : mMaterials(materials),
      mCodes(materials.isHomogeneous() ? 0 : gather::kTilePixels * materials.largestProfile()) {
    tile.profiles = mCodes.empty() ? nullptr : mCodes.data();
    tile.profileStride = static_cast<int>(materials.largestProfile());
}

bool TileLoader::locate(const ViewTexels& level, glm::ivec2 corner) {
    bounds = {};
    mCovered = 0;
    glm::vec3 any(0.0f);
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        tile.rangeMm[lane] = 0.0f;
        tile.perMm[lane] = 0.0f;
        tile.lastSegment[lane] = 0.0f;
        const glm::ivec2 pixel = corner + pixelOf(lane);
        if (pixel.x >= level.size.x || pixel.y >= level.size.y) {
            continue;
        }
        const std::size_t i = indexOf(level, corner, lane);
        const float* position = level.positions + i;
        const int material = static_cast<int>(level.surfaces[i + 2]);
        if (!(position[3] > 0.0f) || level.surfaces[i + 2] < 0.0f) {
            continue;
        }
        const gather::Knots knots = mMaterials.knots(material);
        tile.x[lane] = position[0];
        tile.y[lane] = position[1];
        tile.z[lane] = position[2];
        tile.perMm[lane] = knots.perMm;
        tile.rangeMm[lane] = knots.rangeMm;
        tile.lastSegment[lane] = static_cast<float>(knots.segments - 1);
        any = {position[0], position[1], position[2]};
        bounds.add(any);
        ++mCovered;
    }
    if (mCovered == 0) {
        return false;
    }
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        if (tile.rangeMm[lane] == 0.0f) { // not covered: finite numbers that are not counted
            tile.x[lane] = any.x;
            tile.y[lane] = any.y;
            tile.z[lane] = any.z;
        }
    }
    return true;
}

bool TileLoader::dependsOn(const ViewTexels& level, glm::ivec2 corner,
                           std::span<const TexelChange> changes) const {
    if (changes.empty()) {
        return false;
    }
    glm::vec2 low(std::numeric_limits<float>::infinity());
    glm::vec2 high = -low;
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        if (tile.rangeMm[lane] > 0.0f) {
            const float* surface = level.surfaces + indexOf(level, corner, lane);
            low = glm::min(low, glm::vec2(surface[0], surface[1]));
            high = glm::max(high, glm::vec2(surface[0], surface[1]));
        }
    }
    for (const TexelChange& change : changes) {
        if (!mMaterials.mayDependOn(change.material, low, high, change.rect)) {
            continue; // nearly all of them
        }
        for (int lane = 0; lane < gather::kTilePixels; ++lane) {
            if (tile.rangeMm[lane] == 0.0f) {
                continue;
            }
            const float* surface = level.surfaces + indexOf(level, corner, lane);
            if (static_cast<int>(surface[2]) == change.material &&
                mMaterials.dependsOn(change.material, {surface[0], surface[1]}, change.rect)) {
                return true;
            }
        }
    }
    return false;
}

void TileLoader::loadProfiles(const ViewTexels& level, glm::ivec2 corner) {
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        std::fill_n(tile.sums[lane], 4, 0.0f);
        if (!mCodes.empty() && tile.rangeMm[lane] > 0.0f) {
            const float* surface = level.surfaces + indexOf(level, corner, lane);
            mMaterials.encode(static_cast<int>(surface[2]), {surface[0], surface[1]},
                              mCodes.data() + lane * tile.profileStride);
        }
    }
}

void TileLoader::store(const ViewTexels& level, glm::ivec2 corner, std::uint64_t pairs) const {
    const float pairsPerPixel = static_cast<float>(pairs) / static_cast<float>(mCovered);
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        if (tile.rangeMm[lane] == 0.0f) {
            continue;
        }
        float* out = level.exitance + indexOf(level, corner, lane);
        std::copy_n(tile.sums[lane], 3, out);
        out[3] = pairsPerPixel;
    }
}

void TileLoader::add(const ViewTexels& level, glm::ivec2 corner) const {
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        if (tile.rangeMm[lane] == 0.0f) {
            continue;
        }
        float* out = level.exitance + indexOf(level, corner, lane);
        for (int c = 0; c < 3; ++c) {
            out[c] = std::max(out[c] + tile.sums[lane][c], 0.0f);
        }
    }
}

} // namespace celadon
