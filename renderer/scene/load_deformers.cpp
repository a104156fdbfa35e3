#include "renderer/scene/load_deformers.h"

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_container.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace celadon::loaders {

namespace {

constexpr const char* kRemedy = "see the format of deformers in renderer/scene/README.md";
constexpr std::size_t kMostDeformers = 64;
constexpr std::size_t kMostHandles = 256;
constexpr std::array kInterpolations{"step", "linear", "cubic"};

/// A number or three, one key's worth.
void takeValue(const JsonElement& element, const char* name, const nlohmann::json& value,
               std::size_t components, std::vector<double>& values) {
    const auto take = [&](const nlohmann::json& number) {
        if (!number.is_number() || !std::isfinite(number.get<double>())) {
            element.fail(fmt::format("'{}' holds something other than finite numbers", name));
        }
        values.push_back(number.get<double>());
    };
    if (components == 1) {
        take(value);
        return;
    }
    if (!value.is_array() || value.size() != components) {
        element.fail(fmt::format("'{}' needs {} numbers", name, components));
    }
    for (const nlohmann::json& number : value) {
        take(number);
    }
}

/// A constant, or {"times": [...], "values": [...], "interpolation": "step|linear|cubic"}.
KeyedNumbers numbersOf(const JsonElement& element, const char* name, std::size_t components,
                       const KeyedNumbers& otherwise) {
    const auto found = element.value().find(name);
    if (found == element.value().end()) {
        return otherwise;
    }
    KeyedNumbers result;
    result.components = components;
    result.values.clear();
    if (!found->is_object()) {
        takeValue(element, name, *found, components, result.values);
        return result;
    }
    const JsonElement keys = *element.object(name);
    result.times = keys.numbers("times", 0).value_or(std::vector<double>());
    if (result.times.empty()) {
        keys.fail("'times' is missing or empty");
    }
    for (std::size_t i = 1; i < result.times.size(); ++i) {
        if (!(result.times[i] > result.times[i - 1])) {
            keys.fail(fmt::format("keys {} and {} are out of order: {:g} s, then {:g} s", i - 1, i,
                                  result.times[i - 1], result.times[i]));
        }
    }
    const auto values = keys.value().find("values");
    if (values == keys.value().end() || !values->is_array() ||
        values->size() != result.times.size()) {
        keys.fail(
            fmt::format("'values' is not an array of {}", counted(result.times.size(), "value")));
    }
    for (const nlohmann::json& value : *values) {
        takeValue(keys, "values", value, components, result.values);
    }
    const std::string word = keys.string("interpolation").value_or("linear");
    const auto kind = std::find(kInterpolations.begin(), kInterpolations.end(), word);
    if (kind == kInterpolations.end()) {
        keys.fail(fmt::format("interpolation '{}' is none of step, linear, cubic", excerpt(word)));
    }
    result.interpolation = static_cast<Interpolation>(kind - kInterpolations.begin());
    return result;
}

KeyedNumbers requiredNumbers(const JsonElement& element, const char* name, std::size_t components) {
    if (!element.value().contains(name)) {
        element.fail(fmt::format("'{}' is missing", name));
    }
    return numbersOf(element, name, components, {});
}

glm::ivec3 integersOf(const JsonElement& element, const char* name, int least,
                      const glm::ivec3& most) {
    glm::ivec3 result;
    const auto numbers = element.numbers(name, 3);
    if (!numbers) {
        element.fail(fmt::format("'{}' is missing", name));
    }
    for (int k = 0; k < 3; ++k) {
        const double number = (*numbers)[static_cast<std::size_t>(k)];
        if (number != std::floor(number) || number < least || number > most[k]) {
            element.fail(fmt::format("'{}' holds {:g}, not a whole number from {} to {}", name,
                                     number, least, most[k]));
        }
        result[k] = static_cast<int>(number);
    }
    return result;
}

void readLattice(const JsonElement& element, AnimatedDeformer& result) {
    result.latticeSize = integersOf(element, "size", 2, glm::ivec3(kMaxLatticePoints));
    for (const JsonElement& source : element.objects("moves", "move")) {
        LatticeMove move;
        move.point = integersOf(source, "point", 0, result.latticeSize - 1);
        move.by = requiredNumbers(source, "by", 3);
        for (const LatticeMove& other : result.moves) {
            if (other.point == move.point) {
                source.fail("moves a control point that an earlier one moves");
            }
        }
        result.moves.push_back(std::move(move));
    }
}

void readHandles(const JsonElement& element, AnimatedDeformer& result) {
    for (const JsonElement& source : element.objects("handles", "handle")) {
        if (result.handles.size() == kMostHandles) {
            element.fail(fmt::format("has more than {} handles", kMostHandles));
        }
        Handle handle;
        handle.at = requiredNumbers(source, "at", 3).vector(0.0);
        handle.radius = source.number("radius").value_or(0.0);
        if (handle.radius < 0.0) {
            source.fail("'radius' is negative");
        }
        handle.move = numbersOf(source, "move", 3, handle.move);
        handle.turnDegrees = numbersOf(source, "turnDegrees", 3, handle.turnDegrees);
        result.handles.push_back(std::move(handle));
    }
    if (result.handles.empty()) {
        element.fail("has no handles");
    }
}

void readAmounts(const JsonElement& element, AnimatedDeformer& result) {
    const auto kind = result.kind;
    result.amount = requiredNumbers(element, amountName(kind), 1);
    if (kind == Deformer::Kind::Inflate) {
        return;
    }
    const std::string axis = element.string("axis").value_or("");
    if (axis.size() != 1 || std::string_view("xyz").find(axis) == std::string_view::npos) {
        element.fail("'axis' is none of x, y, z");
    }
    result.axis = axis[0] - 'x';
    if (kind == Deformer::Kind::Taper &&
        std::any_of(result.amount.values.begin(), result.amount.values.end(),
                    [](double scale) { return scale < 0.0; })) {
        element.fail("'scale' is negative, which turns the surface inside out");
    }
    if (kind == Deformer::Kind::Wave) {
        result.wavelengthMm = requiredNumbers(element, "wavelengthMm", 1);
        for (const double wavelength : result.wavelengthMm.values) {
            if (!(wavelength > 0.0)) {
                element.fail("'wavelengthMm' is not positive");
            }
        }
    }
    if (const auto range = element.numbers("range", 2)) {
        result.range = glm::dvec2((*range)[0], (*range)[1]);
        if (!(result.range->x < result.range->y)) {
            element.fail("'range' does not run from low to high");
        }
    }
}

AnimatedDeformer readDeformer(const JsonElement& element) {
    const std::string type = element.string("type").value_or("");
    AnimatedDeformer result;
    bool isKnown = false;
    for (int k = 0; k <= static_cast<int>(Deformer::Kind::Handles); ++k) {
        const auto kind = static_cast<Deformer::Kind>(k);
        if (type == deformerName(kind)) {
            result.kind = kind;
            isKnown = true;
        }
    }
    if (!isKnown) {
        element.fail(fmt::format("'type' is '{}', none of twist, bend, taper, wave, inflate, "
                                 "lattice, handles",
                                 excerpt(type)));
    }
    const auto on = element.value().find("on");
    if (on != element.value().end()) {
        if (!on->is_boolean()) {
            element.fail("'on' is neither true nor false");
        }
        result.isOn = on->get<bool>();
    }
    if (result.kind == Deformer::Kind::Lattice) {
        readLattice(element, result);
    } else if (result.kind == Deformer::Kind::Handles) {
        readHandles(element, result);
    } else {
        readAmounts(element, result);
    }
    return result;
}

nlohmann::json json(const KeyedNumbers& numbers) {
    const auto value = [&](std::size_t key) {
        if (numbers.components == 1) {
            return nlohmann::json(numbers.values[key]);
        }
        nlohmann::json result = nlohmann::json::array();
        for (std::size_t c = 0; c < numbers.components; ++c) {
            result.push_back(numbers.values[key * numbers.components + c]);
        }
        return result;
    };
    if (!numbers.isKeyed()) {
        return value(0);
    }
    nlohmann::json values = nlohmann::json::array();
    for (std::size_t key = 0; key < numbers.times.size(); ++key) {
        values.push_back(value(key));
    }
    return {{"times", numbers.times},
            {"values", std::move(values)},
            {"interpolation", kInterpolations.at(static_cast<std::size_t>(numbers.interpolation))}};
}

nlohmann::json json(const glm::ivec3& v) {
    return {v.x, v.y, v.z};
}

nlohmann::json json(const AnimatedDeformer& deformer) {
    const auto kind = deformer.kind;
    nlohmann::json result{{"type", deformerName(kind)}};
    if (!deformer.isOn) {
        result["on"] = false;
    }
    if (kind == Deformer::Kind::Lattice) {
        result["size"] = json(deformer.latticeSize);
        result["moves"] = nlohmann::json::array();
        for (const LatticeMove& move : deformer.moves) {
            result["moves"].push_back({{"point", json(move.point)}, {"by", json(move.by)}});
        }
        return result;
    }
    if (kind == Deformer::Kind::Handles) {
        for (const Handle& handle : deformer.handles) {
            result["handles"].push_back({{"at", {handle.at.x, handle.at.y, handle.at.z}},
                                         {"radius", handle.radius},
                                         {"move", json(handle.move)},
                                         {"turnDegrees", json(handle.turnDegrees)}});
        }
        return result;
    }
    result[amountName(kind)] = json(deformer.amount);
    if (kind != Deformer::Kind::Inflate) {
        result["axis"] = std::string(1, "xyz"[deformer.axis]);
    }
    if (kind == Deformer::Kind::Wave) {
        result["wavelengthMm"] = json(deformer.wavelengthMm);
    }
    if (deformer.range) {
        result["range"] = {deformer.range->x, deformer.range->y};
    }
    return result;
}

} // namespace

DeformerStack deformersOf(const JsonElement& owner) {
    DeformerStack stack;
    for (const JsonElement& element : owner.withRemedy(kRemedy).objects("deformers", "deformer")) {
        if (stack.size() == kMostDeformers) {
            owner.fail(fmt::format("has more than {} deformers", kMostDeformers), kRemedy);
        }
        AnimatedDeformer deformer = readDeformer(element);
        const bool isSecond = deformer.kind == Deformer::Kind::Handles &&
                              std::any_of(stack.begin(), stack.end(), [](const auto& earlier) {
                                  return earlier.kind == Deformer::Kind::Handles;
                              });
        if (isSecond) {
            element.fail("is a second deformer of type handles", "put all handles into one");
        }
        stack.push_back(std::move(deformer));
    }
    return stack;
}

DeformerStack readDeformers(const std::filesystem::path& file) {
    const std::string content = readFile(file);
    const nlohmann::json json = parseJson(file, content, kRemedy);
    if (!json.contains("deformers")) {
        throw InputError(quoted(file), "has no 'deformers'", kRemedy);
    }
    return deformersOf(JsonElement(file, json, ""));
}

nlohmann::json deformersJson(const DeformerStack& stack) {
    nlohmann::json list = nlohmann::json::array();
    for (const AnimatedDeformer& deformer : stack) {
        list.push_back(json(deformer));
    }
    return {{"deformers", std::move(list)}};
}

void putDeformers(nlohmann::json& root, const std::filesystem::path& file,
                  const DeformerStack& stack) {
    nlohmann::json* const scenes = root.contains("scenes") ? &root["scenes"] : nullptr;
    const auto index = root.value("scene", 0u);
    if (scenes == nullptr || !scenes->is_array() || index >= scenes->size() ||
        !(*scenes)[index].is_object()) {
        if (stack.empty()) {
            return;
        }
        throw InputError(quoted(file), "has no scene to put the deformers in",
                         "export the model with a scene");
    }
    nlohmann::json& scene = (*scenes)[index];
    if (stack.empty()) {
        if (scene.contains("extras") && scene["extras"].is_object()) {
            scene["extras"].erase("celadon");
        }
        return;
    }
    if (!scene["extras"].is_object()) {
        scene["extras"] = nlohmann::json::object();
    }
    scene["extras"]["celadon"] = deformersJson(stack);
}

std::string gltfWithDeformers(const std::filesystem::path& file, std::string_view content,
                              const DeformerStack& stack) {
    const GltfContainer container = splitContainer(file, content);
    nlohmann::json root = parseJson(file, container.json);
    putDeformers(root, file, stack);
    return content.starts_with("glTF") ? binaryGltf(root, container.binary) : root.dump(1) + '\n';
}

} // namespace celadon::loaders
