// Profiles of the tree's nodes: of leaves the material's own, above them the flux-weighted mean of
// sqrt(P) over the footprint, and the radii that follow. Paired with shaders/node_profile.comp and
// shaders/node_radii.comp.
#include "renderer/gather/morton.h"
#include "renderer/gather/sample_tree.h"
#include "subedit/log_linear.h"
#include "subedit/multiversion.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace celadon {

namespace {

constexpr float kLeastRoot = 1e-7f;
constexpr int kMostKnots = subedit::kMaxSegments + 1;

/// Natural logarithm, relative error below 1e-6 of 1 + |ln x|; no calls, so that loops become
/// vectors. x > 0 and normal.
inline float fastLog(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    // x = 2^e m with m in [sqrt(1/2), sqrt(2)).
    const std::uint32_t shifted = bits - 0x3f3504f3u;
    const auto exponent = static_cast<float>(static_cast<std::int32_t>(shifted) >> 23);
    const float m = std::bit_cast<float>((shifted & 0x007fffffu) + 0x3f3504f3u);
    const float s = (m - 1.0f) / (m + 1.0f); // ln m = 2 artanh(s), |s| < 0.172
    const float s2 = s * s;
    return exponent * 0.69314718f +
           2.0f * s * (1.0f + s2 * (1.0f / 3 + s2 * (0.2f + s2 * (1.0f / 7))));
}

CELADON_MULTIVERSION
void addRoots(const float* roots, float weight, int count, float* sum) {
    for (int i = 0; i < count; ++i) {
        sum[i] += weight * roots[i];
    }
}

CELADON_MULTIVERSION
void logsOf(const float* roots, int count, float* logP) {
    for (int i = 0; i < count; ++i) {
        const float l = 2.0f * fastLog(roots[i] > kLeastRoot ? roots[i] : kLeastRoot);
        logP[i] = l > subedit::kLogProfileFloor ? l : subedit::kLogProfileFloor;
    }
}

/// Energy of each segment in closed form, see node_radii.comp: P at the knots, ln P for the slope.
CELADON_MULTIVERSION
void segmentEnergies(const float* P, const float* logP, int segments, float h, float* energy) {
    for (int k = 0; k < segments; ++k) {
        const float s = logP[k + 1] - logP[k];
        const float e = P[k + 1] / P[k];
        const bool small = (s < 0.0f ? -s : s) < 0.02f;
        const float safe = small ? 1.0f : s;
        const float first = small ? 1.0f + s * (0.5f + s / 6.0f) : (e - 1.0f) / safe;
        const float second =
            small ? 0.5f + s * (1.0f / 3.0f + s / 8.0f) : (e * (s - 1.0f) + 1.0f) / (safe * safe);
        energy[k] = P[k] * h * (static_cast<float>(k) * h * first + h * second);
    }
}

} // namespace

/// @param roots, logP  [segments + 1][kKnotCodes]
SampleTree::Radii SampleTree::radiiOf(const float* roots, const float* logP, int segments, float h,
                                      double cutEnergy) {
    Radii radii;
    float energy[3][kMostKnots];
    float P[kMostKnots];
    float logs[3][kMostKnots];
    float total[3];
    const auto crossing = [&](int c, float wanted) {
        float sum = 0.0f;
        for (int k = 0; k < segments; ++k) {
            if (sum + energy[c][k] >= wanted) {
                return h *
                       (static_cast<float>(k) + (wanted - sum) / std::max(energy[c][k], 1e-30f));
            }
            sum += energy[c][k];
        }
        return h * static_cast<float>(segments);
    };
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k <= segments; ++k) {
            const int i = k * gather::kKnotCodes + c;
            const float root = std::max(roots[i], 3.059e-7f); // e^-15, the floor
            P[k] = root * root;
            logs[c][k] = logP[i];
        }
        segmentEnergies(P, logs[c], segments, h, energy[c]);
        total[c] = 0.0f;
        for (int k = 0; k < segments; ++k) {
            total[c] += energy[c][k];
        }
        const float R_P = crossing(c, 0.95f * total[c]);
        radii.longest = std::max(radii.longest, R_P);
        radii.shortest = std::min(radii.shortest, R_P);
        if (cutEnergy < 1.0) {
            radii.cut = std::max(radii.cut, crossing(c, static_cast<float>(cutEnergy) * total[c]));
        }
    }
    if (cutEnergy >= 1.0) {
        radii.cut = h * static_cast<float>(segments);
        return radii;
    }
    for (int c = 0; c < 3; ++c) {
        const float position = radii.cut / h;
        const int whole = std::min(static_cast<int>(position), segments - 1);
        float inside = 0.0f;
        for (int k = 0; k < whole; ++k) {
            inside += energy[c][k];
        }
        inside += static_cast<float>(subedit::pieceEnergy(
            static_cast<double>(logs[c][whole]), static_cast<double>(logs[c][whole + 1]),
            static_cast<double>(static_cast<float>(whole) * h), static_cast<double>(h),
            static_cast<double>(position - static_cast<float>(whole))));
        radii.kept[c] = std::clamp(inside / std::max(total[c], 1e-30f), 0.5f, 1.0f);
    }
    return radii;
}

