#include "renderer/shading/direct_light.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

namespace celadon {

DirectLight::DirectLight(const gl::ShaderLibrary& shaders, const SplattingBuffer& view,
                         int shadowSize)
    : mShadowSize(shadowSize),
      mShadowMap(gl::Texture::make2d("shadow map", GL_DEPTH_COMPONENT32F, glm::ivec2(shadowSize))),
      mShadowFramebuffer("shadow map", {}, gl::Attachment{&mShadowMap}),
      mRadiance(gl::Texture::make2d("direct radiance", GL_RGBA32F, view.size())),
      mFramebuffer("direct radiance", {{&mRadiance}}, gl::Attachment{&view.depth()}),
      mLightBlock("shadow light", sizeof(blocks::LightBlock), gl::BufferUse::Update),
      mNoAttributes("no attributes"),
      mShadow("shadow map", shaders, {"surface.vert", "shadow_map.frag"}),
      mShade("direct light", shaders, {"fullscreen.vert", "direct_light.frag"}) {}

void DirectLight::shade(std::span<const Light> lights, const BoundingSphere& sceneSphere,
                        const GpuWorld& world, const SplattingBuffer& view, bool specular,
                        bool shadows) {
    const gl::DebugGroup group("direct light");
    mRadiance.clear(0, glm::vec4(0.0f));
    for (const Light& light : lights) {
        for (const LightView& lightView :
             makeLightViews(light, sceneSphere, sceneSphere, mShadowSize)) {
            mLightBlock.write(std::span(&lightView.block, 1));
            mLightBlock.bindUniform(blocks::kLight);

            gl::PassState shadowState = gl::PassState::covering(mShadowFramebuffer);
            shadowState.depthTest = gl::DepthTest::Greater;
            shadowState.depthWrite = true;
            shadowState.depthClamp = true;
            shadowState.apply();
            mShadowFramebuffer.clearDepth(0.0f);
            if (shadows) {
                world.draw(mShadow, false);
            }

            gl::PassState state = gl::PassState::covering(mFramebuffer);
            state.blend = gl::Blend::Additive;
            state.depthTest = gl::DepthTest::Less; // the triangle lies at 0: covered pixels only
            state.apply();
            mShade.use();
            mShade.set(0, specular);
            view.positions().bind(0);
            view.normals().bind(1);
            view.surfaces().bind(2);
            view.lobes().bind(3);
            view.bases().bind(4);
            view.emissions().bind(5);
            mShadowMap.bind(6);
            mNoAttributes.bind();
            glDrawArrays(GL_TRIANGLES, 0, 3);
        }
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

} // namespace celadon
