#include "renderer/shading/view_mode_pass.h"

#include "renderer/gl/debug.h"

#include <algorithm>
#include <cmath>

namespace celadon {

ViewModePass::ViewModePass(const gl::ShaderLibrary& shaders, int materialCount)
    : mProgram("view mode", shaders, {"view_mode.comp"},
               {{"MATERIAL_COUNT", std::to_string(materialCount)}}) {}

const gl::Texture& ViewModePass::apply(const SplattingBuffer& view, const gl::Texture& exitance,
                                       const ViewModeSettings& settings) {
    const gl::DebugGroup group("view mode");
    if (!mResult || mResult.size2d() != view.size()) {
        mResult = gl::Texture::make2d("view mode", GL_RGBA32F, view.size());
    }
    mProgram.use();
    mProgram.set(0, static_cast<int>(settings.mode));
    const int level = std::clamp(settings.level, 0, exitance.levels() - 1);
    mProgram.set(1, glm::vec4(float(level), std::exp2(settings.exposureEv), settings.leastRadiusMm,
                              settings.greatestRadiusMm));
    view.positions().bind(0);
    view.normals().bind(1);
    view.surfaces().bind(2);
    exitance.bind(3);
    mResult.bindImage(0, 0, GL_WRITE_ONLY);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    mProgram.dispatchOver(mResult.size2d());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return mResult;
}

} // namespace celadon
