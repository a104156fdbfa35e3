#pragma once

#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/splatting_settings.h"

#include <vector>

/// Hierarchical scheme: the ball of each node of the irradiance buffer, outside which the node may
/// stand for its children. Balls nest, so that the weights of a texel's ancestors sum to one at
/// every distance (DESIGN 3.2).
namespace celadon {

/// Shader options of a scheme.
[[nodiscard]] inline std::vector<gl::ShaderDefine> schemeDefines(Scheme scheme) {
    return scheme == Scheme::Hierarchical ? std::vector<gl::ShaderDefine>{{"HIERARCHICAL", "1"}}
                                          : std::vector<gl::ShaderDefine>{};
}

class NodeBalls {
public:
    NodeBalls(const gl::ShaderLibrary& shaders, const IrradianceBuffer& buffer);

    /// After IrradianceBuffer::buildMips and NodeProfiles::build. The solve block is bound.
    void build(const IrradianceBuffer& buffer);

    /// R32F with the levels of the irradiance buffer: radius in mm; 0 at level 0.
    [[nodiscard]] const gl::Texture& radii() const { return mRadii; }

private:
    gl::Texture mRadii;
    gl::Program mProgram;
};

} // namespace celadon
