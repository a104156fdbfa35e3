#include "renderer/raster/triangle_raster.h"

#include "renderer/raster/clip_triangle.h"
#include "renderer/raster/triangle_setup.h"
#include "subedit/assert.h"

#include <glm/common.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <utility>

namespace celadon {

namespace {

constexpr std::uint32_t kChunkTriangles = 4096;
constexpr int kBandRows = 32;
constexpr std::uint32_t kPart = 0x8000'0000u; ///< an entry of a band that is a part of a triangle
constexpr std::size_t kVerticesATask = 8192;
/// Of a sample's depth over w: what a plane may come to at the pixel's center, if not 0 or less.
constexpr float kLeastCenterDepth = 1e-3f;
constexpr int kNarrow = 8; ///< columns: testing each sample is then quicker than finding the span

using Range = RasterRange;

Range samplesBetween(std::int32_t low, std::int32_t high, std::int32_t leastPlace,
                     std::int32_t greatestPlace, int size) {
    const auto ceiling = [](std::int32_t x) { return (x + kSubpixels - 1) >> 8; };
    static_assert(kSubpixels == 1 << 8);
    return {std::max(ceiling(low - greatestPlace), 0),
            std::min((high - leastPlace) >> 8, size - 1)};
}

std::int64_t twiceArea(const std::array<ScreenVertex, 3>& t) {
    return (std::int64_t{t[1].x} - t[0].x) * (std::int64_t{t[2].y} - t[0].y) -
           (std::int64_t{t[2].x} - t[0].x) * (std::int64_t{t[1].y} - t[0].y);
}

/// Columns of a row whose samples lie inside a triangle.
Range span(const std::array<EdgeFunction, 3>& edges, Range columns, std::int64_t x,
           std::int64_t y) {
    for (const EdgeFunction& edge : edges) {
        const std::int64_t first = edge.at(x + std::int64_t{columns.first} * kSubpixels, y);
        const std::int64_t step = edge.stepAcross();
        if (step == 0 && first < 0) {
            return {0, -1};
        }
        if (step > 0 && first < 0) {
            columns.first += static_cast<int>(
                std::min<std::int64_t>((-first + step - 1) / step, std::int64_t{1} << 20));
        } else if (step < 0 && first >= 0) {
            columns.last = static_cast<int>(
                std::min<std::int64_t>(columns.last, columns.first + first / -step));
        } else if (step < 0) {
            return {0, -1};
        }
    }
    return columns;
}

/// Pictures of several sizes take turns: what is there already is neither filled nor given back.
template<class T>
void growTo(std::size_t size, std::vector<T>& values) {
    if (values.size() < size) {
        values.resize(size);
    }
}

} // namespace

struct TriangleRaster::Band {
    int firstRow, lastRow;
};

void TriangleRaster::prepare(std::span<const RasterMesh> meshes, const RasterView& view) {
    mMeshes = meshes;
    mToClip = view.toClip;
    mSize = view.size;
    mLimits.halfSize = glm::vec2(view.size) * (0.5f * kSubpixels);
    mLimits.leastW = 1e-6f;
    mLimits.clampsDepth = view.clampsDepth;
    mHasPlaces = !view.places.empty();
    mPlaces.clear();
    for (const glm::vec2 place : view.places) {
        const glm::ivec2 subpixels(glm::round((place + 0.5f) * float(kSubpixels)));
        mPlaces.push_back({subpixels.x, subpixels.y});
    }
    if (!mHasPlaces) {
        mPlaces.push_back({kSubpixels / 2, kSubpixels / 2});
    }
    mLeast = mGreatest = mPlaces.front();
    for (const Place place : mPlaces) {
        mLeast = {std::min(mLeast.x, place.x), std::min(mLeast.y, place.y)};
        mGreatest = {std::max(mGreatest.x, place.x), std::max(mGreatest.y, place.y)};
    }
    const std::size_t samples = mPlaces.size() * pixels();
    growTo(samples, mTriangles);
    growTo(samples, mDepths);
    growTo(mHasPlaces ? samples : 0, mCenterDepths);
    mFirstVertex.assign(1, 0);
    mFirstTriangle.assign(1, 0);
    for (const RasterMesh& mesh : meshes) {
        mFirstVertex.push_back(mFirstVertex.back() + mesh.vertexCount);
        mFirstTriangle.push_back(mFirstTriangle.back() +
                                 static_cast<std::uint32_t>(mesh.corners.size() / 3));
    }
    CELADON_ASSERT(mFirstTriangle.back() < kPart);
    mScreen.resize(mFirstVertex.back());
}

glm::vec4 TriangleRaster::toClip(const float* position) const {
    return mToClip * glm::vec4(position[0], position[1], position[2], 1.0f);
}

std::array<glm::vec4, 3> TriangleRaster::clipCorners(const RasterMesh& mesh,
                                                     std::uint32_t triangle) const {
    std::array<glm::vec4, 3> clip;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t vertex = mesh.corners[3 * std::size_t{triangle} + i];
        clip[i] = toClip(mesh.vertices + vertex * mesh.vertexFloats);
    }
    return clip;
}

