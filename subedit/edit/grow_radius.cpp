#include "subedit/edit/grow_radius.h"

#include "subedit/assert.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

constexpr float kTailAlbedo = 1e-4f; ///< relative; measured on baked materials: below 3e-5

} // namespace

float largestRadiusMm(const ProfileLayout& opened) {
    const int segments = std::min(
        static_cast<int>(static_cast<float>(opened.segments) * kLargestGrowth), kMaxSegments);
    return opened.spacingMm() * static_cast<float>(segments);
}

std::optional<ProfileLayout> grownLayout(const ProfileLayout& layout, float neededMm,
                                         float largestMm) {
    constexpr float kSlack = 1.0f + 1e-5f; // rounding is no reason to grow
    if (neededMm <= layout.maxRadiusMm * kSlack) {
        return std::nullopt;
    }
    const float spacing = layout.spacingMm();
    const int most = std::min(static_cast<int>(std::lround(largestMm / spacing)), kMaxSegments);
    int segments = layout.segments;
    while (segments < most && static_cast<float>(segments) * spacing * kSlack < neededMm) {
        segments = std::min(segments + std::max(segments / 4, 1), most);
    }
    if (segments == layout.segments) {
        return std::nullopt;
    }
    return ProfileLayout{segments, spacing * static_cast<float>(segments)};
}

bool growProfile(const float* before, const ProfileLayout& from, ProfileEditor& editor,
                 const ProfileLayout& to, float* after) {
    std::copy_n(before, from.values(), editor.values());
    std::fill(editor.values() + from.values(), editor.values() + to.values(), kLogProfileFloor);
    editor.measure();
    // What the old knots hold: the tail is the one segment after them.
    bool isChanged = false;
    const double h = static_cast<double>(from.spacingMm());
    for (int c = 0; c < 3; ++c) {
        const auto last = static_cast<std::size_t>(from.segments) * 3 + static_cast<std::size_t>(c);
        const double fall = static_cast<double>(before[last] - kLogProfileFloor);
        if (fall <= 0.0 || editor.isBlack(c)) {
            continue;
        }
        // Integral of P r dr over the segment for e^fall >> 1: P(r_s) h / fall (r_s + h / fall).
        const double tail = 6.283185307179586 * std::exp(static_cast<double>(before[last])) * h /
                            fall * (static_cast<double>(from.maxRadiusMm) + h / fall);
        const float albedo = editor.albedo()[c];
        if (static_cast<float>(tail) > kTailAlbedo * albedo ||
            (albedo > kLargestAlbedo && albedo - static_cast<float>(tail) <= 1.0f)) {
            editor.setAlbedo(c, std::min(albedo - static_cast<float>(tail), kLargestAlbedo));
            isChanged = true;
        }
    }
    std::copy_n(editor.result(), to.values(), after);
    return isChanged;
}

Growth growRadius(MaterialMap& map, const ProfileLayout& to) {
    const ProfileLayout from = layoutOf(map);
    CELADON_ASSERT(to.segments > from.segments && to.segments <= kMaxSegments);
    const std::size_t texels = map.logProfile.size() / from.values();
    std::vector<float> grown(texels * to.values());
    std::vector<std::uint8_t> isChanged(texels, 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels, 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          ProfileEditor editor(to);
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              isChanged[i] =
                                  growProfile(map.logProfile.data() + i * from.values(), from,
                                              editor, to, grown.data() + i * to.values());
                          }
                      });
    Growth growth{from, to, {}, {}};
    for (std::size_t i = 0; i < texels; ++i) {
        if (isChanged[i] != 0) {
            growth.changedTexels.push_back(static_cast<std::uint32_t>(i));
            const float* before = map.logProfile.data() + i * from.values();
            growth.before.insert(growth.before.end(), before, before + from.values());
        }
    }
    map.logProfile = std::move(grown);
    map.segments = to.segments;
    map.maxRadiusMm = to.maxRadiusMm;
    return growth;
}

void undoGrowth(MaterialMap& map, const Growth& growth) {
    CELADON_ASSERT(layoutOf(map) == growth.to);
    const std::size_t texels = map.logProfile.size() / growth.to.values();
    std::vector<float> shrunk(texels * growth.from.values());
    for (std::size_t i = 0; i < texels; ++i) {
        std::copy_n(map.logProfile.data() + i * growth.to.values(), growth.from.values(),
                    shrunk.data() + i * growth.from.values());
    }
    for (std::size_t i = 0; i < growth.changedTexels.size(); ++i) {
        std::copy_n(growth.before.data() + i * growth.from.values(), growth.from.values(),
                    shrunk.data() + growth.changedTexels[i] * growth.from.values());
    }
    map.logProfile = std::move(shrunk);
    map.segments = growth.from.segments;
    map.maxRadiusMm = growth.from.maxRadiusMm;
}

} // namespace celadon::subedit
