#include "renderer/material_slots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace celadon {

namespace {

/// Materials above one another, all within the lowest one's rectangle.
struct Pile {
    glm::ivec2 corner, size;
    int layers = 0; ///< used
};

/// Shelves from left to right; the next one begins below the tallest of the last.
class Shelves {
public:
    explicit Shelves(int width) : mWidth(width) {}

    glm::ivec2 place(glm::ivec2 size) {
        if (mCursor.x > 0 && mCursor.x + size.x > mWidth) {
            mCursor = {0, mNextTop};
        }
        const glm::ivec2 corner = mCursor;
        mCursor.x += size.x;
        mNextTop = std::max(mNextTop, corner.y + size.y);
        return corner;
    }

private:
    int mWidth;
    int mNextTop = 0;
    glm::ivec2 mCursor{0};
};

} // namespace

std::vector<glm::ivec3> sizesOf(std::span<const MaterialPointer> materials) {
    std::vector<glm::ivec3> sizes;
    for (const MaterialPointer& map : materials) {
        sizes.emplace_back(map->width, map->height, map->knots());
    }
    return sizes;
}

MaterialSlots arrangeMaterials(std::span<const glm::ivec3> sizes) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Tall, then wide, then deep first: what comes later fits on what came before.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(sizes[a].y, sizes[a].x, sizes[a].z) >
               std::tuple(sizes[b].y, sizes[b].x, sizes[b].z);
    });
    int widest = 0;
    double area = 0.0;
    MaterialSlots slots;
    for (const glm::ivec3& size : sizes) {
        widest = std::max(widest, size.x);
        area += static_cast<double>(size.x) * static_cast<double>(size.y);
        slots.extent.z = std::max(slots.extent.z, size.z);
    }
    Shelves shelves(std::max(widest, static_cast<int>(std::ceil(std::sqrt(area)))));
    std::vector<Pile> piles;
    slots.origins.resize(sizes.size());
    for (const std::size_t i : order) {
        const glm::ivec3 size = sizes[i];
        auto pile = std::find_if(piles.begin(), piles.end(), [&](const Pile& candidate) {
            return size.x <= candidate.size.x && size.y <= candidate.size.y &&
                   candidate.layers + size.z <= slots.extent.z;
        });
        if (pile == piles.end()) {
            piles.push_back({shelves.place(glm::ivec2(size)), glm::ivec2(size)});
            pile = piles.end() - 1;
        }
        slots.origins[i] = glm::ivec3(pile->corner, pile->layers);
        pile->layers += size.z;
        slots.extent.x = std::max(slots.extent.x, pile->corner.x + pile->size.x);
        slots.extent.y = std::max(slots.extent.y, pile->corner.y + pile->size.y);
    }
    return slots;
}

} // namespace celadon
