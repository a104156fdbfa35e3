#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/gpu_world.h"
#include "renderer/splatting/light_view.h"
#include "renderer/splatting/splatting_buffer.h"

#include <span>

/// Light that does not scatter below the surface: the specular lobe of every surface and the
/// diffuse one of opaque parts, with a shadow map per light view fitted to the whole scene.
namespace celadon {

class DirectLight {
public:
    /// @param shadowSize texels on a side
    DirectLight(const gl::ShaderLibrary& shaders, const SplattingBuffer& view, int shadowSize);

    /// Replaces the radiance by that of the given lights. The frame block is bound.
    void shade(std::span<const Light> lights, const BoundingSphere& sceneSphere,
               const GpuWorld& world, const SplattingBuffer& view, bool specular, bool shadows);

    /// RGBA32F, frame size: W/m^2/sr towards the eye.
    [[nodiscard]] const gl::Texture& radiance() const { return mRadiance; }

private:
    int mShadowSize;
    gl::Texture mShadowMap;
    gl::Framebuffer mShadowFramebuffer;
    gl::Texture mRadiance;
    gl::Framebuffer mFramebuffer;
    gl::Buffer mLightBlock;
    gl::VertexArray mNoAttributes;
    gl::Program mShadow, mShade;
};

} // namespace celadon