void TriangleRaster::transform() {
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        const RasterMesh& mesh = mMeshes[m];
        ScreenVertex* const screen = mScreen.data() + mFirstVertex[m];
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.vertexCount, kVerticesATask),
                          [&](const auto& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                  screen[i] = toScreen(
                                      toClip(mesh.vertices + i * mesh.vertexFloats), mLimits);
                              }
                          });
    }
}

void TriangleRaster::makeChunks() {
    mChunkCount = 0;
    const auto bands = static_cast<std::size_t>((mSize.y + kBandRows - 1) / kBandRows);
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        const std::uint32_t count = mFirstTriangle[m + 1] - mFirstTriangle[m];
        for (std::uint32_t first = 0; first < count; first += kChunkTriangles) {
            if (mChunkCount == mChunks.size()) {
                mChunks.emplace_back();
            }
            Chunk& chunk = mChunks[mChunkCount++];
            chunk.mesh = m;
            chunk.first = first;
            chunk.last = std::min(first + kChunkTriangles, count);
            chunk.bands.resize(bands);
            for (std::vector<std::uint32_t>& band : chunk.bands) {
                band.clear();
            }
            chunk.parts.clear();
            chunk.wholes.clear();
        }
    }
}

void TriangleRaster::sortInto(Chunk& chunk, const std::array<ScreenVertex, 3>& t,
                              std::uint32_t entry) const {
    const Range columns =
        samplesBetween(std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}),
                       mLeast.x, mGreatest.x, mSize.x);
    const Range rows =
        samplesBetween(std::min({t[0].y, t[1].y, t[2].y}), std::max({t[0].y, t[1].y, t[2].y}),
                       mLeast.y, mGreatest.y, mSize.y);
    if (columns.first > columns.last || rows.first > rows.last) {
        return;
    }
    for (int band = rows.first / kBandRows; band <= rows.last / kBandRows; ++band) {
        chunk.bands[static_cast<std::size_t>(band)].push_back(entry);
    }
}

void TriangleRaster::clip(Chunk& chunk, std::uint32_t triangle) const {
    const std::size_t before = chunk.parts.size();
    clipTriangle(clipCorners(mMeshes[chunk.mesh], triangle), mLimits, chunk.parts);
    chunk.wholes.resize(chunk.parts.size(), triangle);
    for (std::size_t part = before; part < chunk.parts.size(); ++part) {
        sortInto(chunk, chunk.parts[part], kPart + static_cast<std::uint32_t>(part));
    }
}

void TriangleRaster::sort(Chunk& chunk) const {
    const std::uint32_t* const corners = mMeshes[chunk.mesh].corners.data();
    const ScreenVertex* const screen = mScreen.data() + mFirstVertex[chunk.mesh];
    for (std::uint32_t triangle = chunk.first; triangle < chunk.last; ++triangle) {
        const std::uint32_t* const corner = corners + 3 * std::size_t{triangle};
        const std::array<ScreenVertex, 3> t{screen[corner[0]], screen[corner[1]],
                                            screen[corner[2]]};
        if (t[0].isBeyond || t[1].isBeyond || t[2].isBeyond) {
            clip(chunk, triangle);
        } else {
            sortInto(chunk, t, triangle);
        }
    }
}

bool TriangleRaster::isHole(const RasterMesh& mesh, std::uint32_t triangle, glm::dvec2 ndc) const {
    // Perspective-correct: weights with which the corners, seen from the ray, cancel out.
    const std::array<glm::vec4, 3> clip = clipCorners(mesh, triangle);
    std::array<glm::dvec2, 3> fromRay;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 corner(clip[i]);
        fromRay[i] = glm::dvec2(corner.x, corner.y) - ndc * corner.w;
    }
    const auto cross = [&](std::size_t i, std::size_t j) {
        return fromRay[i].x * fromRay[j].y - fromRay[i].y * fromRay[j].x;
    };
    const glm::dvec3 weights(cross(1, 2), cross(2, 0), cross(0, 1));
    const double sum = weights.x + weights.y + weights.z;
    return sum != 0.0 && mesh.isHole(triangle, glm::clamp(weights.y / sum, 0.0, 1.0),
                                     glm::clamp(weights.z / sum, 0.0, 1.0));
}

