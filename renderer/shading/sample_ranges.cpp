#include "renderer/shading/sample_ranges.h"

#include "subedit/assert.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace celadon {

namespace {

constexpr std::size_t kPixelsATask = 1 << 14;

/// Nothing behind this number sees another mesh.
std::uint32_t endOfMesh(std::uint32_t number, std::span<const std::uint32_t> meshEnds) {
    const auto end = std::ranges::lower_bound(meshEnds, number);
    return end == meshEnds.end() ? number : *end;
}

} // namespace

void findSampleRanges(std::span<const std::uint32_t> triangles, std::span<const float> centerDepths,
                      std::size_t pixels, std::span<const std::uint32_t> meshEnds,
                      std::vector<glm::vec2>& ranges) {
    CELADON_ASSERT(pixels == 0 || triangles.size() % pixels == 0);
    ranges.resize(pixels);
    const std::size_t samples = pixels == 0 ? 0 : triangles.size() / pixels;
    const bool isOneMesh = meshEnds.size() <= 1;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, kPixelsATask), [&](const auto& r) {
        for (std::size_t i = r.begin(); i < r.end(); ++i) {
            std::uint32_t least = triangles[i];
            std::uint32_t greatest = triangles[i];
            for (std::size_t s = 1; s < samples; ++s) {
                least = std::min(least, triangles[s * pixels + i]);
                greatest = std::max(greatest, triangles[s * pixels + i]);
            }
            if (greatest == 0) {
                ranges[i] = glm::vec2(0.0f);
                continue;
            }
            if (least == 0 || (!isOneMesh && greatest > endOfMesh(least, meshEnds))) {
                ranges[i] = glm::vec2(-1.0f);
                continue;
            }
            glm::vec2 range(centerDepths[i]);
            for (std::size_t s = 1; s < samples; ++s) {
                const float depth = centerDepths[s * pixels + i];
                range = {std::min(range.x, depth), std::max(range.y, depth)};
            }
            ranges[i] = range;
        }
    });
}

} // namespace celadon
