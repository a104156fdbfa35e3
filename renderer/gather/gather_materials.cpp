#include "renderer/gather/gather_materials.h"

#include "subedit/fast_exp.h"
#include "subedit/map/repeat_tap.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace celadon {

namespace {

constexpr float kLargestCode = 65535.0f;
constexpr float kRoomAbove = 3.0f; ///< of ln P above the largest: paint stays within the codes

CELADON_MULTIVERSION
void quantize(const float* logP, std::size_t count, float offset, float perStep,
              std::uint16_t* codes) {
    for (std::size_t i = 0; i < count; ++i) {
        const float code = (logP[i] - offset) * perStep + 0.5f;
        codes[i] = static_cast<std::uint16_t>(
            static_cast<int>(code < 0.0f ? 0.0f : (code > kLargestCode ? kLargestCode : code)));
    }
}

/// Texels of a map and their weights.
struct WeighedTexels {
    std::array<const float*, 4> logP;
    std::array<float, 4> weights; ///< per step of a code
};

using subedit::Eight;
using EightPlaces = std::int32_t __attribute__((vector_size(32)));
/// Where R, G, B and anything of two neighboring knots are in a load of eight numbers, which begin
/// with the first, or end with the last.
constexpr EightPlaces kAtFirst{0, 1, 2, 0, 3, 4, 5, 0};
constexpr EightPlaces kAtLast{2, 3, 4, 0, 5, 6, 7, 0};

[[gnu::always_inline]] inline void blend(const WeighedTexels& texels, std::size_t at, Eight& sum) {
    sum = Eight{};
    for (std::size_t i = 0; i < 4; ++i) {
        Eight values;
        std::memcpy(&values, texels.logP[i] + at, sizeof(values));
        sum += values * texels.weights[i];
    }
}

/// @param means  of two knots, where `places` says
[[gnu::always_inline]] inline void storeCodes(const Eight& means, const EightPlaces& places,
                                              float zero, std::uint16_t* codes) {
    constexpr EightPlaces kColors{-1, -1, -1, 0, -1, -1, -1, 0};
    Eight code = CELADON_CHOOSE(means, places) + zero;
    code = code < 0.0f ? Eight{} : code;
    code = code > kLargestCode ? Eight{} + kLargestCode : code;
    using EightCodes = std::uint16_t __attribute__((vector_size(16)));
    const auto packed =
        __builtin_convertvector(__builtin_convertvector(code, EightPlaces) & kColors, EightCodes);
    std::memcpy(codes, &packed, sizeof(packed));
}

/// [knots][3] of texels -> [knots][kKnotCodes] of their mean. @param knots at least 2
/// @param zero what a mean of 0 comes to, rounding included
CELADON_MULTIVERSION
void encodeMean(const WeighedTexels& texels, std::size_t knots, float zero, std::uint16_t* codes) {
    Eight means;
    if (knots == 2) { // less than what is loaded at once
        std::array<std::array<float, 8>, 4> values{};
        WeighedTexels copies = texels;
        for (std::size_t i = 0; i < 4; ++i) {
            std::copy_n(texels.logP[i], 6, values[i].data());
            copies.logP[i] = values[i].data();
        }
        blend(copies, 0, means);
        storeCodes(means, kAtFirst, zero, codes);
        return;
    }
    std::size_t knot = 0;
    for (; 3 * knot + 8 <= 3 * knots; knot += 2) {
        blend(texels, 3 * knot, means);
        storeCodes(means, kAtFirst, zero, codes + gather::kKnotCodes * knot);
    }
    // Nothing is read behind the last one: some were done already.
    knot = knots - 2;
    blend(texels, 3 * knot - 2, means);
    storeCodes(means, kAtLast, zero, codes + gather::kKnotCodes * knot);
}

CELADON_MULTIVERSION
void rootsOf(const std::uint16_t* codes, std::size_t count, float offset, float step,
             float* roots) {
    for (std::size_t i = 0; i < count; ++i) {
        roots[i] = subedit::fastExp(0.5f * (offset + step * static_cast<float>(codes[i])));
    }
}

gather::Knots knotsOf(const subedit::MaterialMap& map) {
    return {static_cast<float>(map.segments) / map.maxRadiusMm, map.segments, map.maxRadiusMm};
}

} // namespace

gather::Knots commonKnots(std::span<const MaterialPointer> materials) {
    gather::Knots common;
    float finest = 0.0f;
    for (const MaterialPointer& material : materials) {
        const gather::Knots own = knotsOf(*material);
        common.rangeMm = std::max(common.rangeMm, own.rangeMm);
        finest = std::max(finest, own.perMm);
    }
    common.segments = std::clamp(static_cast<int>(std::lround(common.rangeMm * finest)), 1,
                                 subedit::kMaxSegments);
    common.perMm = static_cast<float>(common.segments) / common.rangeMm;
    return common;
}

