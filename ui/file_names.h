#pragma once

#include <optional>
#include <span>
#include <string>

/// Names of files as they are typed, and how they end.
namespace celadon::ui {

/// In small letters, of those that ASCII has.
[[nodiscard]] std::string lowered(std::string text);

/// Whether a name ends in one of the suffixes, in letters of any size.
/// @param suffixes such as ".subedit.exr", lower case; empty: all names do
[[nodiscard]] bool endsInOne(const std::string& name, std::span<const std::string> suffixes);

/// The name of a file to be written: with the first suffix, unless it has one of them.
/// "skin.exr" becomes "skin.subedit.exr" where that is the first.
/// @return nothing where the name is that of another kind of file, which it would not be
[[nodiscard]] std::optional<std::string> completedName(const std::string& name,
                                                       std::span<const std::string> suffixes);

} // namespace celadon::ui
