#pragma once

#include "renderer/scene/motion.h"

#include <optional>
#include <string>
#include <vector>

/// From options to motion: which animation, with which deformers.
namespace celadon::app {

/// --animation, --time and --deform, of whichever command.
struct MotionRequest {
    std::optional<std::string> animation; ///< name or number
    std::optional<double> timeSeconds;    ///< with no animation named, the first one is meant
    std::vector<std::string> deformations;
};

/// @param rest outlives the motion
/// @throws UsageError: no such animation, deformer or axis
[[nodiscard]] Motion makeMotion(const World& rest, const MotionRequest& request);

} // namespace celadon::app
