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
      mCodes(materials.largestProfile()),
      mScratch(materials.largestProfile()) {}

bool TileLoader::load(const ViewTexels& level, glm::ivec2 corner) {
    bounds = {};
    int lanes[gather::kTilePixels];
    int covered = 0;
    int segmentsPerChannel = 0;
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
        segmentsPerChannel = std::max(segmentsPerChannel, knots.segments);
        any = {position[0], position[1], position[2]};
        bounds.add(any);
        lanes[covered++] = lane;
    }
    mCovered = covered;
    if (covered == 0) {
        return false;
    }
    tile.pixels = gather::kTilePixels;
    tile.segmentsPerChannel = segmentsPerChannel;
    for (int lane = 0; lane < gather::kTilePixels; ++lane) {
        for (auto& sums : tile.sums) {
            sums[lane] = 0.0f;
        }
        if (tile.rangeMm[lane] == 0.0f) { // not covered: finite numbers that are not counted
            tile.x[lane] = any.x;
            tile.y[lane] = any.y;
            tile.z[lane] = any.z;
        }
    }
    if (mMaterials.isHomogeneous()) {
        tile.segments = nullptr;
        return true;
    }
    const auto perChannel = static_cast<std::size_t>(segmentsPerChannel) * gather::kTilePixels;
    mSegments.resize(3 * perChannel);
    for (int l = 0; l < covered; ++l) {
        const int lane = lanes[l];
        const glm::ivec2 pixel = corner + pixelOf(lane);
        const float* surface =
            level.surfaces +
            4 * (std::size_t(pixel.y) * std::size_t(level.size.x) + std::size_t(pixel.x));
        const int material = static_cast<int>(surface[2]);
        mMaterials.encode(material, {surface[0], surface[1]}, mScratch.data(), mCodes.data());
        const auto segments = static_cast<std::size_t>(mMaterials.map(material).segments);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint16_t* codes = mCodes.data() + c * (segments + 1);
            std::uint32_t* out = mSegments.data() + c * perChannel + std::size_t(lane);
            for (std::size_t k = 0; k < segments; ++k) {
                out[k * gather::kTilePixels] =
                    std::uint32_t{codes[k]} | (std::uint32_t{codes[k + 1]} << 16);
            }
        }
    }
    tile.segments = mSegments.data();
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
            out[c] += tile.sums[c][lane];
        }
        out[3] += pairsPerPixel;
    }
}

} // namespace celadon
