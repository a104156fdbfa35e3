#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/sampler.h"
#include "renderer/gl/shader_library.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/vertex_array.h"
#include "renderer/output/tone_map.h"

#include <glm/vec3.hpp>

/// What output/tone_map.h does, on the GPU: a frame for a window.
namespace celadon {

struct WindowDisplay {
    float exposureEv = 0.0f;
    ToneMap toneMap = ToneMap::Neutral;
    glm::vec3 backgroundTop{0.0f}; ///< linear display colors, neither exposed nor tone mapped
    glm::vec3 backgroundBottom{0.0f};
};

/// A selection drawn over the picture: stripes where texels are selected.
struct SelectionOverlay {
    const gl::Texture* surfaces = nullptr; ///< of the splatting buffer; null: no overlay
    const gl::Texture* weights = nullptr;  ///< R8 over the map
    int material = -1;
};

class ToneMapPass {
public:
    explicit ToneMapPass(const gl::ShaderLibrary& shaders);

    /// @param radiance RGBA32F, premultiplied, linear
    /// @return RGBA8 of the same size, sRGB encoded, opaque; valid until the next call
    const gl::Texture& apply(const gl::Texture& radiance, const WindowDisplay& settings,
                             const SelectionOverlay& overlay = {});

private:
    gl::Texture mDisplay;
    gl::Framebuffer mFramebuffer;
    gl::VertexArray mNoAttributes;
    gl::Sampler mWeightSampler;
    gl::Program mProgram;
};

} // namespace celadon
