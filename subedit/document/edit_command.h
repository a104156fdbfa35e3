#pragma once

#include "subedit/edit/edit_operator.h"
#include "subedit/paint/brush.h"

#include <string>
#include <variant>
#include <vector>

/// Everything that changes a document, as data: what is undone and redone, written to a stroke file
/// and replayed (edit_command_json.h). The same commands on the same material and surface give the
/// same bytes.
namespace celadon::subedit {

/// An operator on everything that is selected.
struct ApplyCommand {
    EditOperator op;
    bool operator==(const ApplyCommand&) const = default;
};

/// An operator along a stroke, where selected.
struct StrokeCommand {
    EditOperator op;
    Brush brush;
    Mirror mirror;
    std::vector<StrokePoint> path;
    bool operator==(const StrokeCommand&) const = default;
};

using EditCommand = std::variant<ApplyCommand, StrokeCommand>;

/// For a menu: "scale-albedo stroke".
[[nodiscard]] std::string commandTitle(const EditCommand& command);

} // namespace celadon::subedit
