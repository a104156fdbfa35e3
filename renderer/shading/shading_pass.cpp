#include "renderer/shading/shading_pass.h"

#include "renderer/gl/debug.h"

namespace celadon {

ShadingPass::ShadingPass(const gl::ShaderLibrary& shaders, int materialCount,
                         const SplattingBuffer& view, double leastCosine)
    : mRadiance(gl::Texture::make2d("radiance", GL_RGBA32F, view.size())),
      mProgram("shading", shaders, {"shading.comp"},
               {{"MATERIAL_COUNT", std::to_string(materialCount)}}) {
    mProgram.set(0, static_cast<float>(leastCosine));
}

void ShadingPass::shade(const SplattingBuffer& view, const gl::Texture& exitance,
                        const gl::Texture& direct) {
    const gl::DebugGroup group("shading");
    mProgram.use();
    view.positions().bind(0);
    view.normals().bind(1);
    view.surfaces().bind(2);
    exitance.bind(3);
    direct.bind(4);
    view.emissions().bind(5);
    mRadiance.bindImage(0, 0, GL_WRITE_ONLY);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    view.dispatchTouched(mProgram, 0, mTiles);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

} // namespace celadon
