#include "renderer/gather/sample_tree.h"

#include "renderer/gather/morton.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace celadon {

namespace {

constexpr std::uint32_t kBlockTexels = 1024; ///< 32 x 32, one task

float lengthOf(const float* a, const float* b) {
    const float x = a[0] - b[0];
    const float y = a[1] - b[1];
    const float z = a[2] - b[2];
    return std::sqrt(x * x + y * y + z * z);
}

} // namespace

void SampleTree::build(const LightTexels& texels, const GatherMaterials& materials,
                       const TreeSettings& settings, const SampleTree* before,
                       const ChangedTexels& changed) {
    mMaterials = &materials;
    mSettings = settings;
    const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(texels.size)));
    const std::size_t levels =
        static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(side)));
    mLevels.resize(levels);
    mMeans.resize(levels);
    mMorton.resize(levels);
    mRoots.resize(levels);
    mRadii.resize(levels);
    mIsNew.resize(levels);
    makeLeaves(texels);
    for (std::size_t k = 1; k < levels; ++k) {
        makeParents(k);
    }
    if (before != nullptr && before->mMorton != mMorton) {
        before = nullptr;
    }
    if (materials.isHomogeneous()) {
        mCodes.resize(materials.largestProfile() + gather::kCodesBehind);
        materials.encode(0, {0.5f, 0.5f}, mCodes.data());
    } else {
        const auto used = std::min(levels, static_cast<std::size_t>(settings.levels));
        placeProfiles(used);
        for (std::size_t k = 0; k < used; ++k) {
            makeProfiles(texels, k, before, changed);
        }
    }
    measureDepths(texels);
    for (std::size_t k = 0; k < levels; ++k) {
        const std::size_t count = mLevels[k].nodes.size();
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 512), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                finishSample(k, i);
            }
        });
        if (settings.hierarchical) {
            growBalls(k);
        }
    }
    for (std::size_t k = levels; k-- > 0;) {
        if (settings.hierarchical) {
            dropReplaced(k);
        } else {
            select(k);
        }
    }
    for (std::size_t k = 0; k < levels; ++k) {
        bound(k);
        if (settings.hierarchical) {
            arrange(k);
        }
    }
}

SampleTree SampleTree::withoutWorkspace() const {
    SampleTree copy;
    copy.mMaterials = mMaterials;
    copy.mSettings = mSettings;
    copy.mLevels = mLevels;
    copy.mMorton = mMorton;
    copy.mCodes = mCodes;
    return copy;
}

void SampleTree::makeLeaves(const LightTexels& texels) {
    const std::uint32_t side = std::bit_ceil(static_cast<std::uint32_t>(texels.size));
    const std::uint32_t blocks = std::max(side * side / kBlockTexels, 1u);
    const auto texelOf = [&](std::uint32_t code) -> std::ptrdiff_t {
        const std::uint32_t x = compactBits(code);
        const std::uint32_t y = compactBits(code >> 1);
        const auto size = static_cast<std::uint32_t>(texels.size);
        return x < size && y < size ? std::ptrdiff_t(y) * texels.stride + std::ptrdiff_t(x) : -1;
    };
    const auto isLit = [&](std::ptrdiff_t texel) {
        const float* flux = texels.fluxes + 4 * texel;
        return flux[0] + flux[1] + flux[2] > 0.0f;
    };
    const std::uint32_t perBlock = std::min(kBlockTexels, side * side);
    std::vector<std::size_t> starts(blocks + 1, 0);
    tbb::parallel_for(0u, blocks, [&](std::uint32_t block) {
        std::size_t lit = 0;
        for (std::uint32_t i = 0; i < perBlock; ++i) {
            const std::ptrdiff_t texel = texelOf(block * perBlock + i);
            lit += texel >= 0 && isLit(texel) ? 1 : 0;
        }
        starts[block + 1] = lit;
    });
    for (std::uint32_t block = 0; block < blocks; ++block) {
        starts[block + 1] += starts[block];
    }
    const std::size_t count = starts[blocks];
    mMeans[0].resize(count);
    mMorton[0].resize(count);
    mLevels[0].nodes.resize(count);
    mLevels[0].samples.resize(count);
    tbb::parallel_for(0u, blocks, [&](std::uint32_t block) {
        std::size_t out = starts[block];
        for (std::uint32_t i = 0; i < perBlock; ++i) {
            const std::uint32_t code = block * perBlock + i;
            const std::ptrdiff_t texel = texelOf(code);
            if (texel < 0 || !isLit(texel)) {
                continue;
            }
            const float* flux = texels.fluxes + 4 * texel;
            const float* position = texels.positions + 4 * texel;
            const float* normal = texels.normals + 4 * texel;
            const float* covariance = texels.covariances + 4 * texel;
            const float* extent = texels.extents + 4 * texel;
            const float* kept = texels.kepts + 4 * texel;
            mMeans[0][out] = {
                {flux[0], flux[1], flux[2]},
                flux[0] + flux[1] + flux[2],
                {position[0], position[1], position[2]},
                position[3],
                {normal[0], normal[1], normal[2]},
                normal[3],
                {covariance[0], covariance[1], covariance[2], covariance[3], extent[0], extent[1]},
                extent[2],
                extent[3],
                kept[3],
                {kept[0], kept[1], kept[2]},
                static_cast<std::int32_t>(texels.surfaces[4 * texel + 2])};
            mMorton[0][out] = code;
            mLevels[0].nodes[out].children = 0;
            ++out;
        }
    });
}

