#include "subedit/document/edit_command.h"

namespace celadon::subedit {

std::string commandTitle(const EditCommand& command) {
    if (const auto* apply = std::get_if<ApplyCommand>(&command)) {
        return std::string(operatorName(apply->op));
    }
    return std::string(operatorName(std::get<StrokeCommand>(command).op)) + " stroke";
}

} // namespace celadon::subedit
