#pragma once

#include "subedit/range_table.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Files of `celadon profile table`: the mean profile and the minimal radii of one or several
/// materials, as CSV or EXR.
namespace celadon::subedit {

struct TableFile {
    std::vector<double> r;           ///< 0..1, in units of R_P
    std::vector<double> meanProfile; ///< at r
    std::vector<double> T;           ///< pixels per R_P, rising
    std::vector<double> minimalRadius;
    double epsilon = 0.0; ///< of eq. 14; 0: not known
    double energy = 0.0;  ///< of R_P; 0: not known
};

/// Two blocks, `r,meanProfile` and `T,minimalRadius`, with an empty line between.
[[nodiscard]] std::string tableCsv(const TableFile& table);

/// @throws InputError naming the line: no block T,minimalRadius, T that does not rise, radii
///         outside [0, 1]
[[nodiscard]] TableFile parseTableCsv(std::string_view text, const std::string& name);

/// One row; channel `meanProfile` over r = x / (width - 1), channel `minimalRadius` over
/// log2 T, equally spaced from attribute `celadon:minT` to `celadon:maxT`. Both are resampled to
/// the width. @throws OutputError
void writeTableExr(const TableFile& table, const std::filesystem::path& file);

/// CSV or EXR, by the extension. @throws InputError
[[nodiscard]] TableFile readTable(const std::filesystem::path& file);

/// Its minimal radii, for rendering. @throws InputError as readTable()
[[nodiscard]] RangeTable readRangeTable(const std::filesystem::path& file);

} // namespace celadon::subedit