void SampleTree::setRadii(Mean& mean, const Radii& radii) {
    mean.R_P = radii.longest;
    mean.R_Pmin = radii.shortest;
    mean.R_cut = radii.cut;
    std::copy_n(radii.kept, 3, mean.kept);
}

/// How many the profile of a node has.
std::size_t SampleTree::codesOf(std::size_t level, std::size_t i) const {
    const int knots = level == 0 ? mMaterials->map(mMeans[0][i].material).knots()
                                 : mMaterials->commonKnots().segments + 1;
    return static_cast<std::size_t>(gather::kKnotCodes * knots);
}

/// Where the codes of each profile of the first levels are to stand.
void SampleTree::placeProfiles(std::size_t levels) {
    std::size_t end = 0;
    for (std::size_t k = 0; k < levels; ++k) {
        std::vector<gather::Sample>& samples = mLevels[k].samples;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i].profile = static_cast<std::uint32_t>(end);
            end += codesOf(k, i);
        }
    }
    mCodes.resize(end + gather::kCodesBehind);
}

void SampleTree::makeProfiles(const LightTexels& texels, std::size_t level,
                              const SampleTree* before, const ChangedTexels& changed) {
    Level& here = mLevels[level];
    const std::size_t count = here.nodes.size();
    const gather::Knots common = mMaterials->commonKnots();
    const int values = gather::kKnotCodes * (common.segments + 1);
    const bool needsRoots = level + 1 < static_cast<std::size_t>(mSettings.levels);

    mRoots[level].resize(needsRoots || level > 0 ? count * static_cast<std::size_t>(values) : 0);
    mRadii[level].resize(level > 0 ? count : 0);
    mIsNew[level].resize(count);
    // Roots and radii of what is not new stand where they were made; codes are the other tree's.
    const auto keep = [&](std::size_t i) {
        const std::size_t first = here.samples[i].profile;
        std::copy_n(before->mCodes.data() + first, codesOf(level, i), mCodes.data() + first);
    };

    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 128), [&](const auto& range) {
        std::vector<float> scratch(mMaterials->largestProfile());
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            std::uint16_t* out = mCodes.data() + here.samples[i].profile;
            float* roots = mRoots[level].empty()
                               ? nullptr
                               : mRoots[level].data() + i * static_cast<std::size_t>(values);
            Mean& mean = mMeans[level][i];
            std::uint8_t& isNew = mIsNew[level][i];
            isNew = before == nullptr ? 1 : 0;
            if (level == 0) {
                const std::uint32_t code = mMorton[0][i];
                const std::size_t texel =
                    std::size_t{compactBits(code >> 1)} * static_cast<std::size_t>(texels.stride) +
                    compactBits(code);
                const glm::vec2 uv(texels.surfaces[4 * texel], texels.surfaces[4 * texel + 1]);
                if (changed.touch(mean.material, uv)) {
                    isNew = 1;
                }
                if (isNew == 0) {
                    keep(i);
                    continue;
                }
                mMaterials->encode(mean.material, uv, out);
                if (roots != nullptr) {
                    mMaterials->decodeRoots(mean.material, out, roots);
                }
                continue;
            }
            const TreeNode& node = here.nodes[i];
            const std::size_t endChild = node.first + std::size_t{node.children};
            for (std::size_t j = node.first; j < endChild; ++j) {
                isNew = std::max(isNew, mIsNew[level - 1][j]);
            }
            Radii& radii = mRadii[level][i];
            if (isNew == 0) {
                keep(i);
                setRadii(mean, radii);
                continue;
            }
            std::fill_n(roots, values, 0.0f);
            for (std::size_t j = node.first; j < endChild; ++j) {
                addRoots(mRoots[level - 1].data() + j * static_cast<std::size_t>(values),
                         mMeans[level - 1][j].weight / mean.weight, values, roots);
            }
            logsOf(roots, values, scratch.data());
            mMaterials->encodeLogs(scratch.data(), static_cast<std::size_t>(values), out);
            radii = radiiOf(roots, scratch.data(), common.segments, 1.0f / common.perMm,
                            mSettings.cutEnergy);
            setRadii(mean, radii);
        }
    });
}

} // namespace celadon
