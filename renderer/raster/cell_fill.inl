// Filling a triangle, a cell of samples at a time. CELADON_FILL_FUNCTION names what is compiled.
#include "renderer/raster/cell_fill.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace celadon {

namespace {

/// Of a sample's depth over w: what a plane may come to at the pixel's center, if not 0 or less.
constexpr float kLeastCenterDepth = 1e-3f;
/// Subpixels along which edge functions fit into 32 bits over a cell more, and their steps into 16.
constexpr std::int32_t kSmall = 16 * kSubpixels;
constexpr int kFewCells = 4; ///< in a row: testing each is quicker than finding those inside

constexpr std::size_t kLanes = SampleCells::kLanes;
using Int4 = SampleCells::Int4;
using Int8 [[gnu::vector_size(32)]] = std::int32_t;
using Long8 [[gnu::vector_size(64)]] = std::int64_t;
using Float8 [[gnu::vector_size(32)]] = float;
using Double8 [[gnu::vector_size(64)]] = double;

template<class Vector, class T>
Vector load(const T* from) {
    Vector vector;
    std::memcpy(&vector, from, sizeof(vector));
    return vector;
}

inline bool any(Int8 mask) {
#ifdef __AVX2__
    const __m256i bits = reinterpret_cast<__m256i>(mask);
    return _mm256_testz_si256(bits, bits) == 0;
#else
    std::int64_t words[4];
    std::memcpy(words, &mask, sizeof(words));
    return (words[0] | words[1] | words[2] | words[3]) != 0;
#endif
}

/// across * x + up * y of the samples of a cell. @param across, up  of 16 bits
inline Int8 dot(const SampleCells& cells, std::size_t group, std::int32_t across, std::int32_t up) {
#ifdef __AVX2__
    const __m256i factors = _mm256_set1_epi32((across & 0xffff) | (up << 16));
    const __m256i places =
        reinterpret_cast<__m256i>(load<Int8>(cells.packed().data() + group * kLanes));
    return reinterpret_cast<Int8>(_mm256_madd_epi16(places, factors));
#else
    return load<Int8>(cells.x().data() + group * kLanes) * across +
           load<Int8>(cells.y().data() + group * kLanes) * up;
#endif
}

/// Depth over the lanes of a cell, and what samples keep of a triangle.
class CellDepths {
public:
    CellDepths(const SampleCells& cells, SampleBand& band, const FilledTriangle& triangle)
        : mCells(cells), mBand(band), mTriangle(triangle) {}

    [[nodiscard]] bool hasPlane() const { return mHasPlane; }
    void setPlane(const DepthPlane& plane) {
        mPlane = plane;
        mHasPlane = true;
        setGroup(mGroup);
    }
    /// Which samples of cells are meant from now on.
    void setGroup(std::size_t group) {
        mGroup = group;
        if (mHasPlane) {
            const Int8 x = load<Int8>(mCells.x().data() + group * kLanes);
            const Int8 y = load<Int8>(mCells.y().data() + group * kLanes);
            mLanes = mPlane.across * __builtin_convertvector(x, Double8) +
                     mPlane.up * __builtin_convertvector(y, Double8);
        }
    }

