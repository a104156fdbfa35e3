#pragma once

#include "renderer/frame_renderer.h"

/// What the words of `--quality` mean, and the rungs below them that a window uses while something
/// moves.
namespace celadon {

enum class Quality {
    Draft,
    Default,
    Final,
    Sketch ///< not a word of --quality: for a moving hand, coarse light, no antialiasing
};

/// Settings of the hierarchical scheme. Size is left as it is by default.
[[nodiscard]] FrameSettings frameSettings(Quality quality);

} // namespace celadon
