#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"

#include <array>
#include <string_view>

namespace celadon {

/// Pixels that a pass of compute shaders leaves to a second one (include/listed_pixels.glsl), so
/// that what few need is done for these alone.
class ListedPixels {
public:
    ListedPixels(std::string_view label, std::size_t most)
        : mBuffer(label, sizeof(GLuint) * (kHeader.size() + most), gl::BufferUse::Update) {}

    /// None; the first pass may list some.
    void clear() {
        mBuffer.write(kHeader);
        mBuffer.bindStorage(0);
    }

    /// The second pass, with all that the first one wrote; its textures and images are bound.
    void dispatch(const gl::Program& program) const {
        mBuffer.bindStorage(0);
        mBuffer.bind(GL_DISPATCH_INDIRECT_BUFFER);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        program.use();
        glDispatchComputeIndirect(0);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    }

private:
    static constexpr std::array<GLuint, 4> kHeader{0, 1, 1, 0}; ///< groups, count

    gl::Buffer mBuffer;
};

} // namespace celadon
