#pragma once

#include "subedit/map/material_map.h"

#include <filesystem>

/// The SubEdit file, `NAME.subedit.exr` (DESIGN section 2): one OpenEXR with channels
/// `P00.R P00.G P00.B ... Pnn.B` of ln P and attributes `subedit:*`.
namespace celadon::subedit {

enum class StoredPrecision { Half, Float };

/// @throws InputError naming file, channel or attribute, and reason
[[nodiscard]] MaterialMap readMaterial(const std::filesystem::path& file);

/// Writes to a temporary file beside `file` that is then renamed.
/// Half precision shifts each stored profile so that its albedo is kept (DESIGN section 5).
/// @throws OutputError; an earlier `file` is left as it was
void writeMaterial(const MaterialMap& map, const std::filesystem::path& file,
                   StoredPrecision precision = StoredPrecision::Half);

} // namespace celadon::subedit
