#include "renderer/gather/far_energies.h"

#include "subedit/assert.h"
#include "subedit/map/repeat_tap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon {

namespace {

constexpr std::size_t kTexelHalves = 4; ///< R, G, B and one unused
/// What is not asked for just now is kept while all is no more than this: the next picture may be
/// of another size.
constexpr std::size_t kSpareBytes = std::size_t{64} << 20;

/// Numbers of half precision; no infinities, no NaN.
Four fromHalves(const std::uint16_t* halves) {
    using Bits = std::uint16_t __attribute__((vector_size(8)));
    Bits packed;
    std::memcpy(&packed, halves, sizeof(packed));
    const FourInts bits = __builtin_convertvector(packed, FourInts);
    const FourInts magnitude = (bits & 0x7fff) << 13; // its exponent counts from another zero
    const FourInts withSign = magnitude | ((bits & 0x8000) << 16);
    Four value;
    std::memcpy(&value, &withSign, sizeof(value));
    return value * 0x1p112f;
}

} // namespace

FarEnergies::FarEnergies(std::span<const MaterialPointer> materials)
    : mMaterials(materials.begin(), materials.end()) {}

void FarEnergies::changed(int material, const subedit::TexelRect& rect) {
    for (Plane& plane : mPlanes) {
        if (plane.material == material) {
            addChange(plane.changed, {material, rect});
        }
    }
}

FarEnergies::Selection FarEnergies::select(std::span<const float> radiiMm, const Source& source) {
    ++mSelected;
    Selection selection;
    for (const MaterialPointer& map : mMaterials) {
        selection.mSizes.emplace_back(map->width, map->height);
    }
    for (const float radius : radiiMm) {
        for (int material = 0; material < static_cast<int>(mMaterials.size()); ++material) {
            const subedit::MaterialMap& map = mapOf(material);
            const float place =
                std::clamp(radius / map.maxRadiusMm, 0.0f, 1.0f) * static_cast<float>(map.segments);
            const auto before = static_cast<int>(std::floor(place));
            const auto after = static_cast<int>(std::ceil(place));
            selection.mSlices.push_back({planeAt(material, before, source),
                                         planeAt(material, after, source),
                                         place - static_cast<float>(before)});
        }
    }
    dropUnused();
    return selection;
}

const std::uint16_t* FarEnergies::planeAt(int material, int knot, const Source& source) {
    const subedit::MaterialMap& map = mapOf(material);
    auto plane = std::ranges::find_if(mPlanes, [&](const Plane& other) {
        return other.material == material && other.knot == knot;
    });
    if (plane == mPlanes.end()) {
        const subedit::TexelRect whole{0, 0, map.width, map.height};
        plane = mPlanes.insert(plane, {material, knot, 0, {}, {}});
        plane->halves.resize(whole.texels() * kTexelHalves);
        source(material, knot, whole, plane->halves);
    }
    plane->selected = mSelected;
    for (const TexelChange& change : std::exchange(plane->changed, {})) {
        const subedit::TexelRect& rect = change.rect;
        mRead.resize(rect.texels() * kTexelHalves);
        source(material, knot, rect, mRead);
        const std::size_t row = static_cast<std::size_t>(rect.width) * kTexelHalves;
        for (int y = 0; y < rect.height; ++y) {
            const auto to =
                static_cast<std::size_t>(rect.y + y) * static_cast<std::size_t>(map.width) +
                static_cast<std::size_t>(rect.x);
            std::copy_n(mRead.data() + static_cast<std::size_t>(y) * row, row,
                        plane->halves.data() + to * kTexelHalves);
        }
    }
    return plane->halves.data();
}

void FarEnergies::dropUnused() {
    std::size_t bytes = 0;
    for (const Plane& plane : mPlanes) {
        bytes += plane.halves.size() * sizeof(std::uint16_t);
    }
    while (bytes > kSpareBytes) {
        const auto oldest = std::ranges::min_element(mPlanes, {}, &Plane::selected);
        if (oldest->selected == mSelected) {
            return;
        }
        bytes -= oldest->halves.size() * sizeof(std::uint16_t);
        mPlanes.erase(oldest);
    }
}

Four FarEnergies::Selection::at(std::size_t radius, int material, glm::vec2 uv) const {
    const auto m = static_cast<std::size_t>(material);
    CELADON_ASSERT(m < mSizes.size() && radius * mSizes.size() + m < mSlices.size());
    const Slice& slice = mSlices[radius * mSizes.size() + m];
    const glm::ivec2 size = mSizes[m];
    const subedit::RepeatTap x(uv.x, size.x);
    const subedit::RepeatTap y(uv.y, size.y);
    const auto texel = [&](int column, int row) {
        const std::size_t place =
            (static_cast<std::size_t>(row) * static_cast<std::size_t>(size.x) +
             static_cast<std::size_t>(column)) *
            kTexelHalves;
        const Four before = fromHalves(slice.before + place);
        return before + slice.along * (fromHalves(slice.after + place) - before);
    };
    const auto row = [&](int at) {
        const Four left = texel(x.first, at);
        return left + x.weight * (texel(x.second, at) - left);
    };
    const Four low = row(y.first);
    return low + y.weight * (row(y.second) - low);
}

} // namespace celadon
