#include "renderer/gl/pass_state.h"

namespace celadon::gl {

namespace {

void enable(GLenum capability, bool on) {
    if (on) {
        glEnable(capability);
    } else {
        glDisable(capability);
    }
}

GLenum depthFunction(DepthTest test) {
    switch (test) {
    case DepthTest::Less:
        return GL_LESS;
    case DepthTest::LessOrEqual:
        return GL_LEQUAL;
    case DepthTest::Greater:
        return GL_GREATER;
    case DepthTest::Equal:
        return GL_EQUAL;
    case DepthTest::Off:
    case DepthTest::Always:
        return GL_ALWAYS;
    }
    return GL_ALWAYS;
}

void applyDepth(const PassState& state) {
    enable(GL_DEPTH_TEST, state.depthTest != DepthTest::Off);
    glDepthFunc(depthFunction(state.depthTest));
    glDepthMask(state.depthWrite ? GL_TRUE : GL_FALSE);
    glDepthRange(0.0, 1.0);
    enable(GL_DEPTH_CLAMP, state.depthClamp);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void applyBlend(const PassState& state) {
    enable(GL_BLEND, state.blend != Blend::None);
    glBlendEquation(state.blend == Blend::Max ? GL_MAX : GL_FUNC_ADD);
    // GL_MAX takes no factors.
    glBlendFunc(GL_ONE, state.blend == Blend::None ? GL_ZERO : GL_ONE);
    glColorMask(state.colorMask.r, state.colorMask.g, state.colorMask.b, state.colorMask.a);
    glDisable(GL_COLOR_LOGIC_OP);
    glDisable(GL_DITHER);
    glDisable(GL_FRAMEBUFFER_SRGB); // the tone-map pass encodes
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    glDisable(GL_SAMPLE_ALPHA_TO_ONE);
    glDisable(GL_SAMPLE_COVERAGE);
    glDisable(GL_SAMPLE_MASK);
    glDisable(GL_SAMPLE_SHADING);
    glEnable(GL_MULTISAMPLE);
}

void applyRasterization(const PassState& state) {
    enable(GL_CULL_FACE, state.cull != Cull::None);
    glCullFace(state.cull == Cull::Front ? GL_FRONT : GL_BACK);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    enable(GL_RASTERIZER_DISCARD, state.rasterizerDiscard);
    glDisable(GL_PRIMITIVE_RESTART);
    glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glEnable(GL_PROGRAM_POINT_SIZE);
    constexpr int kClipDistances = 8; // GL guarantees that many
    for (int i = 0; i < kClipDistances; ++i) {
        enable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i), i < state.clipDistances);
    }
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); // reversed depth keeps its precision
}

} // namespace

PassState PassState::covering(const Framebuffer& framebuffer) {
    PassState state;
    state.framebuffer = &framebuffer;
    state.viewport = glm::ivec4(0, 0, framebuffer.size());
    return state;
}

void PassState::apply() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer != nullptr ? framebuffer->id() : 0);
    glViewport(viewport.x, viewport.y, viewport.z, viewport.w);
    enable(GL_SCISSOR_TEST, scissor.has_value());
    if (scissor) {
        glScissor(scissor->x, scissor->y, scissor->z, scissor->w);
    }
    applyDepth(*this);
    applyBlend(*this);
    applyRasterization(*this);
}

} // namespace celadon::gl
