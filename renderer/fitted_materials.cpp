#include "renderer/fitted_materials.h"

#include "renderer/material_slots.h"
#include "subedit/map/material_resize.h"

#include <fmt/format.h>

#include <algorithm>

namespace celadon {

namespace {

/// The largest map at half its size, rounded up. @return whether any could be smaller
bool halveLargest(std::vector<glm::ivec3>& sizes) {
    const auto largest = std::ranges::max_element(
        sizes, {}, [](const glm::ivec3& size) { return double(size.x) * double(size.y); });
    if (largest == sizes.end() || (largest->x == 1 && largest->y == 1)) {
        return false;
    }
    *largest = {(largest->x + 1) / 2, (largest->y + 1) / 2, largest->z};
    return true;
}

} // namespace

FittedMaterials::FittedMaterials(std::span<const MaterialPointer> materials, const HasRoom& hasRoom,
                                 const std::function<void()>& beforeEach)
    : mMaps(materials.begin(), materials.end()), mSmaller(materials.size()) {
    std::vector<glm::ivec3> sizes = sizesOf(materials);
    while (!hasRoom(sizes)) {
        if (!halveLargest(sizes)) {
            return;
        }
    }
    for (std::size_t i = 0; i < mMaps.size(); ++i) {
        const subedit::MaterialMap& map = *materials[i];
        const glm::ivec3& size = sizes[i];
        if (size.x == map.width && size.y == map.height) {
            continue;
        }
        if (beforeEach) {
            beforeEach();
        }
        mSmaller[i] =
            std::make_shared<subedit::MaterialMap>(subedit::resizeMaterial(map, size.x, size.y));
        mMaps[i] = mSmaller[i];
        mWarnings.push_back(fmt::format(
            "material '{}' of {}x{} texels is more than this driver's textures hold: pictures show "
            "it by {}x{}",
            map.name, map.width, map.height, size.x, size.y));
    }
}

MaterialChange FittedMaterials::update(int material, const subedit::MaterialMap& map,
                                       const subedit::TexelRect& rect) {
    const auto i = static_cast<std::size_t>(material);
    MaterialChange change{material, rect, subedit::kLogProfileFloor};
    if (mSmaller[i]) {
        change.rect = subedit::updateSmaller(map, rect, *mSmaller[i]);
    }
    const subedit::MaterialMap& shown = mSmaller[i] ? *mSmaller[i] : map;
    const auto row =
        static_cast<std::size_t>(change.rect.width) * static_cast<std::size_t>(shown.knots()) * 3;
    for (int y = change.rect.y; y < change.rect.bottom(); ++y) {
        const float* const first = shown.logProfile.data() + shown.index(change.rect.x, y, 0);
        change.largestLogP = std::max(change.largestLogP, *std::max_element(first, first + row));
    }
    return change;
}

} // namespace celadon
