#pragma once

#include "subedit/fit/profile_fit.h"
#include "subedit/map/material_map.h"
#include "subedit/radial_curve.h"

#include <string>
#include <string_view>
#include <vector>

/// What the profile commands write, and how.
namespace celadon::app {

/// Text to a file, or to stdout where none is named.
void emit(const std::string& output, const std::string& text);

/// Before the work, not after: the ending is one of these and the place can be written.
/// @param output empty is fine: stdout
/// @throws UsageError, OutputError
void checkOutput(const std::string& output, const std::vector<std::string_view>& endings);

/// The same for a SubEdit file, which must have a name.
void checkMaterialOutput(const std::string& command, const std::string& output);

/// Whether a file name ends so, in any case.
[[nodiscard]] bool hasEnding(const std::string& file, std::string_view ending);

/// A material of one texel.
[[nodiscard]] subedit::MaterialMap oneTexel(const subedit::FittedProfile& fitted, double eta,
                                            const std::string& name);

/// A line about the result: on stdout where it is all there is, else in the log, since stdout is
/// for what has no file.
void reportLine(const std::string& output, const std::string& line);

/// Albedo, radius and errors of a fit.
void reportFit(const std::string& output, const subedit::RadialCurves& curves,
               const subedit::FittedProfile& fitted);

} // namespace celadon::app
