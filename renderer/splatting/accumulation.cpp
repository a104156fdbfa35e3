#include "renderer/splatting/accumulation.h"

#include "renderer/gl/debug.h"
#include "renderer/splatting/node_balls.h"

namespace celadon {

Accumulation::Accumulation(const gl::ShaderLibrary& shaders, int materialCount, Scheme scheme,
                           const SplattingBuffer& view)
    : mRoughPixels("rough pixels", view.positions().texelCount(0)) {
    std::vector<gl::ShaderDefine> defines = schemeDefines(scheme);
    defines.push_back({"MATERIAL_COUNT", std::to_string(materialCount)});
    mFarLight = gl::Program("far light", shaders, {"far_light.comp"}, defines);
    if (scheme == Scheme::Hierarchical) {
        mSharpening =
            gl::Program("far light sharpening", shaders, {"far_light_sharpening.comp"}, defines);
    }
    mSmooth = gl::Program("accumulation", shaders, {"accumulation.comp"}, defines);
    mRough = gl::Program("accumulation, rough", shaders, {"accumulation_rough.comp"}, defines);
    for (int level = 1; level < view.levels(); ++level) {
        const glm::ivec2 size = view.positions().size2d(level);
        Light light;
        light.asGathered = gl::Texture::make2d("far light", GL_RGBA32F, size);
        if (mSharpening) {
            light.sharpened = gl::Texture::make2d("far light, sharpened", GL_RGBA32F, size);
        }
        mLights.push_back(std::move(light));
    }
}

const gl::Texture& Accumulation::findLight(const gl::Texture& exitance, const SplattingBuffer& view,
                                           int level) const {
    const Light& light = mLights[static_cast<std::size_t>(level - 1)];
    mFarLight.use();
    mFarLight.set(0, level);
    view.surfaces().bind(0);
    exitance.bind(1);
    light.asGathered.bindImage(0, 0, GL_WRITE_ONLY);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    view.dispatchCovered(mFarLight, level);
    if (!mSharpening) {
        return light.asGathered;
    }
    mSharpening.use();
    mSharpening.set(0, level);
    view.positions().bind(0);
    light.asGathered.bind(1);
    light.sharpened.bindImage(0, 0, GL_WRITE_ONLY);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    view.dispatchCovered(mSharpening, level);
    return light.sharpened;
}

void Accumulation::accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                              const GpuMaterials& materials) {
    const gl::DebugGroup group("accumulation");
    mFarLight.set(1, materials.meanRadiusMm());
    materials.bindRangeTable(6);
    for (int level = view.levels() - 2; level >= 0; --level) {
        const gl::Texture& farLight = findLight(exitance, view, level + 1);
        mRoughPixels.clear();
        view.positions().bind(0);
        view.normals().bind(1);
        view.surfaces().bind(2);
        farLight.bind(3);
        exitance.bindImage(0, level, GL_READ_WRITE);
        for (const gl::Program* const program : {&mSmooth, &mRough}) {
            program->set(0, level);
            program->set(1, materials.meanRadiusMm());
        }
        mSmooth.use();
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        view.dispatchCovered(mSmooth, level);
        mRoughPixels.dispatch(mRough);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace celadon
