#pragma once

#include "renderer/gl/debug.h"
#include "renderer/gl/handle.h"

#include <glad/gl.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace celadon::gl {

/// Six square faces, +x -x +y -y +z -z, of RGBA32F; filtering crosses their edges.
class CubeTexture {
public:
    /// Content undefined. @param edge texels, >= 1; @param levels >= 1
    CubeTexture(std::string_view label, int edge, int levels)
        : mHandle(create()), mEdge(edge), mLevels(levels) {
        labelObject(GL_TEXTURE, id(), label);
        glTextureStorage2D(id(), levels, GL_RGBA32F, edge, edge);
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    }

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    [[nodiscard]] int levels() const { return mLevels; }
    [[nodiscard]] int edge(int level = 0) const { return std::max(mEdge >> level, 1); }

    void generateMipmaps() { glGenerateTextureMipmap(id()); }
    /// Read with a Sampler.
    void bind(GLuint unit) const { glBindTextureUnit(unit, id()); }
    /// All faces of a level, to write.
    void bindImage(GLuint unit, int level) const {
        glBindImageTexture(unit, id(), level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    }
    /// [face][row][column][4]; waits for the GPU.
    [[nodiscard]] std::vector<float> readLevel(int level) const {
        std::vector<float> texels(static_cast<std::size_t>(edge(level) * edge(level)) * 24);
        glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        glGetTextureImage(id(), level, GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(texels.size() * sizeof(float)), texels.data());
        return texels;
    }

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteTextures(1, &id); }
    };
    static GLuint create() {
        GLuint id = 0;
        glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &id);
        return id;
    }

    Handle<Traits> mHandle;
    int mEdge, mLevels;
};

} // namespace celadon::gl
