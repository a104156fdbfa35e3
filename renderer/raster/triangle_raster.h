#pragma once

#include "renderer/raster/sample_cells.h"

#include <glm/mat4x4.hpp>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Which triangle each sample of a picture sees, on all cores: what a software driver would do at
/// a few hundred nanoseconds a triangle, and with four shaded fragments for the smallest.
namespace celadon {

struct RasterMesh {
    const float* vertices = nullptr; ///< x, y, z first; read during draw()
    std::size_t vertexFloats = 3;    ///< from one to the next
    std::size_t vertexCount = 0;
    std::span<const std::uint32_t> corners; ///< three vertices a triangle
    /// Whether there is no surface at (1 - u - v) p0 + u p1 + v p2; empty: there is everywhere.
    /// Called from several threads.
    std::function<bool(std::uint32_t triangle, double u, double v)> isHole;
};

struct RasterView {
    glm::mat4 toClip{1.0f}; ///< reversed depth: 0 to w, greater is nearer
    glm::ivec2 size{0};
    bool clampsDepth = false; ///< nothing is clipped at the near and far planes
    /// Samples of each pixel, from its center, in pixels; |x|, |y| < 1/2. Empty: its center.
    std::span<const glm::vec2> places;
};

class TriangleRaster {
public:
    /// The nearest of all meshes; of equals the first. Both sides are seen. A sample on an edge
    /// that two triangles share sees one of them.
    void draw(std::span<const RasterMesh> meshes, const RasterView& view);

    /// Of one place.
    [[nodiscard]] std::size_t pixels() const {
        return static_cast<std::size_t>(mSize.x) * static_cast<std::size_t>(mSize.y);
    }
    /// [place][row][column], rows from the bottom: 0 where nothing is seen, else one more than the
    /// triangle's number, counted through all meshes.
    [[nodiscard]] std::span<const std::uint32_t> triangles() const {
        return std::span(mTriangles).first(mPlaces.size() * pixels());
    }
    /// The same of depth over w; 0 where nothing is seen.
    [[nodiscard]] std::span<const float> depths() const {
        return std::span(mDepths).first(mPlaces.size() * pixels());
    }
    /// With places: depth over w of the sample's triangle's plane at the pixel's center; positive
    /// where something is seen, undefined elsewhere.
    [[nodiscard]] std::span<const float> centerDepths() const {
        return std::span(mCenterDepths).first(mHasPlaces ? mPlaces.size() * pixels() : 0);
    }

    /// Pixels that each mesh shows in, at the first place: x, y, width, height; all 0 for none.
    [[nodiscard]] std::vector<glm::ivec4> boundsOfMeshes() const;

private:
    /// Triangles of a mesh that are sorted into bands of rows by one task.
    struct Chunk {
        std::size_t mesh = 0;
        std::uint32_t first = 0, last = 0;              ///< triangles of the mesh
        std::vector<std::vector<std::uint32_t>> bands;  ///< triangles, or kPart + index in `parts`
        std::vector<std::array<ScreenVertex, 3>> parts; ///< of clipped triangles
        std::vector<std::uint32_t> wholes;              ///< triangles that the parts belong to
    };
    static constexpr int kBandRows = 16;
    static constexpr std::uint32_t kPart = 0x8000'0000u; ///< an entry of a band

    void prepare(std::span<const RasterMesh> meshes, const RasterView& view);
    void transform();
    void makeChunks();
    void sort(Chunk& chunk) const;
    void sortInto(Chunk& chunk, const std::array<ScreenVertex, 3>& corners,
                  std::uint32_t entry) const;
    void clip(Chunk& chunk, std::uint32_t triangle) const;
    void prepareBand(SampleBand& band) const;
    void fill(int index, SampleBand& band); ///< this and the following: triangle_fill.cpp
    void fillTriangle(SampleBand& band, const std::array<ScreenVertex, 3>& corners,
                      const Chunk& chunk, std::uint32_t triangle) const;
    void takeRow(SampleBand& band, int row);
    [[nodiscard]] bool isHole(const RasterMesh& mesh, std::uint32_t triangle, glm::dvec2 ndc) const;
    [[nodiscard]] glm::vec4 toClip(const float* position) const;
    [[nodiscard]] std::array<glm::vec4, 3> clipCorners(const RasterMesh& mesh,
                                                       std::uint32_t triangle) const;

    std::span<const RasterMesh> mMeshes; ///< during draw()
    glm::mat4 mToClip{1.0f};
    glm::ivec2 mSize{0};
    bool mHasPlaces = false;
    ClipLimits mLimits;
    std::vector<SamplePlace> mPlaces;
    SampleCells mCells;
    FillFunction mFill = chooseFillFunction();
    tbb::enumerable_thread_specific<SampleBand> mBands;
    std::vector<std::size_t> mFirstVertex;
    std::vector<std::uint32_t> mFirstTriangle; ///< of each mesh, and how many there are
    std::vector<ScreenVertex> mScreen;
    std::vector<Chunk> mChunks;
    std::size_t mChunkCount = 0;
    std::vector<std::uint32_t> mTriangles;
    std::vector<float> mDepths, mCenterDepths;
};

} // namespace celadon
