#include "renderer/raster/sample_cells.h"

#include "renderer/raster/cell_fill.h"

#include <algorithm>
#include <limits>

namespace celadon {

static_assert(SampleCells::kLanes == 1 << 3);

SampleCells::SampleCells(std::span<const SamplePlace> places, glm::ivec2 pictureSize)
    : mWidthLog2(places.size() == 1 ? 3 : 0), mSize(pictureSize) {
    SamplePlace least = places.front();
    SamplePlace greatest = places.front();
    for (const SamplePlace place : places) {
        least = {std::min(least.x, place.x), std::min(least.y, place.y)};
        greatest = {std::max(greatest.x, place.x), std::max(greatest.y, place.y)};
        for (int pixel = 0; pixel < width(); ++pixel) {
            mX.push_back(place.x + pixel * kSubpixels);
            mY.push_back(place.y);
        }
    }
    // A pixel's samples end at its greatest place, and begin at its least; shifts round down.
    constexpr int kUp = kSubpixels - 1;
    mToPlaces = Int4{kUp - greatest.x, kUp - greatest.y, -least.x, -least.y};
    mFirst = Int4{0, 0, std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};
    mLast = Int4{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), mSize.x - 1,
                 mSize.y - 1};
    while (mX.size() % kLanes != 0) {
        mX.push_back(mX.front());
        mY.push_back(mY.front());
    }
    for (std::size_t lane = 0; lane < mX.size(); ++lane) {
        mPacked.push_back(mX[lane] | (mY[lane] << 16));
    }
}

FillFunction chooseFillFunction() {
#ifdef CELADON_RASTER_X86
    if (__builtin_cpu_supports("avx2")) {
        return fillCellsAvx2;
    }
#endif
    return fillCellsPortable;
}

} // namespace celadon
