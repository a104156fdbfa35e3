#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

/// Models made in code, `builtin:NAME` on the command line.
namespace celadon {

/// Names without the prefix, the default sculpture first.
[[nodiscard]] std::vector<std::string> builtinNames();

/// With normals and UVs of little distortion. Units: as each says in its .cpp; sets
/// millimetersPerUnit.
/// @throws UsageError for an unknown name, listing the known ones
[[nodiscard]] Scene makeBuiltin(std::string_view name);

} // namespace celadon
