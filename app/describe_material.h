#pragma once

#include <string>

namespace celadon::app {

/// What a SubEdit material holds, on stdout; what is worth knowing about it is logged as warnings.
/// @param nameOrPath a file, or the name of a shipped material
/// @throws InputError
void describeMaterial(const std::string& nameOrPath, bool asJson);

} // namespace celadon::app
