#include "renderer/scene/builtin.h"

#include "renderer/scene/builtin_shapes.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace celadon {

namespace {

struct Builtin {
    const char* name;
    Scene (*make)();
};

/// The default sculpture first.
constexpr std::array kBuiltins{
    Builtin{"sphere", makeSphere},
    Builtin{"slab", makeSlab},
};

} // namespace

std::vector<std::string> builtinNames() {
    std::vector<std::string> names;
    for (const Builtin& builtin : kBuiltins) {
        names.emplace_back(builtin.name);
    }
    return names;
}

Scene makeBuiltin(std::string_view name) {
    const auto found = std::find_if(kBuiltins.begin(), kBuiltins.end(),
                                    [&](const Builtin& builtin) { return builtin.name == name; });
    if (found == kBuiltins.end()) {
        throw UsageError(fmt::format("builtin:{}", name), "there is no such model",
                         fmt::format("the builtin models are {}", fmt::join(builtinNames(), ", ")));
    }
    Scene scene = found->make();
    scene.name = fmt::format("builtin:{}", name);
    return scene;
}

} // namespace celadon
