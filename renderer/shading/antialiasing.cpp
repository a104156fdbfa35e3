#include "renderer/shading/antialiasing.h"

#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"

#include <array>
#include <cmath>

namespace celadon {

namespace {

/// Additive recurrence on the plastic number: well spread for any count of samples. In (-1/2, 1/2).
glm::dvec2 jitter(int index) {
    constexpr double kPlastic = 1.32471795724474602596;
    const glm::dvec2 step(1.0 / kPlastic, 1.0 / (kPlastic * kPlastic));
    const glm::dvec2 position = 0.5 + step * static_cast<double>(index);
    return position - glm::floor(position) - 0.5;
}

} // namespace

Antialiasing::Antialiasing(const gl::ShaderLibrary& shaders, const SplattingBuffer& view)
    : mPositions(gl::Texture::make2d("coverage: positions", GL_RGBA32F, view.size())),
      mNormals(gl::Texture::make2d("coverage: normals", GL_RGBA32F, view.size())),
      mDepth(gl::Texture::make2d("coverage: depth", GL_DEPTH_COMPONENT32F, view.size())),
      mColor(gl::Texture::make2d("color", GL_RGBA32F, view.size())),
      mSampleFramebuffer("coverage", {{&mPositions}, {&mNormals}}, gl::Attachment{&mDepth}),
      mColorFramebuffer("color", {{&mColor}}),
      mFrameBlock("jittered frame", sizeof(blocks::FrameBlock), gl::BufferUse::Update),
      mNoAttributes("no attributes"),
      mSample("coverage", shaders, {"surface.vert", "splatting_buffer.frag"},
              {{"CAMERA", "1"}, {"COVERAGE", "1"}}),
      mResolve("antialiasing", shaders, {"fullscreen.vert", "antialias.frag"}) {}

void Antialiasing::resolve(const GpuWorld& world, const Camera& camera,
                           const BoundingSphere& sceneSphere, const SplattingBuffer& view,
                           const gl::Texture& radiance, int samples) {
    const gl::DebugGroup group("antialiasing");
    mColor.clear(0, glm::vec4(0.0f));
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 offset = samples == 1 ? glm::dvec2(0.0) : jitter(i);
        // The picture moves against the sample's offset from the pixel's center.
        const CameraView jittered =
            makeCameraView(camera, view.size().x, view.size().y, sceneSphere, -offset);
        mFrameBlock.write(
            std::array{makeFrameBlock(jittered, view.size(), view.paddedSize(), 0.0)});
        mFrameBlock.bindUniform(blocks::kFrame);

        gl::PassState sampleState = gl::PassState::covering(mSampleFramebuffer);
        sampleState.depthTest = gl::DepthTest::Greater;
        sampleState.depthWrite = true;
        sampleState.apply();
        mSampleFramebuffer.clearColor(0, glm::vec4(0.0f));
        mSampleFramebuffer.clearColor(1, glm::vec4(0.0f));
        mSampleFramebuffer.clearDepth(0.0f);
        world.draw(mSample, false);

        gl::PassState state = gl::PassState::covering(mColorFramebuffer);
        state.blend = gl::Blend::Additive;
        state.apply();
        mResolve.use();
        mResolve.set(0, glm::vec3(offset, 1.0 / samples));
        view.positions().bind(0);
        view.normals().bind(1);
        radiance.bind(2);
        mPositions.bind(3);
        mNormals.bind(4);
        mNoAttributes.bind();
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

} // namespace celadon