GatherMaterials::GatherMaterials(std::span<const MaterialPointer> materials)
    : mMaterials(materials.begin(), materials.end()) {
    update();
}

bool GatherMaterials::admit(float largestLogP) {
    if (largestLogP <= mLargestLogP) {
        return false;
    }
    update();
    return true;
}

void GatherMaterials::update() {
    mCommon = celadon::commonKnots(mMaterials);
    const auto sameKnots = [this](const MaterialPointer& material) {
        return material->segments == mCommon.segments && material->maxRadiusMm == mCommon.rangeMm;
    };
    mProfiles = gather::Profiles::Any;
    if (mMaterials.size() == 1 && mMaterials[0]->isHomogeneous()) {
        mProfiles = gather::Profiles::One;
    } else if (std::ranges::all_of(mMaterials, sameKnots)) {
        mProfiles = gather::Profiles::SameKnots;
    }
    int mostKnots = mCommon.segments + 1;
    float largest = subedit::kLogProfileFloor;
    for (const MaterialPointer& material : mMaterials) {
        largest = std::max(largest, *std::ranges::max_element(material->logProfile));
        mostKnots = std::max(mostKnots, material->knots());
    }
    mLargestProfile = static_cast<std::size_t>(mostKnots * gather::kKnotCodes);
    mScale.offset = subedit::kLogProfileFloor;
    mLargestLogP = largest + kRoomAbove;
    mScale.step = (mLargestLogP - subedit::kLogProfileFloor) / kLargestCode;
    const float halfLog2e = 0.5f * std::numbers::log2e_v<float>;
    mScale.exponentOffset = 2.0f * halfLog2e * mScale.offset;
    mScale.exponentStep = halfLog2e * mScale.step;
}

gather::Knots GatherMaterials::knots(int material) const {
    return knotsOf(map(material));
}

void GatherMaterials::encodeLogs(const float* logP, std::size_t count, std::uint16_t* codes) const {
    quantize(logP, count, mScale.offset, 1.0f / mScale.step, codes);
}

void GatherMaterials::encode(int material, glm::vec2 uv, std::uint16_t* codes) const {
    const subedit::MaterialMap& own = map(material);
    const subedit::RepeatTap x(uv.x, own.width);
    const subedit::RepeatTap y(uv.y, own.height);
    const auto knots = static_cast<std::size_t>(own.knots());
    const float perStep = 1.0f / mScale.step;
    WeighedTexels texels{};
    std::size_t i = 0;
    for (const auto& [row, high] :
         {std::pair(y.first, 1.0f - y.weight), std::pair(y.second, y.weight)}) {
        for (const auto& [column, wide] :
             {std::pair(x.first, 1.0f - x.weight), std::pair(x.second, x.weight)}) {
            texels.logP[i] = own.logProfile.data() + own.index(column, row, 0);
            texels.weights[i++] = wide * high * perStep;
        }
    }
    encodeMean(texels, knots, 0.5f - mScale.offset * perStep, codes);
}

void GatherMaterials::decodeRoots(int material, const std::uint16_t* codes, float* roots) const {
    const gather::Knots own = knots(material);
    const auto commonCount = static_cast<std::size_t>(mCommon.segments + 1);
    const auto ownCount = static_cast<std::size_t>(own.segments + 1);
    if (own.segments == mCommon.segments && own.rangeMm == mCommon.rangeMm) {
        rootsOf(codes, gather::kKnotCodes * ownCount, mScale.offset, mScale.step, roots);
        return;
    }
    for (std::size_t k = 0; k < commonCount; ++k) {
        const float r = static_cast<float>(k) / mCommon.perMm;
        const float position = r * own.perMm;
        const int segment = std::min(static_cast<int>(position), own.segments - 1);
        const float along = position - static_cast<float>(segment);
        const std::uint16_t* ends = codes + gather::kKnotCodes * segment;
        for (std::size_t c = 0; c < gather::kKnotCodes; ++c) {
            const auto a = static_cast<float>(ends[c]);
            const float code = a + (static_cast<float>(ends[c + gather::kKnotCodes]) - a) * along;
            roots[gather::kKnotCodes * k + c] =
                r <= own.rangeMm * 1.0001f
                    ? subedit::fastExp(0.5f * (mScale.offset + mScale.step * code))
                    : 0.0f;
        }
    }
}

} // namespace celadon
