#include "renderer/raster/triangle_raster.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace celadon {

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

void TriangleRaster::fillTriangle(SampleBand& band, const std::array<ScreenVertex, 3>& corners,
                                  const Chunk& chunk, std::uint32_t triangle) const {
    const std::uint32_t number = mFirstTriangle[chunk.mesh] + triangle + 1;
    const RasterMesh& mesh = mMeshes[chunk.mesh];
    if (!mesh.isHole) {
        mFill(mCells, band, {corners, number, nullptr});
        return;
    }
    const std::function<bool(std::int32_t, std::int32_t)> hole = [&](std::int32_t x,
                                                                     std::int32_t y) {
        return isHole(mesh, triangle, glm::dvec2(x, y) / glm::dvec2(mLimits.halfSize) - 1.0);
    };
    mFill(mCells, band, {corners, number, &hole});
}

void TriangleRaster::fill(int index, SampleBand& band) {
    band.rows = {index * kBandRows, std::min((index + 1) * kBandRows, mSize.y) - 1};
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
    for (int row = band.rows.first; row <= band.rows.last; ++row) {
        takeRow(band, row);
    }
}

void TriangleRaster::takeRow(SampleBand& band, int row) {
    const auto r = static_cast<std::size_t>(row - band.rows.first);
    const RasterRange touched = band.touched[r];
    const auto lanes = mCells.groups() * SampleCells::kLanes;
    const auto width = static_cast<std::size_t>(mSize.x);
    const bool isEmpty = touched.first > touched.last;
    const std::size_t first = isEmpty ? 0 : static_cast<std::size_t>(touched.first);
    const std::size_t last = isEmpty ? 0 : static_cast<std::size_t>(touched.last) + 1;
    const std::size_t from = r * static_cast<std::size_t>(mCells.columns()) * lanes;
    // A cell of several pixels has its samples in their order; of one, those of its places.
    const auto pixelsOfCell = static_cast<std::size_t>(mCells.width());
    const std::size_t stride = lanes / pixelsOfCell;
    const std::size_t begin = std::min(first * pixelsOfCell, width);
    const std::size_t end = std::min(last * pixelsOfCell, width);
    for (std::size_t place = 0; place < mPlaces.size(); ++place) {
        const std::size_t to =
            (place * static_cast<std::size_t>(mSize.y) + static_cast<std::size_t>(row)) * width;
        const auto take = [&](const auto& source, auto& target) {
            const auto* const samples = source.data() + from + place;
            auto* const pixels = target.data() + to;
            for (std::size_t x = begin; x < end; ++x) {
                pixels[x] = samples[x * stride];
            }
        };
        take(band.triangles, mTriangles);
        take(band.depths, mDepths);
        if (mHasPlaces) {
            take(band.centerDepths, mCenterDepths);
        }
        for (const auto& [low, high] : {std::pair(std::size_t{0}, begin), std::pair(end, width)}) {
            std::fill(mTriangles.data() + to + low, mTriangles.data() + to + high, 0u);
            std::fill(mDepths.data() + to + low, mDepths.data() + to + high, 0.0f);
        }
    }
    std::fill(band.triangles.data() + from + first * lanes,
              band.triangles.data() + from + last * lanes, 0u);
    std::fill(band.depths.data() + from + first * lanes, band.depths.data() + from + last * lanes,
              0.0f);
}

} // namespace celadon
