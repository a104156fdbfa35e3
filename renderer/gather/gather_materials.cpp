#include "renderer/gather/gather_materials.h"

#include "subedit/fast_exp.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    constexpr std::size_t kMostValues = 3 * (subedit::kMaxSegments + 1);
    const subedit::MaterialMap& own = map(material);
    float logP[kMostValues];
    std::uint16_t packed[kMostValues];
    own.sampleLogProfile(uv, logP);
    const std::size_t count = 3 * static_cast<std::size_t>(own.knots());
    encodeLogs(logP, count, packed);
    for (std::size_t i = 0; i < count; i += 3) {
        std::copy_n(packed + i, 3, codes);
        codes[3] = 0; // the floor
        codes += gather::kKnotCodes;
    }
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
