#include "renderer/reference/patch_gather.h"

#include "renderer/reference/gather_kernel.h"
#include "renderer/reference/spatial_order.h"
#include "subedit/assert.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

namespace celadon {

namespace {

using subedit::MaterialMap;

constexpr std::size_t kExitBlock = 512;
constexpr double kSquareMillimetersPerSquareMeter = 1e6;

/// A run [begin, end) of the sorted order: near each other, of one material.
struct Block {
    std::size_t begin, end;
    int material;
    PointBounds bounds;
    float largestSpread = 0.0f;
};

/// The chosen points in an order of material first and place second.
template<typename Point>
std::vector<std::uint32_t> blockOrder(std::span<const Point> points,
                                      std::span<const std::uint32_t> chosen) {
    std::vector<Point> picked;
    picked.reserve(chosen.size());
    for (const std::uint32_t i : chosen) {
        picked.push_back(points[i]);
    }
    std::vector<std::uint32_t> order = spatialOrder(std::span<const Point>(picked));
    for (std::uint32_t& i : order) {
        i = chosen[i];
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return points[i].material; });
    return order;
}

template<typename Point>
std::vector<Block> splitIntoBlocks(std::span<const Point> points,
                                   std::span<const std::uint32_t> order, std::size_t blockSize) {
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Point& point = points[order[i]];
        if (blocks.empty() || blocks.back().material != point.material ||
            i - blocks.back().begin == blockSize) {
            blocks.push_back({i, i, point.material, {}});
        }
        blocks.back().end = i + 1;
        blocks.back().bounds.add(point.positionMm);
    }
    return blocks;
}

/// Memory behind gather::Profiles; one per worker and side, reused.
struct ProfileStorage {
    std::vector<float> logKnots;
    std::vector<float> steepness;
    std::vector<float> scratch;

    /// Reads `count` profiles at uv(i). A homogeneous material gives one that all share.
    template<typename UvOf>
    gather::Profiles fill(const MaterialMap& material, std::size_t count, UvOf&& uvOf) {
        const bool shared = material.isHomogeneous();
        const std::size_t profiles = shared ? std::min<std::size_t>(count, 1) : count;
        const auto knots = static_cast<std::size_t>(material.knots());
        const auto segments = static_cast<std::size_t>(material.segments);
        const float knotsPerMm = static_cast<float>(material.segments) / material.maxRadiusMm;
        logKnots.resize(profiles * knots * 4);
        steepness.resize(profiles * segments);
        scratch.resize(knots * 3);
        for (std::size_t i = 0; i < profiles; ++i) {
            material.sampleLogProfile(uvOf(i), scratch.data());
            float* out = logKnots.data() + i * knots * 4;
            for (std::size_t k = 0; k < knots; ++k) {
                for (std::size_t c = 0; c < 3; ++c) {
                    out[4 * k + c] =
                        scratch[3 * k + c] * static_cast<float>(0.5 * std::numbers::log2e);
                }
                out[4 * k + 3] = 0.0f;
            }
            float steepest = 0.0f;
            for (std::size_t k = segments; k-- > 0;) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const float change = scratch[3 * (k + 1) + c] - scratch[3 * k + c];
                    steepest = std::max(steepest, 0.5f * std::abs(change) * knotsPerMm);
                }
                steepness[i * segments + k] = steepest;
            }
        }
        return {logKnots.data(), steepness.data(), material.segments, shared ? 0 : material.knots(),
                knotsPerMm};
    }
};

float traceOf(const Patch& patch) {
    return patch.covariance[0] + patch.covariance[3] + patch.covariance[5];
}

void fillPatchBlock(gather::PatchBlock& out, const Block& block, std::span<const Patch> patches,
                    std::span<const std::uint32_t> order) {
    out.count = static_cast<int>(block.end - block.begin);
    for (int axis = 0; axis < 3; ++axis) {
        out.low[axis] = block.bounds.low[axis];
        out.high[axis] = block.bounds.high[axis];
    }
    out.largestSpread = block.largestSpread;
    for (int j = 0; j < gather::kPatchBlock; ++j) {
        // The lanes past the end repeat the last patch; the kernel does not count them.
        const Patch& patch = patches[order[block.begin + std::min(j, out.count - 1)]];
        out.x[j] = patch.positionMm.x;
        out.y[j] = patch.positionMm.y;
        out.z[j] = patch.positionMm.z;
        out.xx[j] = patch.covariance[0];
        out.xy[j] = patch.covariance[1];
        out.xz[j] = patch.covariance[2];
        out.yy[j] = patch.covariance[3];
        out.yz[j] = patch.covariance[4];
        out.zz[j] = patch.covariance[5];
        out.variance[j] = traceOf(patch);
        out.flux[j][0] = patch.flux.r;
        out.flux[j][1] = patch.flux.g;
        out.flux[j][2] = patch.flux.b;
        out.flux[j][3] = 0.0f;
    }
}

gather::GatherFunction chooseKernel([[maybe_unused]] bool forcePortable) {
#ifdef CELADON_GATHER_AVX2
    if (!forcePortable && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        return gather::gatherAvx2;
    }
#endif
    return gather::gatherPortable;
}

/// What a worker thread keeps between blocks.
struct Worker {
    gather::PatchBlock patchBlock{};
    std::vector<PatchTriangle> corners;
    ProfileStorage patchProfiles;
    ProfileStorage exitProfiles;
    std::vector<float> positions;
    std::vector<double> sums;
    std::uint64_t pairs = 0;
};

