#pragma once

#include "renderer/scene/motion.h"

#include <optional>
#include <string>
#include <vector>

/// From options to motion: which animation, with which deformers.
namespace celadon::app {

/// --animation, --time, --frames and --deform, of whichever command.
struct MotionRequest {
    std::optional<std::string> animation;  ///< name or number
    std::optional<double> timeSeconds;     ///< with no animation named, the first one is meant
    std::vector<std::string> deformations; ///< instead of those that the model stores
    bool overFrames = false;               ///< one model over time: the first animation, likewise
};

/// What --deform says, in order: "twist:y:90", FILE.json, or "none" alone. Nothing: what the model
/// stores. @throws UsageError, InputError
[[nodiscard]] std::optional<DeformerStack> readDeformations(const std::vector<std::string>& texts);

/// @param rest outlives the motion
/// @throws UsageError: no such animation, deformer or axis; InputError
[[nodiscard]] Motion makeMotion(const World& rest, const MotionRequest& request);

} // namespace celadon::app
