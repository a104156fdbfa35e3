#include "subedit/paint/surface.h"

#include "subedit/assert.h"
#include "subedit/errors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace celadon::subedit {

namespace {

constexpr int kMaxCellsPerAxis = 128;
/// Background texels up to this many steps from a chart repeat its border: bilinear filtering needs
/// one, mip levels more; the automatic atlas leaves four between charts.
constexpr int kGutterSteps = 8;
/// Cosine of the widest angle between a point's normal and that of the texel nearest to it.
constexpr float kFacingCosine = 0.2f;
/// Across a seam the surface may have an edge of up to 107 degrees, but the two sides of a thin
/// sheet, whose normals are opposite, are no neighbors.
constexpr float kSeamCosine = -0.3f;
/// Centers of the texels nearest to a seam lie up to half a diagonal from it on either side.
constexpr float kSeamReachTexels = 1.5f;

} // namespace

SurfaceAtlas makeFlatSurface(int width, int height, float widthMm) {
    CELADON_ASSERT(width > 0 && height > 0 && widthMm > 0.0f);
    SurfaceAtlas atlas;
    atlas.width = width;
    atlas.height = height;
    const float step = widthMm / static_cast<float>(width);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            atlas.positionMm.emplace_back((static_cast<float>(x) + 0.5f) * step,
                                          -(static_cast<float>(y) + 0.5f) * step, 0.0f);
        }
    }
    atlas.normal.assign(atlas.positionMm.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    atlas.chart.assign(atlas.positionMm.size(), 0);
    return atlas;
}

std::span<const Surface::Texel> Surface::TexelLists::of(Texel texel) const {
    if (begin.empty()) {
        return {};
    }
    return {items.data() + begin[texel], items.data() + begin[texel + 1]};
}

void Surface::TexelLists::build(std::size_t texels, std::vector<std::pair<Texel, Texel>> pairs) {
    begin.clear();
    items.clear();
    if (pairs.empty()) {
        return;
    }
    std::sort(pairs.begin(), pairs.end());
    begin.assign(texels + 1, 0);
    for (const auto& [owner, item] : pairs) {
        ++begin[owner + 1];
        items.push_back(item);
    }
    for (std::size_t i = 0; i < texels; ++i) {
        begin[i + 1] += begin[i];
    }
}

Surface::Surface(SurfaceAtlas atlas) : mAtlas(std::move(atlas)) {
    const std::size_t texels =
        static_cast<std::size_t>(mAtlas.width) * static_cast<std::size_t>(mAtlas.height);
    CELADON_ASSERT(mAtlas.positionMm.size() == texels && mAtlas.normal.size() == texels &&
                   mAtlas.chart.size() == texels);
    for (std::size_t i = 0; i < texels; ++i) {
        if (mAtlas.chart[i] >= 0) {
            mCovered.push_back(static_cast<Texel>(i));
        }
    }
    if (mCovered.empty()) {
        throw InputError("the surface to paint on", "covers no texel of the material's map",
                         "check the model's texture coordinates, or take a larger map");
    }
    buildGrid();
    measureTexels();
    linkSeams();
    fillGutters();
}

glm::ivec3 Surface::cellOf(const glm::vec3& positionMm) const {
    const glm::vec3 cell = glm::floor((positionMm - mLow) / mCellMm);
    // Clamped as floats: a point far away need not fit an integer.
    return glm::ivec3(glm::clamp(cell, glm::vec3(0.0f), glm::vec3(mCells - 1)));
}

std::size_t Surface::cellIndex(const glm::ivec3& cell) const {
    return static_cast<std::size_t>((cell.z * mCells.y + cell.y) * mCells.x + cell.x);
}

void Surface::buildGrid() {
    mLow = glm::vec3(std::numeric_limits<float>::max());
    mHigh = -mLow;
    for (const Texel texel : mCovered) {
        mLow = glm::min(mLow, mAtlas.positionMm[texel]);
        mHigh = glm::max(mHigh, mAtlas.positionMm[texel]);
    }
    const glm::vec3 extent = mHigh - mLow;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-6f});
    mCellMm = longest / kMaxCellsPerAxis * 1.0001f;
    mCells = glm::min(glm::ivec3(extent / mCellMm) + 1, glm::ivec3(kMaxCellsPerAxis));
    mCellBegin.assign(static_cast<std::size_t>(mCells.x) * static_cast<std::size_t>(mCells.y) *
                              static_cast<std::size_t>(mCells.z) +
                          1,
                      0);
    for (const Texel texel : mCovered) {
        ++mCellBegin[cellIndex(cellOf(mAtlas.positionMm[texel])) + 1];
    }
    for (std::size_t i = 1; i < mCellBegin.size(); ++i) {
        mCellBegin[i] += mCellBegin[i - 1];
    }
    std::vector<std::uint32_t> next(mCellBegin.begin(), mCellBegin.end() - 1);
    mCellTexels.resize(mCovered.size());
    for (const Texel texel : mCovered) {
        mCellTexels[next[cellIndex(cellOf(mAtlas.positionMm[texel]))]++] = texel;
    }
}

