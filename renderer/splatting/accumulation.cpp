#include "renderer/splatting/accumulation.h"

#include "renderer/gl/debug.h"
#include "renderer/splatting/node_balls.h"

namespace celadon {

Accumulation::Accumulation(const gl::ShaderLibrary& shaders, int materialCount, Scheme scheme,
                           const SplattingBuffer& view) {
    std::vector<gl::ShaderDefine> defines = schemeDefines(scheme);
    defines.push_back({"MATERIAL_COUNT", std::to_string(materialCount)});
    mFarEnergy = gl::Program("far energies", shaders, {"far_energy.comp"}, defines);
    mProgram = gl::Program("accumulation", shaders, {"accumulation.comp"}, defines);
    for (int level = 1; level < view.levels(); ++level) {
        mFarEnergies.push_back(
            gl::Texture::make2d("far energies", GL_RGBA32F, view.positions().size2d(level)));
    }
}

void Accumulation::accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                              const GpuMaterials& materials) const {
    const gl::DebugGroup group("accumulation");
    mFarEnergy.set(1, materials.meanRadiusMm());
    mProgram.set(1, materials.meanRadiusMm());
    materials.bindRangeTable(6);
    for (int level = view.levels() - 2; level >= 0; --level) {
        const gl::Texture& farEnergies = mFarEnergies[static_cast<std::size_t>(level)];
        mFarEnergy.use();
        mFarEnergy.set(0, level + 1);
        view.surfaces().bind(0);
        farEnergies.bindImage(0, 0, GL_WRITE_ONLY);
        view.dispatchCovered(mFarEnergy, level + 1);

        mProgram.use();
        mProgram.set(0, level);
        view.positions().bind(0);
        view.normals().bind(1);
        view.surfaces().bind(2);
        exitance.bind(3);
        farEnergies.bind(4);
        exitance.bindImage(0, level, GL_READ_WRITE);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        view.dispatchCovered(mProgram, level);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace celadon
