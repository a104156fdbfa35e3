#include "renderer/splatting/node_balls.h"

#include "renderer/gl/debug.h"

namespace celadon {

NodeBalls::NodeBalls(const gl::ShaderLibrary& shaders, const IrradianceBuffer& buffer)
    : mRadii(gl::Texture::make2d("node balls", GL_R32F, glm::ivec2(buffer.paddedSize()),
                                 buffer.levels())),
      mProgram("node balls", shaders, {"node_ball.comp"}) {
    mRadii.clear(0, glm::vec4(0.0f));
}

void NodeBalls::build(const IrradianceBuffer& buffer) {
    const gl::DebugGroup group("node balls");
    mProgram.use();
    buffer.positions().bind(0);
    buffer.fluxes().bind(1);
    buffer.covariances().bind(2);
    buffer.extents().bind(3);
    buffer.kepts().bind(4);
    mRadii.bind(5);
    for (int level = 1; level < buffer.levels(); ++level) {
        mProgram.set(0, level);
        mRadii.bindImage(0, level, GL_WRITE_ONLY);
        mProgram.dispatchOver(mRadii.size2d(level));
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
}

} // namespace celadon
