#pragma once

#include "renderer/gl/framebuffer.h"

#include <glm/vec4.hpp>

#include <optional>

namespace celadon::gl {

enum class Blend { None, Additive, Max };
enum class DepthTest { Off, Less, LessOrEqual, Greater, Equal, Always };
enum class Cull { None, Back, Front };

/// All fixed state that a draw depends on, as one value. There is no cache and nothing is
/// inherited: apply() sets every item, so that what ran before (a user interface, for example)
/// cannot leak in.
struct PassState {
    const Framebuffer* framebuffer = nullptr; ///< null: the window's
    glm::ivec4 viewport{0};                   ///< x, y, width, height; y up
    DepthTest depthTest = DepthTest::Off;
    bool depthWrite = false; ///< also without a test (DepthTest::Always), and for clears
    bool depthClamp = false; ///< nothing is clipped at the near and far planes
    Blend blend = Blend::None;
    Cull cull = Cull::None; ///< fronts are counter-clockwise
    glm::bvec4 colorMask{true};
    std::optional<glm::ivec4> scissor;
    bool rasterizerDiscard = false; ///< only transform feedback or buffer stores count
    int clipDistances = 0;          ///< gl_ClipDistance[0 … n-1] are written

    /// All of a framebuffer, no depth, no blending.
    [[nodiscard]] static PassState covering(const Framebuffer& framebuffer);

    void apply() const;
};

} // namespace celadon::gl
