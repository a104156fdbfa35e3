// The materials of a scene in one array texture: none shares a texel with another, and little is
// wasted.
#include "renderer/material_slots.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace celadon {
namespace {

bool overlap(const glm::ivec3& a, const glm::ivec3& sizeA, const glm::ivec3& b,
             const glm::ivec3& sizeB) {
    for (int i = 0; i < 3; ++i) {
        if (a[i] + sizeA[i] <= b[i] || b[i] + sizeB[i] <= a[i]) {
            return false;
        }
    }
    return true;
}

void expectApart(const std::vector<glm::ivec3>& sizes, const MaterialSlots& slots) {
    ASSERT_EQ(slots.origins.size(), sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(slots.origins[i][c], 0);
            EXPECT_LE(slots.origins[i][c] + sizes[i][c], slots.extent[c]) << "material " << i;
        }
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(overlap(slots.origins[i], sizes[i], slots.origins[j], sizes[j]))
                << "materials " << i << " and " << j;
        }
    }
}

TEST(MaterialSlots, OneMaterialFillsTheArray) {
    const std::array sizes{glm::ivec3(130, 66, 35)};
    const MaterialSlots slots = arrangeMaterials(sizes);
    EXPECT_EQ(slots.extent, sizes[0]);
    EXPECT_EQ(slots.origins[0], glm::ivec3(0));
}

TEST(MaterialSlots, AnyMixtureIsApart) {
    std::uint32_t state = 7;
    const auto random = [&](int limit) {
        state = state * 1664525u + 1013904223u;
        return static_cast<int>(state >> 16) % limit;
    };
    for (int round = 0; round < 50; ++round) {
        std::vector<glm::ivec3> sizes;
        for (int i = random(60); i >= 0; --i) {
            sizes.emplace_back(3 + random(round % 2 == 0 ? 8 : 200), 3 + random(200),
                               4 + random(100));
        }
        SCOPED_TRACE(round);
        expectApart(sizes, arrangeMaterials(sizes));
    }
}

TEST(MaterialSlots, EqualAndShallowOnesWasteLittle) {
    std::vector<glm::ivec3> sizes(16, glm::ivec3(258, 258, 35));
    sizes.insert(sizes.end(), 20, glm::ivec3(3, 3, 35));
    sizes.insert(sizes.end(), 4, glm::ivec3(258, 258, 17)); // two on one place
    const MaterialSlots slots = arrangeMaterials(sizes);
    expectApart(sizes, slots);
    const double used = 18.0 * 258 * 258;
    EXPECT_LT(double(slots.extent.x) * slots.extent.y, 1.4 * used);
}

} // namespace
} // namespace celadon