/// Reports the part done, one call at a time, never backwards.
class ProgressReport {
public:
    ProgressReport(const std::function<void(double)>& callback, std::size_t total)
        : mCallback(callback), mTotal(total) {}

    void add(std::size_t done) {
        if (!mCallback) {
            return;
        }
        const std::scoped_lock lock(mMutex);
        mDone += done;
        mCallback(static_cast<double>(mDone) / static_cast<double>(mTotal));
    }

private:
    const std::function<void(double)>& mCallback;
    std::mutex mMutex;
    std::size_t mDone = 0;
    std::size_t mTotal;
};

} // namespace

GatherResult gatherExitance(std::span<const ExitPoint> exitPoints, std::span<const Patch> patches,
                            std::span<const MaterialPointer> materials,
                            const GatherOptions& options) {
    static_assert(sizeof(PatchTriangle) == 9 * sizeof(float));
    CELADON_ASSERT(options.triangles.empty() || options.triangles.size() == patches.size());
    GatherResult result;
    result.exitance.assign(exitPoints.size(), glm::vec3(0.0f));

    std::vector<std::uint32_t> chosen;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        CELADON_ASSERT(patches[i].material >= 0 &&
                       static_cast<std::size_t>(patches[i].material) < materials.size());
        if (patches[i].flux != glm::vec3(0.0f)) {
            chosen.push_back(i);
        }
    }
    const std::vector<std::uint32_t> patchOrder = blockOrder<Patch>(patches, chosen);
    std::vector<Block> patchBlocks =
        splitIntoBlocks(patches, std::span(patchOrder), gather::kPatchBlock);
    for (Block& block : patchBlocks) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
            block.largestSpread =
                std::max(block.largestSpread, std::sqrt(traceOf(patches[patchOrder[i]])));
        }
    }
    chosen.clear();
    for (std::uint32_t i = 0; i < exitPoints.size(); ++i) {
        CELADON_ASSERT(exitPoints[i].material < static_cast<int>(materials.size()));
        if (exitPoints[i].material >= 0) {
            chosen.push_back(i);
        }
    }
    const std::vector<std::uint32_t> exitOrder = blockOrder<ExitPoint>(exitPoints, chosen);
    const std::vector<Block> exitBlocks =
        splitIntoBlocks(exitPoints, std::span(exitOrder), kExitBlock);

    const gather::GatherFunction kernel = chooseKernel(options.forcePortable);
    const auto isCancelled = [&] {
        return options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed);
    };
    ProgressReport progress(options.progress, std::max<std::size_t>(exitOrder.size(), 1));
    tbb::enumerable_thread_specific<Worker> workers;

    const auto gatherBlock = [&](const Block& block) {
        Worker& worker = workers.local();
        const MaterialMap& exitMaterial = *materials[block.material];
        const std::size_t count = block.end - block.begin;
        worker.positions.resize(3 * count);
        worker.sums.assign(3 * count, 0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p = exitPoints[exitOrder[block.begin + i]].positionMm;
            std::copy_n(&p.x, 3, worker.positions.begin() + 3 * i);
        }
        const gather::ExitBlock exits{
            worker.exitProfiles.fill(
                exitMaterial, count,
                [&](std::size_t i) { return exitPoints[exitOrder[block.begin + i]].uv; }),
            static_cast<int>(count), worker.positions.data(), worker.sums.data()};
        for (const Block& patchBlock : patchBlocks) {
            const MaterialMap& material = *materials[patchBlock.material];
            const float reach = std::min(material.maxRadiusMm, exitMaterial.maxRadiusMm);
            // 2.2 spreads: how far a footprint can reach towards the point, see the kernel.
            const float culled =
                options.pointSamples ? reach : reach + 2.2f * patchBlock.largestSpread;
            if (block.bounds.squaredDistance(patchBlock.bounds) > culled * culled) {
                continue;
            }
            if (isCancelled()) {
                return;
            }
            fillPatchBlock(worker.patchBlock, patchBlock, patches, patchOrder);
            if (!options.triangles.empty()) {
                worker.corners.clear();
                for (std::size_t i = patchBlock.begin; i < patchBlock.end; ++i) {
                    worker.corners.push_back(options.triangles[patchOrder[i]]);
                }
                worker.patchBlock.corners = &worker.corners.front()[0].x;
            }
            worker.patchBlock.profiles = worker.patchProfiles.fill(
                material, patchBlock.end - patchBlock.begin,
                [&](std::size_t i) { return patches[patchOrder[patchBlock.begin + i]].uv; });
            worker.pairs += kernel(exits, worker.patchBlock, reach, options.pointSamples);
        }
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec3& out = result.exitance[exitOrder[block.begin + i]];
            for (int c = 0; c < 3; ++c) {
                out[c] = static_cast<float>(worker.sums[3 * i + static_cast<std::size_t>(c)] *
                                            kSquareMillimetersPerSquareMeter);
            }
        }
        progress.add(count);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, exitBlocks.size(), 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              gatherBlock(exitBlocks[i]);
                          }
                      });
    for (const Worker& worker : workers) {
        result.pairs += worker.pairs;
    }
    result.cancelled = isCancelled();
    return result;
}

} // namespace celadon
