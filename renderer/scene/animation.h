#pragma once

#include "renderer/scene/rig.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Where the nodes of a rig are at a time: keys are interpolated as glTF 2.0 says (3.11, appendix
/// C), on the CPU in double precision. Vertices are moved elsewhere (pose_mesh.h, on the GPU
/// gpu_deformation.h).
namespace celadon {

struct RigPose {
    std::vector<glm::dmat4> nodes;            ///< to world space, model units
    std::vector<std::vector<double>> weights; ///< morph weights of each node's mesh
};

/// The value of a channel at a time; before the first key and after the last it stays.
/// @param result `components` numbers; a rotation has unit length
void sampleChannel(const AnimationChannel& channel, double seconds, std::span<double> result);

/// The pose that the nodes themselves describe.
[[nodiscard]] RigPose restPose(const Rig& rig);

/// @param seconds past the animation's duration it starts over; the duration itself is its end
[[nodiscard]] RigPose poseAt(const Rig& rig, const Animation& animation, double seconds);

/// By number from 0, or by name (which wins where both fit).
/// @throws UsageError that lists what there is
[[nodiscard]] std::size_t findAnimation(const Rig* rig, std::string_view nameOrNumber);

} // namespace celadon
