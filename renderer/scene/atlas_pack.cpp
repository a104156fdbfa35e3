#include "renderer/scene/atlas_pack.h"

#include "renderer/scene/atlas_hull.h"
#include "renderer/scene/atlas_mask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

namespace celadon::atlas {
namespace {

/// Grids above this only cost time; gutters are rounded up to its cells.
constexpr int kLargestGrid = 1024;
/// How many shapes, largest first, are tried in sixteen, in eight and in four orientations.
constexpr std::size_t kSixteenWays = 32;
constexpr std::size_t kEightWays = 96;
constexpr std::size_t kFourWays = 512;
/// Once an order fits, other orders are tried at a larger scale, a batch at a time.
constexpr std::size_t kBatch = 6;
constexpr std::size_t kFutileBatches = 6;
constexpr std::size_t kMostReordered = 400; ///< shapes; above, chance evens out
/// Shapes from this one on start looking where the last one of their size was put.
constexpr std::size_t kHasty = 192;
constexpr double kSimilarSize = 0.9;
/// A shape keeps this distance, in cells, from the edges of its outermost cells, for rounding.
constexpr double kInset = 0.02;
constexpr double kLeastExtent = 0.9;
constexpr double kScaleStep = 0.99;
constexpr int kScaleSteps = 400; // 0.99^400 = 1/55

/// An outline turned by one of its orientations, lowest corner at the origin.
struct Pose {
    Eigen::Matrix2d rotation;
    std::vector<std::vector<Eigen::Vector2d>> loops;
    Eigen::Vector2d low; ///< lowest corner after the rotation, before the shift
    Eigen::Vector2d size;
};

Pose makePose(const Outline& outline, double angle) {
    Pose pose;
    pose.rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    pose.loops = outline.loops;
    pose.low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -pose.low;
    for (std::vector<Eigen::Vector2d>& loop : pose.loops) {
        for (Eigen::Vector2d& p : loop) {
            p = pose.rotation * p;
            pose.low = pose.low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    }
    for (std::vector<Eigen::Vector2d>& loop : pose.loops) {
        for (Eigen::Vector2d& p : loop) {
            p -= pose.low;
        }
    }
    pose.size = high - pose.low;
    return pose;
}

struct Shape {
    std::vector<Pose> poses;
    double area = 0.0;
    double extent = 0.0; ///< longer side of the first pose
};

/// What a shape occupies at a scale: its cells, and those with its gutter, which must be free.
struct Stamp {
    Mask body;
    Mask halo; ///< body dilated; its texel (gutter, gutter) is the body's (0, 0)
    std::vector<Eigen::Vector2i> probes; ///< texels of the halo, most telling first
    double scale = 0.0;
};

/// Border texels, thinly spread ones first: most places are refused by the first few.
std::vector<Eigen::Vector2i> findProbes(const Mask& halo) {
    std::vector<Eigen::Vector2i> border;
    for (int y = 0; y < halo.height(); ++y) {
        for (int x = 0; x < halo.width(); ++x) {
            if (halo.at(x, y) && (x == 0 || y == 0 || x + 1 == halo.width() ||
                                  y + 1 == halo.height() || !halo.at(x - 1, y) ||
                                  !halo.at(x + 1, y) || !halo.at(x, y - 1) || !halo.at(x, y + 1))) {
                border.emplace_back(x, y);
            }
        }
    }
    std::vector<Eigen::Vector2i> probes;
    probes.reserve(border.size());
    std::size_t stride = 1;
    while (stride * 2 < border.size()) {
        stride *= 2;
    }
    for (std::size_t i = 0; i < border.size(); i += stride) {
        probes.push_back(border[i]);
    }
    for (; stride > 1; stride /= 2) {
        for (std::size_t i = stride / 2; i < border.size(); i += stride) {
            probes.push_back(border[i]);
        }
    }
    return probes;
}

Stamp makeStamp(const Pose& pose, double cellsPerUnit, std::span<const int> reach) {
    Stamp stamp;
    stamp.scale = cellsPerUnit;
    const double extent = pose.size.maxCoeff() * cellsPerUnit;
    if (extent < kLeastExtent && extent > 0.0) {
        stamp.scale *= kLeastExtent / extent;
    }
    std::vector<std::vector<Eigen::Vector2d>> loops = pose.loops;
    for (std::vector<Eigen::Vector2d>& loop : loops) {
        for (Eigen::Vector2d& p : loop) {
            p = (stamp.scale * p).array() + kInset;
        }
    }
    const Eigen::Vector2d cells = stamp.scale * pose.size;
    stamp.body = rasterize(loops, static_cast<int>(cells.x() + 2.0 * kInset) + 1,
                           static_cast<int>(cells.y() + 2.0 * kInset) + 1);
    stamp.halo = stamp.body.dilated(reach);
    stamp.probes = findProbes(stamp.halo);
    return stamp;
}

/// The lowest, then leftmost place for the halo with its top below `ceiling`.
std::optional<Eigen::Vector2i> findPlace(const Mask& taken, const Stamp& stamp, int firstRow,
                                         int ceiling) {
    const int lastX = taken.width() - stamp.halo.width();
    const int lastY = std::min(ceiling, taken.height()) - stamp.halo.height();
    if (lastX < 0) {
        return std::nullopt;
    }
    for (int y = firstRow; y <= lastY; ++y) {
        for (int x = 0; x <= lastX; x += 64) {
            std::uint64_t blocked = lastX - x < 63 ? ~std::uint64_t{0} << (lastX - x + 1) : 0;
            for (const Eigen::Vector2i& probe : stamp.probes) {
                blocked |= taken.window(x + probe.x(), y + probe.y());
                if (~blocked == 0) {
                    break;
                }
            }
            for (std::uint64_t open = ~blocked; open != 0; open &= open - 1) {
                const int at = x + std::countr_zero(open);
                if (!taken.meets(stamp.halo, at, y)) { // probes see borders only
                    return Eigen::Vector2i(at, y);
                }
            }
        }
    }
    return std::nullopt;
}

class Packer {
public:
    /// @param reach which cells around a shape's must be free, as for Mask::dilated
    Packer(std::span<const Outline> outlines, int grid, std::vector<int> reach)
        : mGrid(grid),
          mReach(std::move(reach)),
          mGutter(static_cast<int>(mReach.size()) - 1),
          mShapes(outlines.size()) {
        std::vector<std::size_t> rank(outlines.size());
        std::iota(rank.begin(), rank.end(), 0);
        std::stable_sort(rank.begin(), rank.end(), [&](std::size_t a, std::size_t b) {
            return outlines[a].area > outlines[b].area;
        });
        tbb::parallel_for(std::size_t{0}, rank.size(), [&](std::size_t place) {
            const Outline& outline = outlines[rank[place]];
            Shape& shape = mShapes[rank[place]];
            const int ways = place < kSixteenWays ? 16
                             : place < kEightWays ? 8
                             : place < kFourWays  ? 4
                                                  : 1;
            const double upright = boxAngle(outline.loops);
            for (int way = 0; way < ways; ++way) {
                // Quarter turns first, then those between.
                const double turn = 0.25 * (2 * (way % 4) + (way / 4 % 2) + 0.5 * (way / 8));
                shape.poses.push_back(makePose(outline, upright + turn * std::numbers::pi));
            }
            shape.area = outline.area;
            shape.extent = shape.poses[0].size.maxCoeff();
        });
        for (const Outline& outline : outlines) {
            mArea += outline.area;
        }
    }

    /// Scales from the largest thinkable down, by bisection: what fits at a scale nearly always
    /// fits at a smaller one.
    [[nodiscard]] std::optional<std::vector<Placement>> packLargest() const {
        const double leastCells = 0.7 * (mGutter + 1) * (mGutter + 1);
        if (leastCells * static_cast<double>(mShapes.size()) > 1.0 * mGrid * mGrid) {
            return std::nullopt;
        }
        const double largest = mGrid / std::sqrt(mArea);
        const auto at = [&](int step) {
            const double cellsPerUnit = largest * std::pow(kScaleStep, step);
            return place(stampsAt(cellsPerUnit), 0, cellsPerUnit);
        };
        int fails = 0;
        int fits = 10;
        std::optional<std::vector<Placement>> best = at(fits);
        for (int stride = 8; !best; stride *= 2) {
            if (fits >= kScaleSteps) {
                return std::nullopt;
            }
            fails = fits;
            fits = std::min(fits + stride, kScaleSteps);
            best = at(fits);
        }
        while (fits - fails > 1) {
            const int middle = (fits + fails) / 2;
            if (auto packing = at(middle)) {
                best = std::move(packing);
                fits = middle;
            } else {
                fails = middle;
            }
        }
        if (mShapes.size() <= kMostReordered && mShapes.size() > 1) {
            reorder(largest, fits, *best);
        }
        return best;
    }

private:
    using Stamps = std::vector<std::vector<Stamp>>; ///< shape, pose

    /// Other orders and poses at ever larger scales, until several batches in a row do not fit.
    void reorder(double largest, int fits, std::vector<Placement>& best) const {
        unsigned variant = 1;
        for (std::size_t futile = 0; futile < kFutileBatches;) {
            const double cellsPerUnit = largest * std::pow(kScaleStep, fits - 1);
            const Stamps stamps = stampsAt(cellsPerUnit);
            for (; futile < kFutileBatches; ++futile) {
                std::array<std::optional<std::vector<Placement>>, kBatch> tries;
                tbb::parallel_for(std::size_t{0}, kBatch, [&](std::size_t i) {
                    tries[i] = place(stamps, variant + static_cast<unsigned>(i), cellsPerUnit);
                });
                variant += kBatch;
                const auto found = std::find_if(tries.begin(), tries.end(),
                                                [](const auto& t) { return t.has_value(); });
                if (found != tries.end()) {
                    best = std::move(**found);
                    --fits;
                    futile = 0;
                    break;
                }
            }
        }
    }

    /// Large ones first; variants other than 0 distort the sizes at random.
    [[nodiscard]] std::vector<std::size_t> orderBySize(unsigned variant) const {
        std::mt19937 random(variant);
        std::vector<double> size(mShapes.size());
        for (std::size_t i = 0; i < size.size(); ++i) {
            const double chance = static_cast<double>(random()) / 4294967296.0 - 0.5;
            const bool byArea = variant % 3 == 2;
            size[i] = (byArea ? std::sqrt(mShapes[i].area) : mShapes[i].extent) *
                      (variant == 0 ? 1.0 : std::exp(1.2 * chance));
        }
        std::vector<std::size_t> order(mShapes.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
        return order;
    }

    [[nodiscard]] Stamps stampsAt(double cellsPerUnit) const {
        Stamps stamps(mShapes.size());
        tbb::parallel_for(std::size_t{0}, mShapes.size(), [&](std::size_t i) {
            for (const Pose& pose : mShapes[i].poses) {
                stamps[i].push_back(makeStamp(pose, cellsPerUnit, mReach));
            }
        });
        return stamps;
    }
    [[nodiscard]] std::optional<std::vector<Placement>>
    place(const Stamps& stamps, unsigned variant, double cellsPerUnit) const {
        const std::vector<std::size_t> order = orderBySize(variant);
        std::mt19937 random(~variant);
        std::vector<Placement> placements(mShapes.size());
        Mask taken(mGrid, mGrid);
        int hintRow = 0;
        double hintExtent = std::numeric_limits<double>::infinity();
        for (std::size_t turn = 0; turn < order.size(); ++turn) {
            const Shape& shape = mShapes[order[turn]];
            int firstRow = 0;
            if (turn >= kHasty) {
                const double extent = std::max(shape.extent * cellsPerUnit, 1.0);
                if (extent < kSimilarSize * hintExtent) {
                    hintRow = 0;
                    hintExtent = extent;
                }
                firstRow = hintRow;
            }
            // The pose that ends lowest.
            const Stamp* stamp = nullptr;
            const Pose* pose = nullptr;
            Eigen::Vector2i corner(0, 0);
            int ceiling = mGrid;
            for (std::size_t i = 0; i < shape.poses.size(); ++i) {
                // Variants look at half of the poses: the flattest is not always the best.
                if (variant > 0 && shape.poses.size() > 1 && random() % 2 == 0 &&
                    (stamp != nullptr || i + 1 < shape.poses.size())) {
                    continue;
                }
                const Stamp& candidate = stamps[order[turn]][i];
                if (const auto found = findPlace(taken, candidate, firstRow, ceiling)) {
                    stamp = &candidate;
                    pose = &shape.poses[i];
                    corner = *found;
                    ceiling = found->y() + candidate.halo.height() - 1;
                }
            }
            if (stamp == nullptr) {
                return std::nullopt;
            }
            if (turn >= kHasty) {
                hintRow = corner.y();
            }
            corner.array() += mGutter;
            taken.add(stamp->body, corner.x(), corner.y());
            Placement& placement = placements[order[turn]];
            placement.linear = stamp->scale / mGrid * pose->rotation;
            placement.offset =
                ((corner.cast<double>() - stamp->scale * pose->low).array() + kInset) / mGrid;
        }
        return placements;
    }

    int mGrid;
    std::vector<int> mReach;
    int mGutter; ///< in cells
    std::vector<Shape> mShapes;
    double mArea = 0.0;
};

/// Which cells must be free around a used one, so that the texels in the two are more than
/// `gutterTexels` apart, center to center; a row of offsets per row distance.
std::vector<int> haloReach(int resolution, int grid, int gutterTexels) {
    if (gutterTexels == 0) {
        return {0};
    }
    const double texelsPerCell = static_cast<double>(resolution) / grid;
    const bool aligned = resolution % grid == 0;
    // Least distance of texels touched in cells that are `cells` apart.
    const auto texels = [&](int cells) {
        return cells == 0 ? 0.0 : std::floor((cells - 1) * texelsPerCell) + (aligned ? 1.0 : 0.0);
    };
    std::vector<int> reach;
    for (int row = 0; texels(row) <= gutterTexels; ++row) {
        int half = 0;
        while (std::hypot(texels(half + 1), texels(row)) <= gutterTexels) {
            ++half;
        }
        reach.push_back(half);
    }
    return reach;
}

} // namespace

Packing pack(std::span<const Outline> outlines, int resolution, int gutterTexels) {
    const int texelsPerCell = (resolution + kLargestGrid - 1) / kLargestGrid;
    int grid = std::max(8, resolution / texelsPerCell);
    gutterTexels = std::max(gutterTexels, 0);
    int held = std::min(gutterTexels, resolution / 3);
    for (;;) {
        if (auto placements =
                Packer(outlines, grid, haloReach(resolution, grid, held)).packLargest()) {
            return {std::move(*placements), held};
        }
        // More shapes than this resolution can keep apart: they must not overlap at least.
        if (held > 0) {
            held /= 2;
        } else {
            grid *= 2;
        }
    }
}

} // namespace celadon::atlas
