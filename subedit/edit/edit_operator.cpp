#include "subedit/edit/edit_operator.h"

#include <array>

namespace celadon::subedit {

std::string_view operatorName(const EditOperator& op) {
    constexpr std::array<std::string_view, std::variant_size_v<EditOperator>> kNames{
        "scale-albedo", "set-albedo", "tint", "scale-range",
        "set-range",    "set-shape",  "mix",  "gradient"};
    return kNames[op.index()];
}

} // namespace celadon::subedit
