#pragma once

#include "renderer/gl/pass_state.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/gpu_world.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// A pass over the surface that the camera or a light sees. The driver draws the triangles, or,
/// with Rasterizer::Processor, the processor finds which of them each pixel sees and every pixel is
/// shaded once, by the same fragment shader.
namespace celadon {

/// Whose uniform block is bound when a pass draws: the eye.
enum class SeenFrom { Camera, Light };

class SurfaceDraw {
public:
    enum class Shows { Depth, Geometry, Looks }; ///< Depth: no color is written

    SurfaceDraw(std::string_view label, const gl::ShaderLibrary& shaders, SeenFrom eye, Shows shows,
                std::string_view fragmentShader, std::vector<gl::ShaderDefine> defines = {});

    /// Draws with reversed depth, what is nearest wins. The eye's block and the bounds are bound,
    /// the attachments cleared.
    /// @param target its framebuffer, viewport and depth clamp count
    /// @param depth attachment of the framebuffer
    /// @param morePlaces that the processor is to look at as well, see RasterView
    /// @return what the processor found at the pixels' centers and at these places, valid until
    ///         GpuWorld::rasterize(); null where the driver draws, or the view is not in use
    const TriangleRaster* draw(const GpuWorld& world, const gl::PassState& target,
                               gl::Texture& depth, std::span<const glm::vec2> morePlaces = {});

private:
    void drawByDriver(const GpuWorld& world, const gl::PassState& target) const;
    const TriangleRaster* drawByProcessor(const GpuWorld& world, const gl::PassState& target,
                                          gl::Texture& depth,
                                          std::span<const glm::vec2> morePlaces);
    void shade(const GpuWorld& world, const TriangleRaster& seen, gl::PassState state,
               const RasterView& view);

    SeenFrom mEye;
    Shows mShows;
    gl::Program mProgram;
    gl::Texture mTriangles; ///< as include/seen_surface.glsl has it
    gl::VertexArray mNoAttributes;
};

/// What the eye whose block is bound sees, for GpuWorld::rasterize(): as surface.vert projects it.
/// Waits for the GPU. None where a light's view is not in use.
[[nodiscard]] std::optional<RasterView> boundRasterView(const GpuWorld& world, SeenFrom eye,
                                                        glm::ivec2 size);

} // namespace celadon
