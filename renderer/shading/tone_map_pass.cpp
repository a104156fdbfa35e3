#include "renderer/shading/tone_map_pass.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

#include <cmath>

namespace celadon {

ToneMapPass::ToneMapPass(const gl::ShaderLibrary& shaders)
    : mNoAttributes("no attributes"),
      mWeightSampler("selection", gl::Filter::Linear, gl::Wrap::Repeat),
      mProgram("tone map", shaders, {"fullscreen.vert", "tone_map.frag"}) {}

const gl::Texture& ToneMapPass::apply(const gl::Texture& radiance, const WindowDisplay& settings,
                                      const SelectionOverlay& overlay) {
    const gl::DebugGroup group("tone map");
    if (!mDisplay || mDisplay.size2d() != radiance.size2d()) {
        mDisplay = gl::Texture::make2d("display", GL_RGBA8, radiance.size2d());
        mFramebuffer = gl::Framebuffer("display", {{&mDisplay}});
    }
    gl::PassState::covering(mFramebuffer).apply();
    mProgram.use();
    mProgram.set(0, glm::vec2(std::exp2(settings.exposureEv), float(settings.toneMap)));
    mProgram.set(1, settings.backgroundTop);
    mProgram.set(2, settings.backgroundBottom);
    const bool hasOverlay = overlay.surfaces != nullptr && overlay.weights != nullptr;
    mProgram.set(3, hasOverlay ? overlay.material : -1);
    radiance.bind(0);
    gl::Sampler::unbind(0);
    (hasOverlay ? *overlay.surfaces : radiance).bind(1);
    gl::Sampler::unbind(1);
    (hasOverlay ? *overlay.weights : radiance).bind(2);
    mWeightSampler.bind(2);
    mNoAttributes.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    gl::Sampler::unbind(2);
    return mDisplay;
}

} // namespace celadon
