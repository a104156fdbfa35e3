#include "renderer/shading/direct_light.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

#include <cmath>

namespace celadon {

DirectLight::DirectLight(const gl::ShaderLibrary& shaders, const SplattingBuffer& view,
                         int shadowSize)
    : mLightViews(shaders, LightViews::Target::Scene, shadowSize),
      mShadowMap(gl::Texture::make2d("shadow map", GL_DEPTH_COMPONENT32F, glm::ivec2(shadowSize))),
      mShadowFramebuffer("shadow map", {}, gl::Attachment{&mShadowMap}),
      mRadiance(gl::Texture::make2d("direct radiance", GL_RGBA32F, view.size())),
      mReach(gl::Texture::make2d("reach of the environment", GL_RG32F, view.size())),
      mFramebuffer("direct radiance", {{&mRadiance}}, gl::Attachment{&view.depth()}),
      mReachFramebuffer("direct radiance and reach", {{&mRadiance}, {&mReach}},
                        gl::Attachment{&view.depth()}),
      mNoAttributes("no attributes"),
      mShadow("shadow map", shaders, SeenFrom::Light, SurfaceDraw::Shows::Depth, "shadow_map.frag"),
      mShade("direct light", shaders, {"fullscreen.vert", "direct_light.frag"}),
      mReflect("environment reflection", shaders,
               {"fullscreen.vert", "environment_reflection.frag"}) {}

namespace {

void bindLooks(const SplattingBuffer& view) {
    view.positions().bind(0);
    view.normals().bind(1);
    view.surfaces().bind(2);
    view.lobes().bind(3);
    view.bases().bind(4);
    view.emissions().bind(5);
}

} // namespace

void DirectLight::shade(std::span<const Light> lights, const GpuWorld& world,
                        const SplattingBuffer& view, bool specular, bool shadows,
                        const Surroundings* around) {
    const gl::DebugGroup group("direct light");
    gl::PassState::covering(mReachFramebuffer).apply();
    mReachFramebuffer.clearColor(0, glm::vec4(0.0f));
    if (around != nullptr) {
        mReachFramebuffer.clearColor(1, glm::vec4(0.0f));
    }
    mLightViews.update(lights, world);
    const std::size_t firstAround = around != nullptr ? around->firstLight : lights.size();
    for (int lightView = 0; lightView < mLightViews.count(); ++lightView) {
        const LightViews::Scope whereUsed = mLightViews.whereUsed(lightView);
        mLightViews.bind(lightView);
        gl::PassState shadowState = gl::PassState::covering(mShadowFramebuffer);
        shadowState.depthWrite = true;
        shadowState.depthClamp = true;
        shadowState.apply();
        mShadowFramebuffer.clearDepth(0.0f);
        if (shadows) {
            mShadow.draw(world, shadowState, mShadowMap);
        }
        shadeFrom(view, specular, mLightViews.lightOf(lightView) >= firstAround);
    }
    if (around != nullptr) {
        reflect(view, *around);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void DirectLight::shadeFrom(const SplattingBuffer& view, bool specular, bool isPartOfReflection) {
    gl::PassState state =
        gl::PassState::covering(isPartOfReflection ? mReachFramebuffer : mFramebuffer);
    state.blend = gl::Blend::Additive;
    state.depthTest = gl::DepthTest::Less; // the triangle lies at 0: covered pixels only
    state.apply();
    mShade.use();
    mShade.set(0, specular);
    mShade.set(1, isPartOfReflection);
    bindLooks(view);
    mShadowMap.bind(6);
    mNoAttributes.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DirectLight::reflect(const SplattingBuffer& view, const Surroundings& around) {
    constexpr GLuint kReachUnit = 6, kReflectionUnit = 10;
    gl::PassState state = gl::PassState::covering(mFramebuffer);
    state.blend = gl::Blend::Additive;
    state.depthTest = gl::DepthTest::Less; // the triangle lies at 0: covered pixels only
    state.apply();
    mReflect.use();
    const double turn = around.environment.turnRadians;
    mReflect.set(0, glm::vec4(std::cos(turn), std::sin(turn), around.environment.strength, 0.0));
    bindLooks(view);
    mReach.bind(kReachUnit);
    around.reflection->bind(kReflectionUnit);
    mNoAttributes.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    gl::Sampler::unbind(kReflectionUnit);
    gl::Sampler::unbind(kReflectionUnit + 1);
}

} // namespace celadon
