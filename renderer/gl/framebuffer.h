#pragma once

#include "renderer/gl/handle.h"
#include "renderer/gl/texture.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <string_view>
#include <vector>

namespace celadon::gl {

/// A level of a texture to draw to.
struct Attachment {
    const Texture* texture = nullptr; ///< outlives the framebuffer
    int level = 0;
    int layer = -1; ///< one layer or slice, or -1: all of them (layered, gl_Layer chooses)
};

/// A set of attachments, checked for completeness once. Color attachment i is fragment output i.
class Framebuffer {
public:
    Framebuffer() = default;
    /// @throws ContextError with the label and what is wrong
    Framebuffer(std::string_view label, const std::vector<Attachment>& colors,
                const std::optional<Attachment>& depth = std::nullopt);
    /// For passes that write by image stores only.
    [[nodiscard]] static Framebuffer withoutAttachments(std::string_view label, glm::ivec2 size);

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    explicit operator bool() const { return static_cast<bool>(mHandle); }
    /// Of the smallest attachment.
    [[nodiscard]] glm::ivec2 size() const { return mSize; }
    [[nodiscard]] int colorCount() const { return mColorCount; }

    /// Whole attachments. GL's color mask, depth mask and scissor rectangle act on clears as well:
    /// PassState::apply comes first.
    void clearColor(int index, glm::vec4 value);
    void clearColor(int index, glm::uvec4 value);
    void clearColor(int index, glm::ivec4 value);
    void clearDepth(float depth = 1.0F);

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
    };

    void attach(GLenum point, const Attachment& attachment);
    void checkComplete(std::string_view label) const;

    Handle<Traits> mHandle;
    glm::ivec2 mSize{0};
    int mColorCount = 0;
};

} // namespace celadon::gl
