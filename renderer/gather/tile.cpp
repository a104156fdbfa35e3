#include "renderer/gather/tile.h"

#include <algorithm>

namespace celadon {

namespace {

/// Pixel of a lane within the tile.
glm::ivec2 pixelOf(int lane) {
    const int quarter = lane / 16;
    const int within = lane % 16;
    return {(quarter % 2) * 4 + within % 4, (quarter / 2) * 4 + within / 4};
}

} // namespace

TileLoader::TileLoader(const GatherMaterials& materials)
    : mMaterials(materials),
      mCodes(materials.isHomogeneous() ? 0 : gather::kTilePixels * materials.largestProfile()) {
    tile.profiles = mCodes.empty() ? nullptr : mCodes.data();
    tile.profileStride = static_cast<int>(materials.largestProfile());
}

bool TileLoader::load(const ViewTexels& level, glm::ivec2 corner) {
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
        const std::size_t i =
            4 * (std::size_t(pixel.y) * std::size_t(level.size.x) + std::size_t(pixel.x));
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
        if (!mCodes.empty()) {
            mMaterials.encode(material, {level.surfaces[i], level.surfaces[i + 1]},
                              mCodes.data() + lane * tile.profileStride);
        }
        any = {position[0], position[1], position[2]};
        bounds.add(any);
        ++mCovered;
    }
    if (mCovered == 0) {
        return false;
    }
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        std::fill_n(tile.sums[lane], 4, 0.0f);
        if (tile.rangeMm[lane] == 0.0f) { // not covered: finite numbers that are not counted
            tile.x[lane] = any.x;
            tile.y[lane] = any.y;
            tile.z[lane] = any.z;
        }
    }
    return true;
}

void TileLoader::store(const ViewTexels& level, glm::ivec2 corner, std::uint64_t pairs) const {
    const float pairsPerPixel = static_cast<float>(pairs) / static_cast<float>(mCovered);
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        if (tile.rangeMm[lane] == 0.0f) {
            continue;
        }
        const glm::ivec2 pixel = corner + pixelOf(lane);
        float* out = level.exitance +
                     4 * (std::size_t(pixel.y) * std::size_t(level.size.x) + std::size_t(pixel.x));
        for (std::size_t c = 0; c < 3; ++c) {
            out[c] += tile.sums[lane][c];
        }
        out[3] += pairsPerPixel;
    }
}

} // namespace celadon