    /// Those of a cell that lie inside. A plane is set.
    void fill(Int8 inside, int column, int row) {
        const int width = mCells.width();
        const auto r = static_cast<std::size_t>(row - mBand.rows.first);
        const std::size_t cell =
            r * static_cast<std::size_t>(mCells.columns()) + static_cast<std::size_t>(column);
        const std::size_t i = (cell * mCells.groups() + mGroup) * kLanes;
        const std::int32_t left = column * width * kSubpixels;
        const std::int32_t low = row * kSubpixels;
        const double corner = mPlane.at(left, low);
        const Double8 depths = corner + mLanes;
        Float8 z = __builtin_convertvector(depths, Float8);
        z = z < mPlane.least ? mPlane.least + Float8{} : z;
        z = z > mPlane.greatest ? mPlane.greatest + Float8{} : z;
        const Float8 before = load<Float8>(mBand.depths.data() + i);
        Int8 isNearer = inside & (z > before);
        if (mTriangle.isHole != nullptr) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const std::size_t place = mGroup * kLanes + lane;
                if (isNearer[lane] != 0 &&
                    (*mTriangle.isHole)(left + mCells.x()[place], low + mCells.y()[place])) {
                    isNearer[lane] = 0;
                }
            }
        }
        if (!any(isNearer)) {
            return;
        }
        RasterRange& touched = mBand.touched[r];
        touched = {std::min(touched.first, column), std::max(touched.last, column)};
        keep(isNearer, z, before, mBand.depths.data() + i);
        const auto number = static_cast<std::int32_t>(mTriangle.number);
        keep(isNearer, number + Int8{}, load<Int8>(mBand.triangles.data() + i),
             mBand.triangles.data() + i);
        if (width == 1) {
            constexpr double kMiddle = kSubpixels / 2;
            const auto plane =
                static_cast<float>(corner + mPlane.across * kMiddle + mPlane.up * kMiddle);
            const Float8 least = kLeastCenterDepth * z;
            keep(isNearer, plane > least ? plane + Float8{} : least,
                 load<Float8>(mBand.centerDepths.data() + i), mBand.centerDepths.data() + i);
        }
    }

private:
    template<class Vector, class T>
    static void keep(Int8 mask, const Vector& now, const Vector& before, T* to) {
        const Vector kept = mask ? now : before;
        std::memcpy(to, &kept, sizeof(kept));
    }

    const SampleCells& mCells;
    SampleBand& mBand;
    const FilledTriangle& mTriangle;
    std::size_t mGroup = 0;
    bool mHasPlane = false; ///< once some sample is inside
    DepthPlane mPlane;
    Double8 mLanes{}; ///< depths of the group's samples less that of their cell's corner
};

/// Of few pixels: all edges are set up at once, in 32 bits.
void fillSmall(const SampleCells& cells, SampleBand& band, const FilledTriangle& triangle,
               RasterRange columns, RasterRange rows) {
    const std::array<ScreenVertex, 3>& t = triangle.corners;
    const std::int32_t left = columns.first * cells.width() * kSubpixels;
    const std::int32_t low = rows.first * kSubpixels;
    const Int4 x = Int4{t[0].x, t[1].x, t[2].x, 0} - left;
    const Int4 y = Int4{t[0].y, t[1].y, t[2].y, 0} - low;
    constexpr Int4 kNext{1, 2, 0, 3};
    Int4 across = y - __builtin_shuffle(y, kNext);
    Int4 up = __builtin_shuffle(x, kNext) - x;
    Int4 edge = -(across * x + up * y); // at the lower left corner of the first cell
    const std::int32_t area = edge[0] + edge[1] + edge[2];
    if (area == 0) {
        return;
    }
    if (area < 0) {
        across = -across;
        up = -up;
        edge = -edge;
    }
    // Of an edge and its reverse, one counts points on it as inside (as EdgeFunction).
    edge += ~((across > 0) | ((across == 0) & (up < 0)));
    const Int4 toNextCell = across * (cells.width() * kSubpixels);
    const Int4 toNextRow = up * kSubpixels;
    CellDepths depths(cells, band, triangle);
    for (std::size_t group = 0; group < cells.groups(); ++group) {
        depths.setGroup(group);
        const Int8 offset0 = dot(cells, group, across[0], up[0]);
        const Int8 offset1 = dot(cells, group, across[1], up[1]);
        const Int8 offset2 = dot(cells, group, across[2], up[2]);
        Int4 first = edge;
        for (int row = rows.first; row <= rows.last; ++row) {
            Int4 at = first;
            for (int column = columns.first; column <= columns.last; ++column) {
                const Int8 inside =
                    ((offset0 + at[0]) | (offset1 + at[1]) | (offset2 + at[2])) >= 0;
                if (any(inside)) {
                    if (!depths.hasPlane()) {
                        depths.setPlane(DepthPlane(t, area));
                    }
                    depths.fill(inside, column, row);
                }
                at += toNextCell;
            }
            first += toNextRow;
        }
    }
}

/// Of any size.
class LargeFill {
public:
    LargeFill(const SampleCells& cells, SampleBand& band, const FilledTriangle& triangle,
              std::int64_t area)
        : mCells(cells),
          mDepths(cells, band, triangle),
          mEdges(edgesOf(triangle.corners, area > 0)) {
        mDepths.setPlane(DepthPlane(triangle.corners, area));
    }

