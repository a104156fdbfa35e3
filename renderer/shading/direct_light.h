#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/gpu_world.h"
#include "renderer/shading/environment_reflection.h"
#include "renderer/splatting/light_views.h"
#include "renderer/splatting/splatting_buffer.h"
#include "renderer/surface_draw.h"

#include <cstddef>
#include <span>

/// Light that does not scatter below the surface: the specular lobe of every surface and the
/// diffuse one of opaque parts, with a shadow map per light view fitted to the whole scene.
namespace celadon {

class DirectLight {
public:
    /// @param shadowSize texels on a side
    DirectLight(const gl::ShaderLibrary& shaders, const SplattingBuffer& view, int shadowSize);

    /// An environment in highlights.
    struct Surroundings {
        const EnvironmentReflection* reflection; ///< of the environment's map
        const Environment& environment;
        std::size_t firstLight; ///< from here on, lights stand for it
    };

    /// Replaces the radiance by that of the given lights. The frame block is bound.
    /// @param around null: highlights see lights only
    void shade(std::span<const Light> lights, const GpuWorld& world, const SplattingBuffer& view,
               bool specular, bool shadows, const Surroundings* around);

    /// RGBA32F, frame size: W/m^2/sr towards the eye.
    [[nodiscard]] const gl::Texture& radiance() const { return mRadiance; }

private:
    LightViews mLightViews;
    gl::Texture mShadowMap;
    gl::Framebuffer mShadowFramebuffer;
    gl::Texture mRadiance;
    gl::Texture mReach; ///< RG32F, see direct_light.frag
    gl::Framebuffer mFramebuffer, mReachFramebuffer;
    gl::VertexArray mNoAttributes;
    SurfaceDraw mShadow;
    gl::Program mShade, mReflect;

    void shadeFrom(const SplattingBuffer& view, bool specular, bool isPartOfReflection);
    void reflect(const SplattingBuffer& view, const Surroundings& around);
};

} // namespace celadon