void SampleTree::makeParents(std::size_t level) {
    const std::vector<std::uint32_t>& below = mMorton[level - 1];
    std::vector<std::uint32_t>& codes = mMorton[level];
    std::vector<TreeNode>& nodes = mLevels[level].nodes;
    codes.clear();
    nodes.clear();
    for (std::size_t i = 0; i < below.size(); ++i) {
        if (codes.empty() || codes.back() != below[i] >> 2) {
            codes.push_back(below[i] >> 2);
            TreeNode node{};
            node.first = static_cast<std::uint32_t>(i);
            nodes.push_back(node);
        }
        ++nodes.back().children;
    }
    mMeans[level].resize(nodes.size());
    mLevels[level].samples.resize(nodes.size());
    const std::vector<Mean>& parts = mMeans[level - 1];
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 512),
                      [&](const auto& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              Mean mean{};
                              float heaviest = 0.0f;
                              const std::size_t first = nodes[i].first;
                              const std::size_t end = first + nodes[i].children;
                              for (std::size_t j = first; j < end; ++j) {
                                  const Mean& part = parts[j];
                                  const float w = part.weight;
                                  mean.weight += w;
                                  mean.depth += w * part.depth;
                                  mean.cosine += w * part.cosine;
                                  mean.R_P += w * part.R_P;
                                  mean.R_cut += w * part.R_cut;
                                  mean.R_Pmin += w * part.R_Pmin;
                                  for (int c = 0; c < 3; ++c) {
                                      mean.flux[c] += part.flux[c];
                                      mean.position[c] += w * part.position[c];
                                      mean.normal[c] += w * part.normal[c];
                                      mean.kept[c] += w * part.kept[c];
                                  }
                                  if (w > heaviest) {
                                      heaviest = w;
                                      mean.material = part.material;
                                  }
                              }
                              const float scale = 1.0f / mean.weight;
                              mean.depth *= scale;
                              mean.cosine *= scale;
                              mean.R_P *= scale;
                              mean.R_cut *= scale;
                              mean.R_Pmin *= scale;
                              for (int c = 0; c < 3; ++c) {
                                  mean.position[c] *= scale;
                                  mean.kept[c] *= scale;
                              }
                              const float length = std::sqrt(mean.normal[0] * mean.normal[0] +
                                                             mean.normal[1] * mean.normal[1] +
                                                             mean.normal[2] * mean.normal[2]);
                              for (float& n : mean.normal) {
                                  n = length > 0.0f ? n / length : 0.0f;
                              }
                              for (std::size_t j = first; j < end; ++j) {
                                  const Mean& part = parts[j];
                                  const float w = part.weight * scale;
                                  const float x = part.position[0] - mean.position[0];
                                  const float y = part.position[1] - mean.position[1];
                                  const float z = part.position[2] - mean.position[2];
                                  const float outer[6] = {x * x, x * y, x * z, y * y, y * z, z * z};
                                  for (int c = 0; c < 6; ++c) {
                                      mean.covariance[c] += w * (part.covariance[c] + outer[c]);
                                  }
                              }
                              mMeans[level][i] = mean;
                          }
                      });
}

