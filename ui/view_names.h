#pragma once

#include "renderer/shading/view_mode_pass.h"

#include <span>
#include <string_view>

/// Words for the views that explain, in commands and on screen.
namespace celadon::ui {

struct ViewName {
    ViewMode mode;
    std::string_view word; ///< in commands
    const char* label;     ///< on screen
    const char* explanation;
};

[[nodiscard]] std::span<const ViewName> viewNames();
/// @throws UsageError
[[nodiscard]] ViewMode parseViewMode(std::string_view word);
[[nodiscard]] const ViewName& viewName(ViewMode mode);

} // namespace celadon::ui