    void fill(RasterRange columns, RasterRange rows) {
        const bool areFew = columns.last - columns.first < kFewCells;
        for (int row = rows.first; row <= rows.last; ++row) {
            const RasterRange range = areFew ? columns : narrowed(columns, row);
            for (std::size_t group = 0; group < mCells.groups(); ++group) {
                fillRow(range, row, group);
            }
        }
    }

private:
    using Edges = std::array<EdgeFunction, 3>;
    static Edges edgesOf(std::array<ScreenVertex, 3> t, bool isCounterClockwise) {
        if (!isCounterClockwise) {
            std::swap(t[1], t[2]);
        }
        return {EdgeFunction(t[0], t[1]), EdgeFunction(t[1], t[2]), EdgeFunction(t[2], t[0])};
    }

    /// Cells of a row that may have samples inside.
    [[nodiscard]] RasterRange narrowed(RasterRange columns, int row) const {
        const std::int64_t y = std::int64_t{row} * kSubpixels;
        for (const EdgeFunction& edge : mEdges) {
            const std::int64_t x = std::int64_t{columns.first} * mCells.width() * kSubpixels;
            std::int64_t first = INT64_MIN; // the greatest of the first cell's samples
            for (std::size_t lane = 0; lane < mCells.x().size(); ++lane) {
                first = std::max(first, edge.at(x + mCells.x()[lane], y + mCells.y()[lane]));
            }
            const std::int64_t step = edge.stepAcross() * mCells.width();
            if (step <= 0 && first < 0) {
                return {0, -1};
            }
            if (step > 0 && first < 0) {
                columns.first += static_cast<int>(
                    std::min<std::int64_t>((-first + step - 1) / step, std::int64_t{1} << 20));
            } else if (step < 0) {
                columns.last = static_cast<int>(
                    std::min<std::int64_t>(columns.last, columns.first + first / -step));
            }
        }
        return columns;
    }

    void fillRow(RasterRange columns, int row, std::size_t group) {
        mDepths.setGroup(group);
        const auto x =
            __builtin_convertvector(load<Int8>(mCells.x().data() + group * kLanes), Long8);
        const auto y =
            __builtin_convertvector(load<Int8>(mCells.y().data() + group * kLanes), Long8);
        const std::int64_t left = std::int64_t{columns.first} * mCells.width() * kSubpixels;
        const std::int64_t low = std::int64_t{row} * kSubpixels;
        std::array<Long8, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = mEdges[k].at(left, low) + x * (mEdges[k].stepAcross() / kSubpixels) +
                    y * (mEdges[k].stepUp() / kSubpixels);
        }
        for (int column = columns.first; column <= columns.last; ++column) {
            const Int8 inside = __builtin_convertvector((at[0] | at[1] | at[2]) >= 0, Int8);
            if (any(inside)) {
                mDepths.fill(inside, column, row);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                at[k] += mEdges[k].stepAcross() * mCells.width();
            }
        }
    }

    const SampleCells& mCells;
    CellDepths mDepths;
    Edges mEdges;
};

} // namespace

void CELADON_FILL_FUNCTION(const SampleCells& cells, SampleBand& band,
                           const FilledTriangle& triangle) {
    const std::array<ScreenVertex, 3>& t = triangle.corners;
    const Int4 box = SampleCells::boxOf(t);
    const Int4 pixels = cells.pixelsOf(box);
    const RasterRange columns = cells.cellsOf({pixels[0], pixels[2]});
    const RasterRange rows{std::max(pixels[1], band.rows.first),
                           std::min(pixels[3], band.rows.last)};
    if (std::max(box[2] - box[0], box[3] - box[1]) <= kSmall) {
        fillSmall(cells, band, triangle, columns, rows);
        return;
    }
    const std::int64_t area = (std::int64_t{t[1].x} - t[0].x) * (std::int64_t{t[2].y} - t[0].y) -
                              (std::int64_t{t[2].x} - t[0].x) * (std::int64_t{t[1].y} - t[0].y);
    if (area != 0) {
        LargeFill(cells, band, triangle, area).fill(columns, rows);
    }
}

} // namespace celadon
