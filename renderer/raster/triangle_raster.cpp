#include "renderer/raster/triangle_raster.h"

#include "renderer/raster/clip_triangle.h"
#include "subedit/assert.h"

#include <glm/common.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace celadon {

namespace {

constexpr std::uint32_t kChunkTriangles = 4096;
constexpr std::size_t kVerticesATask = 8192;

/// Pictures of several sizes take turns: what is there already is neither filled nor given back.
template<class T>
void growTo(std::size_t size, std::vector<T>& values) {
    if (values.size() < size) {
        values.resize(size);
    }
}

} // namespace

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
    mCells = SampleCells(mPlaces, mSize);
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
    const SampleCells::Int4 pixels = mCells.pixelsOf(SampleCells::boxOf(t));
    if (pixels[0] > pixels[2] || pixels[1] > pixels[3]) {
        return;
    }
    for (int band = pixels[1] / kBandRows; band <= pixels[3] / kBandRows; ++band) {
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

void TriangleRaster::prepareBand(SampleBand& band) const {
    const auto cells =
        static_cast<std::size_t>(mCells.columns()) * static_cast<std::size_t>(kBandRows);
    const std::size_t samples = cells * mCells.groups() * SampleCells::kLanes;
    growTo(samples, band.triangles); // with zeros, as takeRow() leaves them
    growTo(samples, band.depths);
    growTo(mHasPlaces ? samples : 0, band.centerDepths);
    band.touched.assign(kBandRows, {std::numeric_limits<int>::max(), -1});
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
    tbb::parallel_for(0, bands, [this](int index) {
        SampleBand& band = mBands.local();
        prepareBand(band);
        fill(index, band);
    });
    mMeshes = {};
}

} // namespace celadon
