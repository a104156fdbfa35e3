#pragma once

#include <string>

struct ImDrawList;

/// What the viewport says while the first picture of what was opened is long in coming.
namespace celadon::ui {

class Session;
struct ViewportRect;

/// What takes the time.
[[nodiscard]] std::string preparingText(const Session& session);
/// Over the whole viewport: what was open before is no more.
void drawPreparing(ImDrawList& list, const ViewportRect& rect, const std::string& text);

} // namespace celadon::ui
