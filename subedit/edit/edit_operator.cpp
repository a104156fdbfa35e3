#include "subedit/edit/edit_operator.h"

#include <array>

namespace celadon::subedit {

std::string_view operatorName(const EditOperator& op) {
    constexpr std::array<std::string_view, std::variant_size_v<EditOperator>> kNames{
        "scale-albedo",    "set-albedo", "tint",     "scale-range",   "set-range",
        "set-shape",       "mix",        "gradient", "heterogeneity", "clone",
        "transfer-pattern"};
    return kNames[op.index()];
}

bool isLocal(const EditOperator& op) {
    return !std::holds_alternative<Heterogeneity>(op) && !std::holds_alternative<Clone>(op) &&
           !std::holds_alternative<TransferPattern>(op);
}

} // namespace celadon::subedit