struct TriangleRaster::Filled {
    Filled(const RasterMesh& theMesh, std::uint32_t theTriangle, std::uint32_t theNumber,
           const std::array<ScreenVertex, 3>& theCorners, std::int64_t theArea)
        : mesh(theMesh),
          corners(theCorners),
          area(theArea),
          triangle(theTriangle),
          number(theNumber) {}

    const RasterMesh& mesh;
    const std::array<ScreenVertex, 3>& corners; ///< counter-clockwise
    std::int64_t area;                          ///< twice
    std::uint32_t triangle;                     ///< of the mesh
    std::uint32_t number;
    bool hasPlane = false; ///< once some sample is inside
    DepthPlane plane;
};

void TriangleRaster::fillTriangle(const Band& band, std::array<ScreenVertex, 3> t,
                                  const Chunk& chunk, std::uint32_t triangle) {
    const std::int64_t area = twiceArea(t);
    if (area == 0) {
        return;
    }
    if (area < 0) {
        std::swap(t[1], t[2]);
    }
    Filled filled(mMeshes[chunk.mesh], triangle, mFirstTriangle[chunk.mesh] + triangle + 1, t,
                  std::abs(area));
    const std::array<EdgeFunction, 3> edges{EdgeFunction(t[0], t[1]), EdgeFunction(t[1], t[2]),
                                            EdgeFunction(t[2], t[0])};
    const std::int32_t lowX = std::min({t[0].x, t[1].x, t[2].x});
    const std::int32_t highX = std::max({t[0].x, t[1].x, t[2].x});
    const std::int32_t lowY = std::min({t[0].y, t[1].y, t[2].y});
    const std::int32_t highY = std::max({t[0].y, t[1].y, t[2].y});
    for (std::size_t p = 0; p < mPlaces.size(); ++p) {
        const Place place = mPlaces[p];
        const Range columns = samplesBetween(lowX, highX, place.x, place.x, mSize.x);
        Range rows = samplesBetween(lowY, highY, place.y, place.y, mSize.y);
        rows = {std::max(rows.first, band.firstRow), std::min(rows.last, band.lastRow)};
        if (columns.last - columns.first < kNarrow) {
            fillNarrow(filled, edges, columns, rows, p);
            continue;
        }
        for (int row = rows.first; row <= rows.last; ++row) {
            const Range inside =
                span(edges, columns, place.x, std::int64_t{row} * kSubpixels + place.y);
            for (int column = inside.first; column <= inside.last; ++column) {
                fillSample(filled, column, row, p);
            }
        }
    }
}

void TriangleRaster::fillNarrow(Filled& filled, const std::array<EdgeFunction, 3>& edges,
                                Range columns, Range rows, std::size_t p) {
    const std::int64_t x = std::int64_t{columns.first} * kSubpixels + mPlaces[p].x;
    const std::int64_t y = std::int64_t{rows.first} * kSubpixels + mPlaces[p].y;
    std::int64_t left0 = edges[0].at(x, y);
    std::int64_t left1 = edges[1].at(x, y);
    std::int64_t left2 = edges[2].at(x, y);
    for (int row = rows.first; row <= rows.last; ++row) {
        std::int64_t e0 = left0;
        std::int64_t e1 = left1;
        std::int64_t e2 = left2;
        for (int column = columns.first; column <= columns.last; ++column) {
            if ((e0 | e1 | e2) >= 0) {
                fillSample(filled, column, row, p);
            }
            e0 += edges[0].stepAcross();
            e1 += edges[1].stepAcross();
            e2 += edges[2].stepAcross();
        }
        left0 += edges[0].stepUp();
        left1 += edges[1].stepUp();
        left2 += edges[2].stepUp();
    }
}

void TriangleRaster::fillSample(Filled& filled, int column, int row, std::size_t p) {
    if (!filled.hasPlane) {
        filled.plane = DepthPlane(filled.corners, filled.area);
        filled.hasPlane = true;
    }
    const DepthPlane& plane = filled.plane;
    const std::int32_t left = column * kSubpixels;
    const std::int32_t low = row * kSubpixels;
    const std::int32_t x = left + mPlaces[p].x;
    const std::int32_t y = low + mPlaces[p].y;
    const std::size_t i = (p * static_cast<std::size_t>(mSize.y) + static_cast<std::size_t>(row)) *
                              static_cast<std::size_t>(mSize.x) +
                          static_cast<std::size_t>(column);
    const float z = plane.within(x, y);
    if (!(z > mDepths[i])) {
        return;
    }
    if (filled.mesh.isHole && isHole(filled.mesh, filled.triangle,
                                     glm::dvec2(x, y) / glm::dvec2(mLimits.halfSize) - 1.0)) {
        return;
    }
    mDepths[i] = z;
    mTriangles[i] = filled.number;
    if (mHasPlaces) {
        mCenterDepths[i] =
            std::max(plane.at(left + kSubpixels / 2, low + kSubpixels / 2), kLeastCenterDepth * z);
    }
}

