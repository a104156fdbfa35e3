#pragma once

#include "renderer/gl/debug.h"
#include "renderer/gl/handle.h"

#include <glad/gl.h>

#include <string_view>

namespace celadon::gl {

enum class Filter {
    Nearest,       ///< level 0
    Linear,        ///< level 0
    NearestMipmap, ///< nearest texel of the nearest level
    LinearMipmap,  ///< trilinear
};

enum class Wrap { ClampToEdge, Repeat, MirroredRepeat };

/// How a texture is read; bound to the unit of the texture. Overrides the texture's own settings.
class Sampler {
public:
    Sampler() = default;
    Sampler(std::string_view label, Filter filter, Wrap wrapS, Wrap wrapT)
        : mHandle(createSampler()) {
        labelObject(GL_SAMPLER, id(), label);
        glSamplerParameteri(id(), GL_TEXTURE_MIN_FILTER, minFilter(filter));
        glSamplerParameteri(id(), GL_TEXTURE_MAG_FILTER, magFilter(filter));
        glSamplerParameteri(id(), GL_TEXTURE_WRAP_S, wrapMode(wrapS));
        glSamplerParameteri(id(), GL_TEXTURE_WRAP_T, wrapMode(wrapT));
        glSamplerParameteri(id(), GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    }
    Sampler(std::string_view label, Filter filter, Wrap wrap = Wrap::ClampToEdge)
        : Sampler(label, filter, wrap, wrap) {}

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    explicit operator bool() const { return static_cast<bool>(mHandle); }
    void bind(GLuint unit) const { glBindSampler(unit, id()); }
    /// The texture's own settings hold again.
    static void unbind(GLuint unit) { glBindSampler(unit, 0); }

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
    };

    static GLuint createSampler() {
        GLuint id = 0;
        glCreateSamplers(1, &id);
        return id;
    }
    static GLint minFilter(Filter filter) {
        switch (filter) {
        case Filter::Nearest:
            return GL_NEAREST;
        case Filter::Linear:
            return GL_LINEAR;
        case Filter::NearestMipmap:
            return GL_NEAREST_MIPMAP_NEAREST;
        case Filter::LinearMipmap:
            return GL_LINEAR_MIPMAP_LINEAR;
        }
        return GL_NEAREST;
    }
    static GLint magFilter(Filter filter) {
        const bool linear = filter == Filter::Linear || filter == Filter::LinearMipmap;
        return linear ? GL_LINEAR : GL_NEAREST;
    }
    static GLint wrapMode(Wrap wrap) {
        switch (wrap) {
        case Wrap::ClampToEdge:
            return GL_CLAMP_TO_EDGE;
        case Wrap::Repeat:
            return GL_REPEAT;
        case Wrap::MirroredRepeat:
            return GL_MIRRORED_REPEAT;
        }
        return GL_CLAMP_TO_EDGE;
    }

    Handle<Traits> mHandle;
};

} // namespace celadon::gl
