#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/gpu_world.h"
#include "renderer/splatting/splatting_buffer.h"

/// Clean silhouettes: coverage by several jittered samples, each taking the radiance of the nearest
/// pixel center of the same surface.
namespace celadon {

class Antialiasing {
public:
    Antialiasing(const gl::ShaderLibrary& shaders, const SplattingBuffer& view);

    /// @param samples >= 1; 1: pixel centers as they are
    void resolve(const GpuWorld& world, const Camera& camera, const BoundingSphere& sceneSphere,
                 const SplattingBuffer& view, const gl::Texture& radiance, int samples);

    /// RGBA32F, frame size, premultiplied; alpha is coverage.
    [[nodiscard]] const gl::Texture& color() const { return mColor; }

private:
    gl::Texture mPositions, mNormals, mDepth, mColor;
    gl::Framebuffer mSampleFramebuffer, mColorFramebuffer;
    gl::Buffer mFrameBlock;
    gl::VertexArray mNoAttributes;
    gl::Program mSample, mResolve;
};

} // namespace celadon
