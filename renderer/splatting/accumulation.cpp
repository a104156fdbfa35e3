#include "renderer/splatting/accumulation.h"

#include "renderer/gl/debug.h"
#include "renderer/splatting/irradiance_buffer.h"

namespace celadon {

Accumulation::Accumulation(const gl::ShaderLibrary& shaders, int materialCount)
    : mProgram("accumulation", shaders, {"accumulation.comp"},
               {{"MATERIAL_COUNT", std::to_string(materialCount)}}) {}

void Accumulation::accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                              std::span<const double> ringStartMm) const {
    const gl::DebugGroup group("accumulation");
    mProgram.use();
    view.positions().bind(0);
    view.normals().bind(1);
    view.surfaces().bind(2);
    for (int level = view.levels() - 2; level >= 0; --level) {
        mProgram.set(0, level);
        mProgram.set(1, static_cast<float>(ringStartMm[static_cast<std::size_t>(level) + 1]));
        exitance.bind(3);
        exitance.bindImage(0, level, GL_READ_WRITE);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        dispatchOver(exitance.size2d(level));
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace celadon
