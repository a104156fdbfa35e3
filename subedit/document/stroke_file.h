#pragma once

#include "subedit/document/edit_command.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The stroke file: the commands of a document as JSON (subedit/document/README.md). What is
/// written reads back to equal commands, floats to the last bit, so that a replay gives the same
/// bytes.
namespace celadon::subedit {

/// What the strokes were painted on.
struct StrokeSurface {
    std::optional<std::string> model; ///< as given on the command line; else flat:
    float flatWidthMm = 100.0f;       ///< makeFlatSurface()
    /// Size of the map that was painted on, where the material had to be enlarged for it.
    std::optional<glm::ivec2> texels = {};
    bool operator==(const StrokeSurface&) const = default;
};

struct StrokeFile {
    StrokeSurface surface;
    std::vector<EditCommand> commands;
    bool operator==(const StrokeFile&) const = default;
};

/// A profile that a stroke file names by material: the texel at `uv` (v down) of a file, or of a
/// material by name. May throw InputError.
using ProfileLookup = std::function<StoredProfile(const std::string& nameOrPath, glm::vec2 uv)>;

/// @param subject what messages call the text, such as "'a/strokes.json'"
/// @param lookup  empty: profiles by material are refused
/// @throws InputError naming the place as a JSON pointer (RFC 6901), what is there and what would
///         do: not JSON, unknown commands, operators or fields, numbers out of range
[[nodiscard]] StrokeFile parseStrokeFile(const std::string& subject, std::string_view text,
                                         const ProfileLookup& lookup = {});

/// @throws InputError also if it cannot be read
[[nodiscard]] StrokeFile readStrokeFile(const std::filesystem::path& file,
                                        const ProfileLookup& lookup = {});

[[nodiscard]] std::string strokeFileText(const StrokeFile& file);

/// One command on one line, without a line end; as in the list of a stroke file.
[[nodiscard]] std::string commandText(const EditCommand& command);
[[nodiscard]] EditCommand parseCommand(const std::string& subject, std::string_view text,
                                       const ProfileLookup& lookup = {});

} // namespace celadon::subedit
