#include "renderer/scene/animation.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace celadon {

namespace {

glm::dmat4 localMatrix(const RigNode& node) {
    if (node.hasMatrix) {
        return node.matrix;
    }
    glm::dmat4 result = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        result[axis] *= node.scale[axis];
        result[3][axis] = node.translation[axis];
    }
    return result;
}

std::vector<glm::dmat4> worldMatrices(const Rig& rig, const std::vector<RigNode>& nodes) {
    std::vector<glm::dmat4> world(nodes.size());
    for (const std::size_t i : rig.parentsFirst) {
        world[i] = localMatrix(nodes[i]);
        if (nodes[i].parent >= 0) {
            world[i] = world[static_cast<std::size_t>(nodes[i].parent)] * world[i];
        }
    }
    return world;
}

RigPose poseOf(const Rig& rig, const std::vector<RigNode>& nodes) {
    RigPose pose;
    pose.nodes = worldMatrices(rig, nodes);
    pose.weights.reserve(nodes.size());
    for (const RigNode& node : nodes) {
        pose.weights.push_back(node.weights);
    }
    return pose;
}

glm::dquat quaternion(std::span<const double> xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

void store(const glm::dquat& q, std::span<double> xyzw) {
    const glm::dquat unit = glm::normalize(q);
    xyzw[0] = unit.x;
    xyzw[1] = unit.y;
    xyzw[2] = unit.z;
    xyzw[3] = unit.w;
}

/// The short way round (glTF 2.0, appendix C.4).
void slerp(std::span<const double> from, std::span<const double> to, double u,
           std::span<double> result) {
    store(glm::slerp(glm::normalize(quaternion(from)), glm::normalize(quaternion(to)), u), result);
}

/// Hermite spline whose tangents are per second (glTF 2.0, appendix C.5).
void cubicSpline(std::span<const double> first, std::span<const double> second, double u, double dt,
                 std::span<double> result) {
    const std::size_t n = result.size();
    for (std::size_t c = 0; c < n; ++c) {
        result[c] = hermite(first[n + c], dt * first[2 * n + c], second[n + c], dt * second[c], u);
    }
}

double loopedTime(const Animation& animation, double seconds) {
    const double duration = animation.durationSeconds;
    return seconds <= duration || duration <= 0.0 ? seconds : std::fmod(seconds, duration);
}

} // namespace

void sampleChannel(const AnimationChannel& channel, double seconds, std::span<double> result) {
    const std::size_t n = channel.components;
    const bool isCubic = channel.interpolation == Interpolation::CubicSpline;
    const bool isRotation = channel.value == AnimatedValue::Rotation;
    const std::size_t stride = isCubic ? 3 * n : n;
    const auto key = [&](std::size_t i) {
        return std::span(channel.values).subspan(i * stride, stride);
    };
    const auto hold = [&](std::size_t i) {
        const auto values = key(i).subspan(isCubic ? n : 0, n);
        std::copy(values.begin(), values.end(), result.begin());
    };
    const auto next = std::upper_bound(channel.times.begin(), channel.times.end(), seconds);
    const auto after = static_cast<std::size_t>(next - channel.times.begin());
    if (after == 0) {
        hold(0);
    } else if (after == channel.times.size() || channel.interpolation == Interpolation::Step) {
        hold(after - 1);
    } else {
        const double dt = channel.times[after] - channel.times[after - 1];
        const double u = (seconds - channel.times[after - 1]) / dt;
        if (isCubic) {
            cubicSpline(key(after - 1), key(after), u, dt, result);
        } else if (isRotation) {
            slerp(key(after - 1), key(after), u, result);
        } else {
            for (std::size_t c = 0; c < n; ++c) {
                result[c] = std::lerp(key(after - 1)[c], key(after)[c], u);
            }
        }
    }
    if (isRotation) {
        const glm::dquat q = quaternion(result);
        store(glm::length(q) > 0.0 ? q : glm::dquat(1.0, 0.0, 0.0, 0.0), result);
    }
}

RigPose restPose(const Rig& rig) {
    return poseOf(rig, rig.nodes);
}

RigPose poseAt(const Rig& rig, const Animation& animation, double seconds) {
    const double time = loopedTime(animation, seconds);
    std::vector<RigNode> nodes = rig.nodes;
    std::vector<double> value;
    for (const AnimationChannel& channel : animation.channels) {
        value.resize(channel.components);
        sampleChannel(channel, time, value);
        RigNode& node = nodes[static_cast<std::size_t>(channel.node)];
        switch (channel.value) {
        case AnimatedValue::Translation:
            node.translation = {value[0], value[1], value[2]};
            break;
        case AnimatedValue::Rotation:
            node.rotation = quaternion(value);
            break;
        case AnimatedValue::Scale:
            node.scale = {value[0], value[1], value[2]};
            break;
        case AnimatedValue::Weights:
            node.weights = value;
            break;
        }
    }
    return poseOf(rig, nodes);
}

std::size_t findAnimation(const Rig* rig, std::string_view nameOrNumber) {
    const std::string subject = fmt::format("--animation '{}'", nameOrNumber);
    if (rig == nullptr || rig->animations.empty()) {
        throw UsageError(subject, "the model has no animations", "leave it out");
    }
    const std::vector<Animation>& animations = rig->animations;
    for (std::size_t i = 0; i < animations.size(); ++i) {
        if (animations[i].name == nameOrNumber) {
            return i;
        }
    }
    std::size_t number = 0;
    const char* const end = nameOrNumber.data() + nameOrNumber.size();
    const auto [stop, error] = std::from_chars(nameOrNumber.data(), end, number);
    if (error == std::errc() && stop == end && number < animations.size()) {
        return number;
    }
    constexpr std::size_t kListed = 12;
    std::string names;
    for (std::size_t i = 0; i < std::min(animations.size(), kListed); ++i) {
        names += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, animations[i].name);
    }
    throw UsageError(
        subject, "the model has no such animation",
        fmt::format("choose one of {}{}", names, animations.size() > kListed ? ", ..." : ""));
}

} // namespace celadon
