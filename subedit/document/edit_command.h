#pragma once

#include "subedit/edit/edit_operator.h"
#include "subedit/paint/brush.h"
#include "subedit/select/selection.h"
#include "subedit/select/stamp.h"

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

/// An operator where a propagation leads to, and where selected.
struct PropagateCommand {
    EditOperator op;
    Propagation propagation;
    bool operator==(const PropagateCommand&) const = default;
};

/// An operator as a picture says that is laid onto the surface, and where selected.
struct StampCommand {
    EditOperator op;
    Stamp stamp;
    bool operator==(const StampCommand&) const = default;
};

/// Changes the selection, and no texel.
struct SelectCommand {
    SelectionStep step;
    SelectMode mode = SelectMode::Replace;
    bool operator==(const SelectCommand&) const = default;
};

using EditCommand =
    std::variant<ApplyCommand, StrokeCommand, PropagateCommand, StampCommand, SelectCommand>;

/// The operator of a command; null for a selection.
[[nodiscard]] const EditOperator* operatorOf(const EditCommand& command);

/// What an operator is called.
using OperatorNaming = std::string_view (*)(const EditOperator&);

/// In a few words: "scale-albedo stroke".
[[nodiscard]] std::string commandTitle(const EditCommand& command,
                                       OperatorNaming nameOf = operatorName);

} // namespace celadon::subedit
