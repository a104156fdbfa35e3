#pragma once

#include "renderer/covered_tiles.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_world.h"
#include "renderer/listed_pixels.h"
#include "renderer/splatting/splatting_buffer.h"

#include <optional>
#include <span>
#include <vector>

/// Clean silhouettes: coverage by several samples a pixel, each taking the radiance of a pixel
/// center that shows the same surface. The geometry is drawn once for as many samples as a draw
/// has.
namespace celadon {

class Antialiasing {
public:
    /// @param samples >= 2, of a pixel; rounded up to whole draws
    Antialiasing(const gl::ShaderLibrary& shaders, const SplattingBuffer& view, int samples);

    /// What to pass to SplattingBuffer::draw, so that what it finds serves take(); empty where the
    /// driver draws.
    [[nodiscard]] std::span<const glm::vec2> placesToSee() const;
    /// @param seen of SplattingBuffer::draw, with these places
    void take(const GpuWorld& world, const TriangleRaster& seen, const SplattingBuffer& view);

    void resolve(const GpuWorld& world, const Camera& camera, const SplattingBuffer& view,
                 const gl::Texture& radiance);

    /// RGBA32F, frame size, premultiplied; alpha is coverage.
    [[nodiscard]] const gl::Texture& color() const { return mColor; }

private:
    void makeSamplesOfProcessor(const SplattingBuffer& view);
    void makeSamplesOfDriver(const gl::ShaderLibrary& shaders, glm::ivec2 size, int samples);
    void findSamples(const GpuWorld& world, const CameraView& jittered,
                     const SplattingBuffer& view);
    void drawSamples(const GpuWorld& world);
    void upload(const GpuWorld& world, std::span<const std::uint32_t> triangles,
                std::span<const float> centerDepths, const SplattingBuffer& view);
    void resolveDraw(const GpuWorld& world, const SplattingBuffer& view,
                     const gl::Texture& radiance, glm::dvec2 offset, bool isFirst);

    gl::Texture mSamples, mNormals, mDepthBuffer; ///< the driver's: multisampled
    gl::Texture mTriangles, mDepths;              ///< the processor's: a layer a sample
    gl::Texture mRanges;                          ///< of these depths, see findSampleRanges()
    std::vector<glm::vec2> mRangeTexels;
    std::optional<CoveredTiles> mTiles; ///< of the processor's samples; else the driver's
    TouchedTiles mTouched;
    gl::Texture mColor;
    int mDraws = 1;
    std::uint64_t mSamplesOf = 0;   ///< SplattingBuffer::drawn(), if they are its first draw's
    std::vector<glm::vec2> mPlaces; ///< of a draw's samples, from the pixel's center, in pixels
    gl::Framebuffer mSampleFramebuffer;
    gl::Buffer mFrameBlock;
    ListedPixels mEdges; ///< pixels at silhouettes
    gl::Program mSample; ///< the driver's
    gl::Program mInterior, mEdge;
};

} // namespace celadon
