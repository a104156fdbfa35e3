#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_world.h"
#include "renderer/splatting/splatting_buffer.h"

#include <vector>

/// Clean silhouettes: coverage by several samples a pixel, each taking the radiance of a pixel
/// center that shows the same surface. The geometry is drawn once for as many samples as the driver
/// has.
namespace celadon {

class Antialiasing {
public:
    /// @param samples >= 2, of a pixel; rounded up to whole draws
    Antialiasing(const gl::ShaderLibrary& shaders, const SplattingBuffer& view, int samples);

    void resolve(const GpuWorld& world, const Camera& camera, const SplattingBuffer& view,
                 const gl::Texture& radiance);

    /// RGBA32F, frame size, premultiplied; alpha is coverage.
    [[nodiscard]] const gl::Texture& color() const { return mColor; }

private:
    void drawSamples(const GpuWorld& world, const CameraView& jittered,
                     const SplattingBuffer& view);

    void resolveDraw(const SplattingBuffer& view, const gl::Texture& radiance, glm::dvec2 offset);

    gl::Texture mSamples, mNormals, mDepthBuffer, mColor;
    int mDraws;
    std::uint64_t mSamplesOf = 0;   ///< SplattingBuffer::drawn() that the samples belong to
    std::vector<glm::vec2> mPlaces; ///< of a draw's samples, from the pixel's center, in pixels
    gl::Framebuffer mSampleFramebuffer;
    gl::Buffer mFrameBlock;
    gl::Buffer mEdges; ///< as coverage.glsl has it: a dispatch's groups, a count, and pixels
    gl::Program mSample, mInterior, mEdge;
};

} // namespace celadon
