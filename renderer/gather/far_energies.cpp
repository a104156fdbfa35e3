#include "renderer/gather/far_energies.h"

#include "subedit/assert.h"
#include "subedit/map/repeat_tap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon {

namespace {

constexpr std::size_t kTexelHalves = 8; ///< R, G, B and one unused, of two knots

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
    for (std::size_t i = static_cast<std::size_t>(material); i < mSlices.size();
         i += mMaterials.size()) {
        mSlices[i].changed = unite(mSlices[i].changed, rect);
    }
}

void FarEnergies::setRadii(std::span<const float> radiiMm, const Read& source) {
    mSlices.resize(radiiMm.size() * mMaterials.size());
    for (std::size_t i = 0; i < mSlices.size(); ++i) {
        Slice& slice = mSlices[i];
        const auto material = static_cast<int>(i % mMaterials.size());
        const subedit::MaterialMap& map = mapOf(material);
        const auto segments = static_cast<float>(map.segments);
        const float place =
            std::min(radiiMm[i / mMaterials.size()] / map.maxRadiusMm, 1.0f) * segments;
        const float before = std::min(std::floor(place), segments - 1.0f);
        slice.along = place - before;
        const subedit::TexelRect changed = std::exchange(slice.changed, {});
        if (const auto knot = static_cast<int>(before); knot != slice.knot) {
            slice.knot = knot;
            const subedit::TexelRect whole{0, 0, map.width, map.height};
            slice.halves.resize(whole.texels() * kTexelHalves);
            read(material, whole, source, slice);
        } else if (!changed.isEmpty()) {
            read(material, changed, source, slice);
        }
    }
}

void FarEnergies::read(int material, const subedit::TexelRect& rect, const Read& source,
                       Slice& slice) {
    const auto width = static_cast<std::size_t>(mapOf(material).width);
    const auto columns = static_cast<std::size_t>(rect.width);
    mRead.resize(rect.texels() * 4);
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        source(material, slice.knot + static_cast<int>(side), rect, mRead);
        for (std::size_t row = 0; row < static_cast<std::size_t>(rect.height); ++row) {
            const std::size_t first =
                (static_cast<std::size_t>(rect.y) + row) * width + static_cast<std::size_t>(rect.x);
            std::uint16_t* to = slice.halves.data() + first * kTexelHalves + 4 * side;
            const std::uint16_t* from = mRead.data() + row * columns * 4;
            for (std::size_t i = 0; i < columns; ++i, to += kTexelHalves, from += 4) {
                std::memcpy(to, from, 4 * sizeof(std::uint16_t));
            }
        }
    }
}

Four FarEnergies::at(std::size_t radius, int material, glm::vec2 uv) const {
    const std::size_t index = radius * mMaterials.size() + static_cast<std::size_t>(material);
    CELADON_ASSERT(index < mSlices.size());
    const Slice& slice = mSlices[index];
    const subedit::MaterialMap& map = mapOf(material);
    const subedit::RepeatTap x(uv.x, map.width);
    const subedit::RepeatTap y(uv.y, map.height);
    const auto texel = [&](int column, int row) {
        const auto place = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(column);
        const std::uint16_t* const halves = slice.halves.data() + place * kTexelHalves;
        const Four here = fromHalves(halves);
        return here + slice.along * (fromHalves(halves + 4) - here);
    };
    const auto row = [&](int at) {
        const Four left = texel(x.first, at);
        return left + x.weight * (texel(x.second, at) - left);
    };
    const Four low = row(y.first);
    return low + y.weight * (row(y.second) - low);
}

} // namespace celadon