void TriangleRaster::fill(int index) {
    const Band band{index * kBandRows, std::min((index + 1) * kBandRows, mSize.y) - 1};
    for (std::size_t p = 0; p < mPlaces.size(); ++p) {
        const auto width = static_cast<std::size_t>(mSize.x);
        const std::size_t begin =
            (p * static_cast<std::size_t>(mSize.y) + static_cast<std::size_t>(band.firstRow)) *
            width;
        const std::size_t count =
            static_cast<std::size_t>(band.lastRow - band.firstRow + 1) * width;
        std::fill_n(mTriangles.begin() + static_cast<std::ptrdiff_t>(begin), count, 0u);
        std::fill_n(mDepths.begin() + static_cast<std::ptrdiff_t>(begin), count, 0.0f);
    }
    for (std::size_t c = 0; c < mChunkCount; ++c) {
        const Chunk& chunk = mChunks[c];
        const std::uint32_t* const corners = mMeshes[chunk.mesh].corners.data();
        const ScreenVertex* const screen = mScreen.data() + mFirstVertex[chunk.mesh];
        for (const std::uint32_t entry : chunk.bands[static_cast<std::size_t>(index)]) {
            if (entry >= kPart) {
                fillTriangle(band, chunk.parts[entry - kPart], chunk, chunk.wholes[entry - kPart]);
            } else {
                const std::uint32_t* const corner = corners + 3 * std::size_t{entry};
                fillTriangle(band, {screen[corner[0]], screen[corner[1]], screen[corner[2]]}, chunk,
                             entry);
            }
        }
    }
}

std::vector<glm::ivec4> TriangleRaster::boundsOfMeshes() const {
    struct Extent {
        glm::ivec2 low{std::numeric_limits<int>::max()}, high{-1};
    };
    std::vector<Extent> extents(mFirstTriangle.size() - 1);
    std::size_t mesh = 0;
    const auto meshOf = [&](std::uint32_t number) {
        const std::uint32_t triangle = number - 1;
        if (triangle < mFirstTriangle[mesh] || triangle >= mFirstTriangle[mesh + 1]) {
            mesh = static_cast<std::size_t>(std::ranges::upper_bound(mFirstTriangle, triangle) -
                                            mFirstTriangle.begin()) -
                   1;
        }
        return mesh;
    };
    const bool isOne = extents.size() == 1;
    for (int y = 0; y < mSize.y; ++y) {
        const auto row = mTriangles.begin() + std::ptrdiff_t{y} * mSize.x;
        const auto isSeen = [](std::uint32_t number) { return number != 0; };
        int x = static_cast<int>(std::find_if(row, row + mSize.x, isSeen) - row);
        const auto last = std::find_if(std::make_reverse_iterator(row + mSize.x),
                                       std::make_reverse_iterator(row + x), isSeen);
        const int end = static_cast<int>(last.base() - row);
        for (; x < end; x = isOne && x + 1 < end ? end - 1 : x + 1) {
            if (row[x] != 0) {
                Extent& extent = extents[meshOf(row[x])];
                extent.low = glm::min(extent.low, glm::ivec2(x, y));
                extent.high = glm::max(extent.high, glm::ivec2(x, y));
            }
        }
    }
    std::vector<glm::ivec4> bounds;
    for (const Extent& extent : extents) {
        bounds.push_back(extent.high.x < 0 ? glm::ivec4(0)
                                           : glm::ivec4(extent.low, extent.high - extent.low + 1));
    }
    return bounds;
}

void TriangleRaster::draw(std::span<const RasterMesh> meshes, const RasterView& view) {
    prepare(meshes, view);
    transform();
    makeChunks();
    tbb::parallel_for(std::size_t{0}, mChunkCount,
                      [this](std::size_t chunk) { sort(mChunks[chunk]); });
    const int bands = (mSize.y + kBandRows - 1) / kBandRows;
    tbb::parallel_for(0, bands, [this](int band) { fill(band); });
    mMeshes = {};
}

} // namespace celadon
