#include "renderer/shading/tone_map_pass.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

#include <cmath>

namespace celadon {

ToneMapPass::ToneMapPass(const gl::ShaderLibrary& shaders)
    : mNoAttributes("no attributes"),
      mProgram("tone map", shaders, {"fullscreen.vert", "tone_map.frag"}) {}

const gl::Texture& ToneMapPass::apply(const gl::Texture& radiance, const WindowDisplay& settings) {
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
    radiance.bind(0);
    mNoAttributes.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return mDisplay;
}

} // namespace celadon
