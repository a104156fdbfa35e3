#include "renderer/scene/load_gltf_animation.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_accessor.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace celadon::loaders {

namespace {

template<typename T>
T required(const JsonElement& element, const char* name, std::optional<T> value) {
    if (!value) {
        element.fail(fmt::format("'{}' is missing", name));
    }
    return *value;
}

std::size_t sizeOf(const JsonElement& root, const char* name) {
    const auto found = root.value().find(name);
    return found != root.value().end() && found->is_array() ? found->size() : 0;
}

Interpolation interpolationOf(const JsonElement& sampler) {
    const std::string word = sampler.string("interpolation").value_or("LINEAR");
    if (word == "LINEAR") {
        return Interpolation::Linear;
    }
    if (word == "STEP") {
        return Interpolation::Step;
    }
    if (word == "CUBICSPLINE") {
        return Interpolation::CubicSpline;
    }
    sampler.fail(fmt::format("interpolation '{}' is unknown", excerpt(word)));
}

/// Nothing for a property that we do not have (extensions may name others).
std::optional<AnimatedValue> animatedValue(const std::string& path) {
    if (path == "translation") {
        return AnimatedValue::Translation;
    }
    if (path == "rotation") {
        return AnimatedValue::Rotation;
    }
    if (path == "scale") {
        return AnimatedValue::Scale;
    }
    if (path == "weights") {
        return AnimatedValue::Weights;
    }
    return std::nullopt;
}

/// Morph targets of a node's mesh: the most that a primitive has.
std::size_t targetCount(const GltfDocument& document, std::size_t node) {
    const int mesh = document.model.nodes[node].mesh;
    std::size_t count = 0;
    if (mesh >= 0) {
        for (const auto& primitive :
             document.model.meshes[static_cast<std::size_t>(mesh)].primitives) {
            count = std::max(count, primitive.targets.size());
        }
    }
    return count;
}

const tinygltf::Accessor& accessorOf(const GltfDocument& document, std::size_t index) {
    return document.model.accessors[index];
}

[[noreturn]] void refuse(const std::string& place, const std::string& reason) {
    throw InputError(place, reason, "export the animation again");
}

std::vector<double> readTimes(const GltfDocument& document, std::size_t accessor,
                              const std::string& place, bool& hasEqualKeys) {
    const tinygltf::Accessor& input = accessorOf(document, accessor);
    if (input.type != TINYGLTF_TYPE_SCALAR ||
        input.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || input.count == 0) {
        refuse(place, fmt::format("accessor {} does not hold the times of keys: it must be of type "
                                  "SCALAR, component type 5126, and not empty",
                                  accessor));
    }
    const std::vector<float> numbers = readNumbers(document, static_cast<int>(accessor));
    std::vector<double> times(numbers.begin(), numbers.end());
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i])) {
            refuse(place, fmt::format("the time of key {} is not finite", i));
        }
        if (i > 0 && times[i] < times[i - 1]) {
            refuse(place, fmt::format("keys {} and {} are out of order: {:g} s, then {:g} s", i - 1,
                                      i, times[i - 1], times[i]));
        }
        hasEqualKeys = hasEqualKeys || (i > 0 && times[i] == times[i - 1]);
    }
    return times;
}

/// The accessor's numbers, one key after the other.
std::vector<double> readValues(const GltfDocument& document, std::size_t accessor, int wantedType,
                               const std::string& place) {
    const tinygltf::Accessor& output = accessorOf(document, accessor);
    if (output.type != wantedType) {
        refuse(place,
               fmt::format("accessor {} is of another type than the animated property", accessor));
    }
    const int index = static_cast<int>(accessor);
    std::vector<double> values;
    const auto take = [&](const auto& elements) {
        for (const auto& element : elements) {
            for (int c = 0; c < element.length(); ++c) {
                values.push_back(element[c]);
            }
        }
    };
    if (wantedType == TINYGLTF_TYPE_VEC3) {
        take(readVec3(document, index));
    } else if (wantedType == TINYGLTF_TYPE_VEC4) {
        take(readVec4(document, index));
    } else {
        const std::vector<float> numbers = readNumbers(document, index);
        values.assign(numbers.begin(), numbers.end());
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            refuse(place, fmt::format("value {} of accessor {} is not finite", i, accessor));
        }
    }
    return values;
}

/// Quaternions of no length are no rotations; tangents of splines may be anything.
void checkRotations(const AnimationChannel& channel, const std::string& place) {
    const bool isCubic = channel.interpolation == Interpolation::CubicSpline;
    const std::size_t stride = isCubic ? 12 : 4;
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
        const double* const q = &channel.values[i * stride + (isCubic ? 4 : 0)];
        if (!(std::abs(q[0]) + std::abs(q[1]) + std::abs(q[2]) + std::abs(q[3]) > 0.0)) {
            refuse(place, fmt::format("the rotation of key {} is zero, not a quaternion", i));
        }
    }
}

