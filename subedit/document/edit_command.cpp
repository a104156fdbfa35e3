#include "subedit/document/edit_command.h"

namespace celadon::subedit {

const EditOperator* operatorOf(const EditCommand& command) {
    return std::visit(
        [](const auto& c) -> const EditOperator* {
            if constexpr (requires { c.op; }) {
                return &c.op;
            } else {
                return nullptr;
            }
        },
        command);
}

std::string commandTitle(const EditCommand& command, OperatorNaming nameOf) {
    if (const auto* selection = std::get_if<SelectCommand>(&command)) {
        return "select " + std::string(selectionStepName(selection->step));
    }
    const std::string name(nameOf(*operatorOf(command)));
    if (std::holds_alternative<StrokeCommand>(command)) {
        return name + " stroke";
    }
    if (std::holds_alternative<StampCommand>(command)) {
        return name + " stamp";
    }
    return std::holds_alternative<PropagateCommand>(command) ? "propagate " + name : name;
}

} // namespace celadon::subedit