void Surface::measureTexels() {
    std::vector<float> sizes;
    const auto width = static_cast<Texel>(mAtlas.width);
    for (const Texel texel : mCovered) {
        const Texel right = texel + 1;
        const Texel below = texel + width;
        if (right % width != 0 && mAtlas.chart[right] == mAtlas.chart[texel]) {
            sizes.push_back(glm::distance(positionMm(texel), positionMm(right)));
        }
        if (below < mAtlas.chart.size() && mAtlas.chart[below] == mAtlas.chart[texel]) {
            sizes.push_back(glm::distance(positionMm(texel), positionMm(below)));
        }
    }
    if (sizes.empty()) {
        mTexelSizeMm = std::max(glm::distance(mLow, mHigh), 1e-6f);
        return;
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    mTexelSizeMm = std::max(*middle, 1e-6f);
}

void Surface::linkSeams() {
    const int width = mAtlas.width;
    // Length of the longest side of each texel at a chart's border, 0 within.
    std::vector<float> borderSize(texelCount(), 0.0f);
    for (const Texel texel : mCovered) {
        const int x = static_cast<int>(texel) % width;
        const int y = static_cast<int>(texel) / width;
        int neighbors = 0;
        float size = 0.0f;
        for (int ny = y - 1; ny <= y + 1; ++ny) {
            for (int nx = x - 1; nx <= x + 1; ++nx) {
                if (nx < 0 || ny < 0 || nx >= width || ny >= mAtlas.height) {
                    continue;
                }
                const auto other = static_cast<Texel>(ny * width + nx);
                if (mAtlas.chart[other] != mAtlas.chart[texel]) {
                    continue;
                }
                ++neighbors;
                if ((nx == x) != (ny == y)) {
                    size = std::max(size, glm::distance(positionMm(texel), positionMm(other)));
                }
            }
        }
        if (neighbors < 9) {
            borderSize[texel] = size > 0.0f ? size : mTexelSizeMm;
        }
    }
    std::vector<std::pair<Texel, Texel>> pairs;
    for (const Texel texel : mCovered) {
        if (borderSize[texel] <= 0.0f) {
            continue;
        }
        const int x = static_cast<int>(texel) % width;
        const int y = static_cast<int>(texel) / width;
        // The far side may have larger texels; it then looks for this one itself.
        const float reach = kSeamReachTexels * borderSize[texel];
        forEachWithin(positionMm(texel), reach, [&](Texel other) {
            const int dx = std::abs(static_cast<int>(other) % width - x);
            const int dy = std::abs(static_cast<int>(other) / width - y);
            const bool isOwnNeighbor =
                std::max(dx, dy) <= 1 && mAtlas.chart[other] == mAtlas.chart[texel];
            if (borderSize[other] > 0.0f && !isOwnNeighbor &&
                glm::dot(normal(other), normal(texel)) > kSeamCosine) {
                pairs.emplace_back(texel, other);
                pairs.emplace_back(other, texel);
            }
        });
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    mSeams.build(texelCount(), std::move(pairs));
}

void Surface::fillGutters() {
    mSource.assign(texelCount(), kNone);
    for (const Texel texel : mCovered) {
        mSource[texel] = texel;
    }
    const int width = mAtlas.width;
    std::vector<Texel> front = mCovered;
    std::vector<std::pair<Texel, Texel>> pairs;
    for (int step = 0; step < kGutterSteps && !front.empty(); ++step) {
        // All texels of this step choose before any is written: no direction is favored.
        std::vector<std::pair<Texel, Texel>> reached; // (background texel, source)
        for (const Texel texel : front) {
            const int x = static_cast<int>(texel) % width;
            const int y = static_cast<int>(texel) / width;
            for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, mAtlas.height - 1); ++ny) {
                for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
                    const auto other = static_cast<Texel>(ny * width + nx);
                    if (mSource[other] == kNone) {
                        reached.emplace_back(other, mSource[texel]);
                    }
                }
            }
        }
        const auto distance = [&](const std::pair<Texel, Texel>& pair) {
            const int dx =
                static_cast<int>(pair.first) % width - static_cast<int>(pair.second) % width;
            const int dy =
                static_cast<int>(pair.first) / width - static_cast<int>(pair.second) / width;
            return dx * dx + dy * dy;
        };
        std::sort(reached.begin(), reached.end(), [&](const auto& a, const auto& b) {
            return std::make_tuple(a.first, distance(a), a.second) <
                   std::make_tuple(b.first, distance(b), b.second);
        });
        front.clear();
        for (const auto& [texel, source] : reached) {
            if (mSource[texel] == kNone) {
                mSource[texel] = source;
                front.push_back(texel);
                pairs.emplace_back(source, texel);
            }
        }
    }
    mGutters.build(texelCount(), std::move(pairs));
}

std::span<const Surface::Texel> Surface::gutterOf(Texel texel) const {
    return mGutters.of(texel);
}

std::optional<Surface::Texel> Surface::nearest(const glm::vec3& point, const glm::vec3& facing,
                                               float withinMm) const {
    const bool isFacingGiven = glm::dot(facing, facing) > 0.0f;
    std::optional<Texel> best;
    // From small to large: most points lie within a texel of the surface.
    for (float radius = std::min(withinMm, 2.0f * mTexelSizeMm);; radius *= 2.0f) {
        radius = std::min(radius, withinMm);
        float bestSquared = std::numeric_limits<float>::max();
        forEachWithin(point, radius, [&](Texel texel) {
            if (isFacingGiven && glm::dot(facing, normal(texel)) <= kFacingCosine) {
                return;
            }
            const glm::vec3 d = positionMm(texel) - point;
            const float squared = glm::dot(d, d);
            if (squared < bestSquared || (squared == bestSquared && texel < *best)) {
                bestSquared = squared;
                best = texel;
            }
        });
        if (best || radius >= withinMm) {
            return best;
        }
    }
}

} // namespace celadon::subedit
