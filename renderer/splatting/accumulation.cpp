#include "renderer/splatting/accumulation.h"

#include "renderer/gl/debug.h"
#include "renderer/splatting/irradiance_buffer.h"

namespace celadon {

Accumulation::Accumulation(const gl::ShaderLibrary& shaders, int materialCount,
                           const SplattingBuffer& view)
    : mFarEnergy("far energies", shaders, {"far_energy.comp"},
                 {{"MATERIAL_COUNT", std::to_string(materialCount)}}),
      mProgram("accumulation", shaders, {"accumulation.comp"},
               {{"MATERIAL_COUNT", std::to_string(materialCount)}}) {
    for (int level = 1; level < view.levels(); ++level) {
        mFarEnergies.push_back(
            gl::Texture::make2d("far energies", GL_RGBA32F, view.positions().size2d(level)));
    }
}

void Accumulation::accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                              std::span<const double> ringStartMm) const {
    const gl::DebugGroup group("accumulation");
    for (int level = view.levels() - 2; level >= 0; --level) {
        const gl::Texture& farEnergies = mFarEnergies[static_cast<std::size_t>(level)];
        const auto farRadius = static_cast<float>(ringStartMm[static_cast<std::size_t>(level) + 1]);
        mFarEnergy.use();
        mFarEnergy.set(0, level + 1);
        mFarEnergy.set(1, farRadius);
        view.surfaces().bind(0);
        farEnergies.bindImage(0, 0, GL_WRITE_ONLY);
        dispatchOver(farEnergies.size2d());

        mProgram.use();
        mProgram.set(0, level);
        mProgram.set(1, farRadius);
        view.positions().bind(0);
        view.normals().bind(1);
        view.surfaces().bind(2);
        exitance.bind(3);
        farEnergies.bind(4);
        exitance.bindImage(0, level, GL_READ_WRITE);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        dispatchOver(exitance.size2d(level));
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace celadon
