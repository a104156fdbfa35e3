#include "renderer/raster/triangle_raster.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace celadon {

namespace {

/// Of a sample's depth over w: what a plane may come to at the pixel's center, if not 0 or less.
constexpr float kLeastCenterDepth = 1e-3f;
constexpr int kNarrow = 8; ///< columns: testing each sample is then quicker than finding the span

std::int64_t twiceArea(const std::array<ScreenVertex, 3>& t) {
    return (std::int64_t{t[1].x} - t[0].x) * (std::int64_t{t[2].y} - t[0].y) -
           (std::int64_t{t[2].x} - t[0].x) * (std::int64_t{t[1].y} - t[0].y);
}

/// Columns of a row whose samples lie inside a triangle.
RasterRange span(const std::array<EdgeFunction, 3>& edges, RasterRange columns, std::int64_t x,
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

} // namespace

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

void TriangleRaster::fillTriangle(RasterRange band, std::array<ScreenVertex, 3> t,
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
        const RasterRange columns = samplesBetween(lowX, highX, place.x, place.x, mSize.x);
        RasterRange rows = samplesBetween(lowY, highY, place.y, place.y, mSize.y);
        rows = {std::max(rows.first, band.first), std::min(rows.last, band.last)};
        if (columns.last - columns.first < kNarrow) {
            fillNarrow(filled, edges, columns, rows, p);
            continue;
        }
        for (int row = rows.first; row <= rows.last; ++row) {
            const RasterRange inside =
                span(edges, columns, place.x, std::int64_t{row} * kSubpixels + place.y);
            for (int column = inside.first; column <= inside.last; ++column) {
                fillSample(filled, column, row, p);
            }
        }
    }
}

void TriangleRaster::fillNarrow(Filled& filled, const std::array<EdgeFunction, 3>& edges,
                                RasterRange columns, RasterRange rows, std::size_t p) {
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
    const RasterRange band{index * kBandRows, std::min((index + 1) * kBandRows, mSize.y) - 1};
    for (std::size_t p = 0; p < mPlaces.size(); ++p) {
        const auto width = static_cast<std::size_t>(mSize.x);
        const std::size_t begin =
            (p * static_cast<std::size_t>(mSize.y) + static_cast<std::size_t>(band.first)) * width;
        const std::size_t count = static_cast<std::size_t>(band.last - band.first + 1) * width;
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

} // namespace celadon
