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

/// The cubic from p_0 to p_1 whose slopes there are m_0 and m_1 per unit of u.
[[nodiscard]] constexpr double hermite(double p_0, double m_0, double p_1, double m_1, double u) {
    const double u2 = u * u;
    const double u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * p_0 + (u3 - 2.0 * u2 + u) * m_0 +
           (3.0 * u2 - 2.0 * u3) * p_1 + (u3 - u2) * m_1;
}

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
