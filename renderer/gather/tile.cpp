#include "renderer/gather/tile.h"

#include <algorithm>

namespace celadon {

TileLoader::TileLoader(const GatherMaterials& materials)
    : mMaterials(materials),
      mCodes(materials.isHomogeneous()
                 ? 0
                 : gather::kTilePixels * materials.largestProfile() + gather::kCodesBehind) {
    tile.profiles = mCodes.empty() ? nullptr : mCodes.data();
    tile.profileStride = static_cast<int>(materials.largestProfile());
}

void TileLoader::locate(const ViewTexels& level, PixelTiles::Tile pixels) {
    mLevel = &level;
    mPixels = pixels;
    for (std::size_t lane = 0; lane < gather::kTilePixels; ++lane) {
        // Lanes without a pixel repeat the last one, and are not counted.
        const bool isPixel = lane < pixels.size();
        const std::size_t i = std::size_t{4} * pixels[isPixel ? lane : pixels.size() - 1];
        const float* position = level.positions + i;
        const gather::Knots knots =
            isPixel ? mMaterials.knots(static_cast<int>(level.surfaces[i + 2])) : gather::Knots{};
        tile.x[lane] = position[0];
        tile.y[lane] = position[1];
        tile.z[lane] = position[2];
        tile.perMm[lane] = knots.perMm;
        tile.rangeMm[lane] = knots.rangeMm;
        tile.lastSegment[lane] = isPixel ? static_cast<float>(knots.segments - 1) : 0.0f;
    }
}

bool TileLoader::dependsOn(const ChangedTexels& changed) const {
    for (std::size_t lane = 0; lane < mPixels.size(); ++lane) {
        const float* const at = surface(lane);
        if (changed.touch(static_cast<int>(at[2]), {at[0], at[1]})) {
            return true;
        }
    }
    return false;
}

void TileLoader::loadProfiles() {
    for (auto& sum : tile.sums) {
        std::fill_n(sum, 4, 0.0f);
    }
    std::uint16_t* codes = mCodes.data();
    for (std::size_t lane = 0; !mCodes.empty() && lane < mPixels.size(); ++lane) {
        const float* const at = surface(lane);
        mMaterials.encode(static_cast<int>(at[2]), {at[0], at[1]}, codes);
        codes += tile.profileStride;
    }
}

void TileLoader::store(std::uint64_t pairs) const {
    const float pairsPerPixel = static_cast<float>(pairs) / static_cast<float>(mPixels.size());
    for (std::size_t lane = 0; lane < mPixels.size(); ++lane) {
        float* const out = exitance(lane);
        std::copy_n(tile.sums[lane], 3, out);
        out[3] = pairsPerPixel;
    }
}

void TileLoader::add() const {
    for (std::size_t lane = 0; lane < mPixels.size(); ++lane) {
        float* const out = exitance(lane);
        for (int c = 0; c < 3; ++c) {
            out[c] = std::max(out[c] + tile.sums[lane][c], 0.0f);
        }
    }
}

} // namespace celadon
