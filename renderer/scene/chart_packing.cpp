#include "renderer/scene/chart_packing.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>

namespace celadon {

namespace {

/// Fills shelves of a given width; a later chart goes onto the first shelf that has room for it.
/// @return nothing where the square is too small
std::optional<std::vector<glm::dvec2>> fillSquare(const std::vector<glm::dvec2>& sizes,
                                                  const std::vector<std::size_t>& order,
                                                  double margin, double side) {
    struct Shelf {
        double top, bottom, used;
    };
    std::vector<Shelf> shelves;
    std::vector<glm::dvec2> corners(sizes.size());
    double nextTop = margin;
    for (const std::size_t chart : order) {
        const glm::dvec2 size = sizes[chart];
        auto shelf = std::find_if(shelves.begin(), shelves.end(), [&](const Shelf& candidate) {
            return candidate.used + size.x + margin <= side &&
                   candidate.top + size.y <= candidate.bottom;
        });
        if (shelf == shelves.end()) {
            if (nextTop + size.y + margin > side || size.x + 2.0 * margin > side) {
                return std::nullopt;
            }
            shelves.push_back({nextTop, nextTop + size.y, margin});
            nextTop += size.y + margin;
            shelf = shelves.end() - 1;
        }
        corners[chart] = {shelf->used, shelf->top};
        shelf->used += size.x + margin;
    }
    return corners;
}

} // namespace

ChartPacking packCharts(const std::vector<glm::dvec2>& sizes, double margin) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a].y > sizes[b].y; });
    double side = 2.0 * margin;
    for (const glm::dvec2& size : sizes) {
        side = std::max({side, size.x + 2.0 * margin, size.y + 2.0 * margin});
    }
    constexpr double kGrowth = 1.01;
    for (;; side *= kGrowth) {
        if (auto corners = fillSquare(sizes, order, margin, side)) {
            return {*std::move(corners), side};
        }
    }
}

} // namespace celadon
