// Which nodes of the tree are samples. Paired with shaders/sample_selection.vert (paper) and
// shaders/node_ball.comp (hierarchical).
#include "renderer/gather/morton.h"
#include "renderer/gather/sample_tree.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace celadon {

namespace {

constexpr float kFarAway = 1e30f; ///< depth of background

/// Largest eigenvalue of a symmetric 3x3 matrix xx, xy, xz, yy, yz, zz, in closed form (Smith
/// 1961).
float largestEigenvalue(const float* m) {
    const float mean = (m[0] + m[3] + m[5]) / 3.0f;
    const float x = m[0] - mean;
    const float y = m[3] - mean;
    const float z = m[5] - mean;
    const float off = m[1] * m[1] + m[2] * m[2] + m[4] * m[4];
    const float p = std::sqrt(std::max((x * x + y * y + z * z + 2.0f * off) / 6.0f, 0.0f));
    if (p <= 1e-12f * std::max(mean, 1e-12f)) {
        return mean;
    }
    const float a = x / p;
    const float b = y / p;
    const float c = z / p;
    const float d = m[1] / p;
    const float e = m[2] / p;
    const float f = m[4] / p;
    const float halfDeterminant =
        0.5f * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e));
    return mean + 2.0f * p * std::cos(std::acos(std::clamp(halfDeterminant, -1.0f, 1.0f)) / 3.0f);
}

} // namespace

void SampleTree::measureDepths(const LightTexels& texels) {
    mDepths.clear();
    if (mSettings.hierarchical || !mSettings.adaptive) {
        return;
    }
    auto side = static_cast<std::size_t>(std::bit_ceil(static_cast<unsigned>(texels.size)));
    std::vector<std::array<float, 2>> finest(side * side, {kFarAway, kFarAway});
    for (int y = 0; y < texels.size; ++y) {
        for (int x = 0; x < texels.size; ++x) {
            const float depth = texels.positions[4 * (std::ptrdiff_t(y) * texels.stride + x) + 3];
            const float z = depth > 0.0f ? depth : kFarAway;
            finest[mortonCode(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))] = {z,
                                                                                                z};
        }
    }
    mDepths.push_back(std::move(finest));
    while (mDepths.back().size() > 1) {
        const auto& below = mDepths.back();
        std::vector<std::array<float, 2>> next(below.size() / 4);
        for (std::size_t i = 0; i < next.size(); ++i) {
            next[i] = below[4 * i];
            for (std::size_t j = 4 * i + 1; j < 4 * i + 4; ++j) {
                next[i][0] = std::min(next[i][0], below[j][0]);
                next[i][1] = std::max(next[i][1], below[j][1]);
            }
        }
        mDepths.push_back(std::move(next));
    }
}

void SampleTree::select(std::size_t level) {
    std::vector<TreeNode>& nodes = mLevels[level].nodes;
    const bool mayBeFit = mSettings.adaptive && level < static_cast<std::size_t>(mSettings.levels);
    // From the root down: a node whose parent is selected, or has a selected ancestor, has been
    // marked by its parent with ball = kNeverUsed.
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        TreeNode& node = nodes[i];
        const Mean& mean = mMeans[level][i];
        bool fit = level == 0;
        if (mayBeFit && !fit) {
            const auto [nearest, farthest] = mDepths[level][mMorton[level][i]];
            const float width = (mean.depth * mSettings.texelScale + mSettings.texelOffset) *
                                static_cast<float>(1u << level);
            fit = farthest - nearest < mSettings.discontinuityMm &&
                  width * mSettings.alpha <
                      mean.R_P * (mSettings.orientation ? std::abs(mean.cosine) : 1.0f);
        }
        const bool below = node.ball > 0.0f;
        node.selected = fit && !below;
        if ((node.selected || below) && level > 0) {
            for (std::uint32_t j = node.first; j < node.first + node.children; ++j) {
                mLevels[level - 1].nodes[j].ball = kNeverUsed;
            }
        }
        node.ball = 0.0f;
    }
}

/// Nodes whose parent stands for them at any distance.
void SampleTree::dropReplaced(std::size_t level) {
    if (level == 0 || level >= static_cast<std::size_t>(mSettings.levels)) {
        return;
    }
    for (const TreeNode& node : mLevels[level].nodes) {
        const bool replaced = node.ball == 0.0f || !node.selected;
        for (std::uint32_t j = node.first; j < node.first + node.children; ++j) {
            mLevels[level - 1].nodes[j].selected = !replaced;
        }
    }
}

void SampleTree::growBalls(std::size_t level) {
    std::vector<TreeNode>& nodes = mLevels[level].nodes;
    std::vector<gather::Sample>& samples = mLevels[level].samples;
    const float r_s = mMaterials->commonKnots().rangeMm;
    if (level == 0) {
        return;
    }
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, nodes.size(), 512), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                TreeNode& node = nodes[i];
                if (level >= static_cast<std::size_t>(mSettings.levels)) {
                    node.ball = samples[i].ball = kNeverUsed;
                    continue;
                }
                const Mean& mean = mMeans[level][i];
                float spread =
                    std::sqrt(12.0f * std::max(largestEigenvalue(mean.covariance), 0.0f));
                float nested = 0.0f;
                for (std::uint32_t j = node.first; j < node.first + node.children; ++j) {
                    const TreeNode& child = mLevels[level - 1].nodes[j];
                    const float x = child.position[0] - node.position[0];
                    const float y = child.position[1] - node.position[1];
                    const float z = child.position[2] - node.position[2];
                    const float offset = std::sqrt(x * x + y * y + z * z);
                    spread = std::max(spread, std::sqrt(8.0f) * offset);
                    if (child.ball > 0.0f) {
                        nested = std::max(nested, (1.0f + mSettings.fade) * child.ball + offset);
                    }
                }
                const bool fine = nested == 0.0f && spread < mSettings.fineSpread * mean.R_Pmin;
                const float radius = fine ? 0.0f : std::max(spread / mSettings.sampleAngle, nested);
                node.ball = samples[i].ball = radius < r_s ? radius : kNeverUsed;
            }
        });
}

} // namespace celadon