AnimationChannel readChannel(const GltfDocument& document, const GltfChannel& source,
                             const std::string& place, bool& hasEqualKeys) {
    AnimationChannel channel;
    channel.node = static_cast<int>(source.node);
    channel.value = source.value;
    channel.interpolation = source.interpolation;
    channel.times = readTimes(document, source.input, place, hasEqualKeys);
    int type = TINYGLTF_TYPE_VEC3;
    channel.components = 3;
    if (source.value == AnimatedValue::Rotation) {
        type = TINYGLTF_TYPE_VEC4;
        channel.components = 4;
    } else if (source.value == AnimatedValue::Weights) {
        type = TINYGLTF_TYPE_SCALAR;
        channel.components = targetCount(document, source.node);
    }
    channel.values = readValues(document, source.output, type, place);
    const std::size_t perKey =
        channel.components * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (channel.values.size() != perKey * channel.times.size()) {
        refuse(place, fmt::format("{} need {} numbers each, and accessor {} holds {}",
                                  counted(channel.times.size(), "key"), perKey, source.output,
                                  channel.values.size()));
    }
    if (source.value == AnimatedValue::Rotation) {
        checkRotations(channel, place);
    }
    return channel;
}

} // namespace

std::vector<GltfAnimation> listAnimations(const JsonElement& root) {
    const std::size_t accessors = sizeOf(root, "accessors");
    const std::size_t nodes = sizeOf(root, "nodes");
    std::vector<GltfAnimation> animations;
    for (const JsonElement& element : root.objects("animations", "animation")) {
        GltfAnimation animation;
        const auto name = element.value().find("name");
        if (name != element.value().end() && name->is_string()) {
            animation.name = excerpt(name->get_ref<const std::string&>());
        }
        std::vector<GltfChannel> samplers;
        for (const JsonElement& sampler : element.objects("samplers", "sampler")) {
            GltfChannel channel;
            channel.input =
                required(sampler, "input", sampler.index("input", accessors, "accessor"));
            channel.output =
                required(sampler, "output", sampler.index("output", accessors, "accessor"));
            channel.interpolation = interpolationOf(sampler);
            samplers.push_back(channel);
        }
        for (const JsonElement& source : element.objects("channels", "channel")) {
            GltfChannel channel = samplers.empty() ? GltfChannel{} : samplers[0];
            const std::size_t sampler =
                required(source, "sampler", source.index("sampler", samplers.size(), "sampler"));
            channel = samplers[sampler];
            const JsonElement target = required(source, "target", source.object("target"));
            const auto node = target.index("node", nodes, "node");
            const auto value = animatedValue(required(target, "path", target.string("path")));
            if (node && value) {
                channel.node = *node;
                channel.value = *value;
                animation.channels.push_back(channel);
            }
        }
        animations.push_back(std::move(animation));
    }
    return animations;
}

std::vector<Animation> readAnimations(const GltfDocument& document,
                                      std::vector<std::string>& warnings) {
    std::vector<Animation> animations;
    for (std::size_t a = 0; a < document.animations.size(); ++a) {
        const GltfAnimation& source = document.animations[a];
        Animation animation;
        animation.name = source.name;
        std::set<std::pair<std::size_t, AnimatedValue>> seen;
        bool hasEqualKeys = false;
        for (std::size_t c = 0; c < source.channels.size(); ++c) {
            const GltfChannel& channel = source.channels[c];
            const std::string place =
                fmt::format("{}, animation {}{}, channel {}", quoted(document.file), a,
                            source.name.empty() ? "" : fmt::format(" '{}'", source.name), c);
            if (channel.value == AnimatedValue::Weights &&
                targetCount(document, channel.node) == 0) {
                continue;
            }
            if (!document.model.nodes[channel.node].matrix.empty()) {
                refuse(place,
                       fmt::format("node {} has a matrix, and cannot be animated", channel.node));
            }
            if (!seen.emplace(channel.node, channel.value).second) {
                refuse(place, fmt::format("node {} is animated twice by it", channel.node));
            }
            animation.channels.push_back(readChannel(document, channel, place, hasEqualKeys));
            animation.durationSeconds =
                std::max(animation.durationSeconds, animation.channels.back().times.back());
        }
        if (hasEqualKeys) {
            warnings.push_back(fmt::format("{}, animation {}: several keys at one time; the last "
                                           "of them counts",
                                           quoted(document.file), a));
        }
        animations.push_back(std::move(animation));
    }
    return animations;
}

} // namespace celadon::loaders