void SampleTree::finishSample(std::size_t level, std::size_t i) {
    const Mean& mean = mMeans[level][i];
    gather::Sample& sample = mLevels[level].samples[i];
    TreeNode& node = mLevels[level].nodes[i];
    const auto* c = mean.covariance;
    std::copy_n(mean.position, 3, sample.position);
    std::copy_n(mean.position, 3, node.position);
    sample.variance = c[0] + c[3] + c[5];
    sample.diagonal[0] = c[0];
    sample.diagonal[1] = c[3];
    sample.diagonal[2] = c[5];
    sample.offDiagonal[0] = c[1];
    sample.offDiagonal[1] = c[2];
    sample.offDiagonal[2] = c[4];
    for (int channel = 0; channel < 3; ++channel) {
        sample.flux[channel] = mSettings.cutEnergy < 1.0 ? mean.flux[channel] / mean.kept[channel]
                                                         : mean.flux[channel];
    }
    sample.ball = 0.0f;
    node.ball = 0.0f;
    node.material = static_cast<std::int16_t>(mean.material);
    node.R_P = mean.R_P;
    node.selected = level < static_cast<std::size_t>(mSettings.levels);
    node.reach = mSettings.hierarchical ? mMaterials->commonKnots().rangeMm : mean.R_cut;
    if (mMaterials->isHomogeneous()) {
        sample.profile = 0;
    }
    sample.knots = level == 0 ? mMaterials->knots(mean.material) : mMaterials->commonKnots();
    if (!node.selected) {
        return;
    }
    const std::uint16_t* codes = mCodes.data() + sample.profile;
    float steepest = 0.0f;
    for (int channel = 0; channel < 3; ++channel) {
        const std::uint16_t* own = codes + channel;
        steepest = std::max(steepest, static_cast<float>(own[0]) -
                                          static_cast<float>(own[gather::kKnotCodes]));
    }
    sample.steepness = steepest * mMaterials->scale().step * sample.knots.perMm;
}

void SampleTree::bound(std::size_t level) {
    std::vector<TreeNode>& nodes = mLevels[level].nodes;
    for (TreeNode& node : nodes) {
        node.extent = 0.0f;
        if (!node.selected) {
            node.reach = 0.0f;
        }
        for (std::uint32_t j = node.first; level > 0 && j < node.first + node.children; ++j) {
            const TreeNode& child = mLevels[level - 1].nodes[j];
            node.extent =
                std::max(node.extent, lengthOf(child.position, node.position) + child.extent);
            node.reach = std::max(node.reach, child.reach);
        }
    }
}

void SampleTree::arrange(std::size_t level) {
    const std::vector<TreeNode>& nodes = mLevels[level].nodes;
    std::vector<NodeBall>& balls = mLevels[level].balls;
    balls.resize(nodes.size() + kSiblings - 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const TreeNode& node = nodes[i];
        balls[i] = {node.position[0], node.position[1], node.position[2],
                    node.ball,        node.extent,      mLevels[level].samples[i].knots.rangeMm,
                    node.first,       node.children};
    }
}

SampleTree::Counts SampleTree::count() const {
    Counts counts;
    counts.selected.assign(static_cast<std::size_t>(mSettings.levels), 0);
    for (std::size_t k = 0; k < counts.selected.size() && k < mLevels.size(); ++k) {
        counts.candidates += mLevels[k].nodes.size();
        for (std::size_t i = 0; i < mLevels[k].nodes.size(); ++i) {
            const TreeNode& node = mLevels[k].nodes[i];
            const float* flux = mMeans[k][i].flux;
            for (std::size_t c = 0; c < 3; ++c) {
                counts.litFlux[c] += k == 0 ? static_cast<double>(flux[c]) : 0.0;
                counts.selectedFlux[c] +=
                    node.selected && node.ball == 0.0f ? static_cast<double>(flux[c]) : 0.0;
            }
            counts.selected[k] += node.selected && node.ball < kNeverUsed ? 1 : 0;
        }
    }
    return counts;
}

} // namespace celadon
