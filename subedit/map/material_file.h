#pragma once

#include "subedit/map/material_map.h"

#include <filesystem>
#include <string>
#include <vector>

/// The SubEdit file, `NAME.subedit.exr` (DESIGN section 2): one OpenEXR with channels
/// `P00.R P00.G P00.B ... Pnn.B` of ln P and attributes `subedit:*`.
namespace celadon::subedit {

enum class StoredPrecision { Half, Float };

/// The header and every value are checked; what a header claims is not allocated before the size of
/// the file makes it possible. Values of ln P below e^-30 are raised to it.
/// @throws InputError naming file, channel or attribute, and reason
[[nodiscard]] MaterialMap readMaterial(const std::filesystem::path& file);

/// As above; also reports what is read but should be looked at: profiles of albedo above 1, and
/// roughness and specular outside [0, 1], which are clamped.
/// @param warnings lines without the file's name are appended
[[nodiscard]] MaterialMap readMaterial(const std::filesystem::path& file,
                                       std::vector<std::string>* warnings);

/// Writes to a temporary file beside `file` that is then renamed.
/// Half precision keeps the albedo of each stored profile (DESIGN section 5; half_rounding.h).
/// @param map valid: sizes agree, values finite (asserted)
/// @throws OutputError; an earlier `file` is left as it was
void writeMaterial(const MaterialMap& map, const std::filesystem::path& file,
                   StoredPrecision precision = StoredPrecision::Half);

} // namespace celadon::subedit
