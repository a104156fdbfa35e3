#pragma once

#include "renderer/raster/triangle_setup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// How the samples of a band of rows lie in memory while triangles are filled: in cells, whose
/// samples are tested together by vector code. A cell is a pixel with its places, or where each
/// pixel has but one, some pixels of a row.
namespace celadon {

/// From the lower left corner of a pixel, in subpixels.
struct SamplePlace {
    std::int32_t x, y;
};

class SampleCells {
public:
    using Int4 [[gnu::vector_size(16)]] = std::int32_t;
    static constexpr int kLanes = 8; ///< samples tested at once

    SampleCells() = default;
    /// @param places  of each pixel, at least one
    SampleCells(std::span<const SamplePlace> places, glm::ivec2 pictureSize);

    /// Pixels of a row that a cell has.
    [[nodiscard]] int width() const { return 1 << mWidthLog2; }
    /// Cells in a row.
    [[nodiscard]] int columns() const { return (mSize.x + width() - 1) >> mWidthLog2; }
    /// Samples of a cell, by kLanes. The last may repeat the first place.
    [[nodiscard]] std::size_t groups() const { return mX.size() / kLanes; }
    /// Of each sample, from the cell's lower left corner, in subpixels.
    [[nodiscard]] std::span<const std::int32_t> x() const { return mX; }
    [[nodiscard]] std::span<const std::int32_t> y() const { return mY; }
    /// Both, x in the lower 16 bits.
    [[nodiscard]] std::span<const std::int32_t> packed() const { return mPacked; }
    /// Of a triangle: least x and y, greatest x and y.
    [[nodiscard, gnu::always_inline]] static Int4 boxOf(const std::array<ScreenVertex, 3>& t) {
        const Int4 a{t[0].x, t[0].y, t[0].x, t[0].y};
        const Int4 b{t[1].x, t[1].y, t[1].x, t[1].y};
        const Int4 c{t[2].x, t[2].y, t[2].x, t[2].y};
        // Both sides at once: the greatest is the least of inverted bits, inverted.
        return least(least(a ^ kHigh, b ^ kHigh), c ^ kHigh) ^ kHigh;
    }
    /// Pixels whose samples may lie in a box: first column and row, last column and row, within the
    /// picture. A last one before the first: there are none.
    [[nodiscard, gnu::always_inline]] Int4 pixelsOf(Int4 box) const {
        static_assert(kSubpixels == 1 << 8);
        return greatest(least((box + mToPlaces) >> 8, mLast), mFirst);
    }
    [[nodiscard]] RasterRange cellsOf(RasterRange pixels) const {
        return {pixels.first >> mWidthLog2, pixels.last >> mWidthLog2};
    }

private:
    static constexpr Int4 kHigh{0, 0, -1, -1};
    [[gnu::always_inline]] static Int4 least(Int4 a, Int4 b) { return a < b ? a : b; }
    [[gnu::always_inline]] static Int4 greatest(Int4 a, Int4 b) { return a > b ? a : b; }

    int mWidthLog2 = 0;
    glm::ivec2 mSize{0};
    Int4 mToPlaces{}, mFirst{}, mLast{}; ///< for pixelsOf()
    std::vector<std::int32_t> mX, mY, mPacked;
};

/// What the samples of some rows see: [row][cell][lane]; 0 where nothing is seen.
struct SampleBand {
    RasterRange rows{0, -1};
    std::vector<std::uint32_t> triangles;
    std::vector<float> depths;
    std::vector<float> centerDepths;  ///< of cells of one pixel; undefined where nothing is seen
    std::vector<RasterRange> touched; ///< cells of each row that see something, and between them
};

struct FilledTriangle {
    std::array<ScreenVertex, 3> corners;
    std::uint32_t number; ///< what samples that see it get
    /// Whether there is no surface at a sample, by its place on the picture in subpixels; null:
    /// there is everywhere.
    const std::function<bool(std::int32_t x, std::int32_t y)>* isHole;
};

/// Samples inside a triangle and nearer than what they saw see it from then on.
using FillFunction = void (*)(const SampleCells&, SampleBand&, const FilledTriangle&);

/// By the vector instructions that this machine has; all fill alike.
[[nodiscard]] FillFunction chooseFillFunction();

} // namespace celadon
