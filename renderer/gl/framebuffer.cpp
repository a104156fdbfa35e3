#include "renderer/gl/framebuffer.h"

#include "renderer/gl/debug.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <limits>

namespace celadon::gl {

namespace {

GLuint createFramebuffer() {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    return id;
}

std::string statusText(GLenum status) {
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment cannot be drawn to";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "it has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
    case GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER:
        return "a draw or read buffer has no attachment";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "the driver cannot draw to this combination of formats";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "its attachments differ in samples";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
        return "some attachments are layered and some are not";
    default:
        return fmt::format("status {:#x}", status);
    }
}

} // namespace

Framebuffer::Framebuffer(std::string_view label, const std::vector<Attachment>& colors,
                         const std::optional<Attachment>& depth)
    : mHandle(createFramebuffer()),
      mSize(std::numeric_limits<int>::max()),
      mColorCount(static_cast<int>(colors.size())) {
    labelObject(GL_FRAMEBUFFER, id(), label);
    GLint maxColors = 0;
    glGetIntegerv(GL_MAX_COLOR_ATTACHMENTS, &maxColors);
    if (mColorCount > maxColors) {
        throw ContextError(
            fmt::format("framebuffer '{}'", label),
            fmt::format("{} color attachments, the driver allows {}", mColorCount, maxColors));
    }
    std::vector<GLenum> drawBuffers;
    for (const Attachment& color : colors) {
        const GLenum point = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawBuffers.size());
        attach(point, color);
        drawBuffers.push_back(point);
    }
    if (depth) {
        CELADON_ASSERT(pixelFormat(depth->texture->format()).depth);
        attach(GL_DEPTH_ATTACHMENT, *depth);
    }
    glNamedFramebufferDrawBuffers(id(), mColorCount, drawBuffers.data());
    glNamedFramebufferReadBuffer(id(), colors.empty() ? GL_NONE : GL_COLOR_ATTACHMENT0);
    checkComplete(label);
}

Framebuffer Framebuffer::withoutAttachments(std::string_view label, glm::ivec2 size) {
    Framebuffer framebuffer;
    framebuffer.mHandle = Handle<Traits>(createFramebuffer());
    framebuffer.mSize = size;
    labelObject(GL_FRAMEBUFFER, framebuffer.id(), label);
    glNamedFramebufferParameteri(framebuffer.id(), GL_FRAMEBUFFER_DEFAULT_WIDTH, size.x);
    glNamedFramebufferParameteri(framebuffer.id(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, size.y);
    glNamedFramebufferDrawBuffer(framebuffer.id(), GL_NONE);
    glNamedFramebufferReadBuffer(framebuffer.id(), GL_NONE);
    framebuffer.checkComplete(label);
    return framebuffer;
}

void Framebuffer::attach(GLenum point, const Attachment& attachment) {
    CELADON_ASSERT(attachment.texture != nullptr);
    const Texture& texture = *attachment.texture;
    if (attachment.layer >= 0 && texture.target() != GL_TEXTURE_2D) {
        glNamedFramebufferTextureLayer(id(), point, texture.id(), attachment.level,
                                       attachment.layer);
    } else {
        glNamedFramebufferTexture(id(), point, texture.id(), attachment.level);
    }
    mSize = glm::min(mSize, texture.size2d(attachment.level));
}

void Framebuffer::checkComplete(std::string_view label) const {
    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw ContextError(fmt::format("framebuffer '{}'", label), statusText(status));
    }
}

void Framebuffer::clearColor(int index, glm::vec4 value) {
    CELADON_ASSERT(index >= 0 && index < mColorCount);
    glClearNamedFramebufferfv(id(), GL_COLOR, index, &value.x);
}

void Framebuffer::clearColor(int index, glm::uvec4 value) {
    CELADON_ASSERT(index >= 0 && index < mColorCount);
    glClearNamedFramebufferuiv(id(), GL_COLOR, index, &value.x);
}

void Framebuffer::clearColor(int index, glm::ivec4 value) {
    CELADON_ASSERT(index >= 0 && index < mColorCount);
    glClearNamedFramebufferiv(id(), GL_COLOR, index, &value.x);
}

void Framebuffer::clearDepth(float depth) {
    glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &depth);
}

} // namespace celadon::gl
