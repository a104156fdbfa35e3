#include "subedit/paint/surface_distance.h"

#include "subedit/stop_point.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

namespace celadon::subedit {

std::vector<float> surfaceDistanceMm(const Surface& surface,
                                     std::span<const Surface::Texel> sources, float withinMm) {
    using Step = std::pair<float, Surface::Texel>;
    std::vector<float> distance(surface.texelCount(), kUnreached);
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
    for (const Surface::Texel texel : sources) {
        if (surface.isCovered(texel)) {
            distance[texel] = 0.0f;
        }
    }
    const auto expand = [&](Surface::Texel texel, float base) {
        surface.forEachNeighbor(texel, [&](Surface::Texel neighbor) {
            if (distance[neighbor] <= base) {
                return;
            }
            const float d =
                base + glm::distance(surface.positionMm(texel), surface.positionMm(neighbor));
            if (d < distance[neighbor] && d <= withinMm) {
                distance[neighbor] = d;
                front.emplace(d, neighbor);
            }
        });
    };
    for (const Surface::Texel texel :
         sources) { // those within the set reach nothing and cost little
        if (surface.isCovered(texel)) {
            expand(texel, 0.0f);
        }
    }
    for (std::uint32_t i = 1; !front.empty(); ++i) {
        if (i % 4096 == 0) {
            stopPoint();
        }
        const auto [d, texel] = front.top();
        front.pop();
        if (d <= distance[texel]) {
            expand(texel, d);
        }
    }
    return distance;
}

} // namespace celadon::subedit
