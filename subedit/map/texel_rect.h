#pragma once

#include <algorithm>
#include <cstddef>

namespace celadon::subedit {

/// A rectangle of texels of a map; empty when width or height is 0.
struct TexelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    [[nodiscard]] bool isEmpty() const { return width <= 0 || height <= 0; }
    [[nodiscard]] int right() const { return x + width; }   ///< one past the last column
    [[nodiscard]] int bottom() const { return y + height; } ///< one past the last row
    [[nodiscard]] std::size_t texels() const {
        return isEmpty() ? 0 : static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    [[nodiscard]] bool operator==(const TexelRect&) const = default;
};

/// The smallest rectangle that holds both.
[[nodiscard]] inline TexelRect unite(const TexelRect& a, const TexelRect& b) {
    if (a.isEmpty() || b.isEmpty()) {
        return a.isEmpty() ? b : a;
    }
    const int x = std::min(a.x, b.x);
    const int y = std::min(a.y, b.y);
    return {x, y, std::max(a.right(), b.right()) - x, std::max(a.bottom(), b.bottom()) - y};
}

/// What both hold.
[[nodiscard]] inline TexelRect intersect(const TexelRect& a, const TexelRect& b) {
    const int x = std::max(a.x, b.x);
    const int y = std::max(a.y, b.y);
    return {x, y, std::max(std::min(a.right(), b.right()) - x, 0),
            std::max(std::min(a.bottom(), b.bottom()) - y, 0)};
}

} // namespace celadon::subedit
