#include "subedit/edit/local_mean.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace celadon::subedit {

namespace {

constexpr int kCellsPerRadius = 2;

/// Of the six directions along the axes, the one nearest to a normal.
int sideOf(const glm::vec3& n) {
    const glm::vec3 a = glm::abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    return 2 * axis + (n[axis] < 0.0f ? 1 : 0);
}

} // namespace

struct LocalMean::Cell {
    CellKey key{};
    std::vector<Surface::Texel> texels;
    glm::vec3 centerMm{0.0f};
    glm::vec3 normal{0.0f};
    std::once_flag found;
    std::vector<std::uint32_t> near; ///< cells that texels of this one may look at, itself included
    std::once_flag measured;
    std::vector<float> mean;
};

LocalMean::LocalMean(const Surface& surface, const ProfileLayout& layout, float radiusMm,
                     const ProfileSource& source)
    : mSurface(surface),
      mLayout(layout),
      mRadiusMm(std::max(radiusMm, surface.texelSizeMm())),
      mCellMm(mRadiusMm / kCellsPerRadius),
      mSource(source),
      mCellOf(surface.texelCount(), 0) {
    std::vector<std::pair<CellKey, Surface::Texel>> sorted;
    sorted.reserve(surface.coveredTexels().size());
    for (const Surface::Texel texel : surface.coveredTexels()) {
        sorted.emplace_back(keyOf(texel), texel);
    }
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [key, texel] : sorted) {
        if (mKeys.empty() || mKeys.back() != key) {
            mKeys.push_back(key);
            mCells.push_back(std::make_unique<Cell>());
            mCells.back()->key = key;
        }
        Cell& cell = *mCells.back();
        cell.texels.push_back(texel);
        cell.centerMm += surface.positionMm(texel);
        cell.normal += surface.normal(texel);
        mCellOf[texel] = static_cast<std::uint32_t>(mCells.size() - 1);
    }
    for (const auto& cell : mCells) {
        cell->centerMm /= static_cast<float>(cell->texels.size());
        cell->normal /= std::max(glm::length(cell->normal), 1e-12f);
    }
}

LocalMean::~LocalMean() = default;

LocalMean::CellKey LocalMean::keyOf(Surface::Texel texel) const {
    const glm::ivec3 cell((mSurface.positionMm(texel) - mSurface.lowMm()) / mCellMm);
    return {cell.x, cell.y, cell.z, sideOf(mSurface.normal(texel))};
}

void LocalMean::findNeighbors(Cell& cell) const {
    // One more than the radius reaches: a cell's center may lie anywhere within it.
    constexpr int kReach = kCellsPerRadius + 1;
    for (int z = -kReach; z <= kReach; ++z) {
        for (int y = -kReach; y <= kReach; ++y) {
            for (int x = -kReach; x <= kReach; ++x) {
                const CellKey low{cell.key.x + x, cell.key.y + y, cell.key.z + z, 0};
                auto key = std::lower_bound(mKeys.begin(), mKeys.end(), low);
                for (; key != mKeys.end() && key->x == low.x && key->y == low.y && key->z == low.z;
                     ++key) {
                    cell.near.push_back(static_cast<std::uint32_t>(key - mKeys.begin()));
                }
            }
        }
    }
}

void LocalMean::measure(Cell& cell) const {
    std::vector<double> sum(mLayout.values(), 0.0);
    for (const Surface::Texel texel : cell.texels) {
        const float* values = mSource.profile(texel);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += static_cast<double>(values[i]);
        }
    }
    cell.mean.resize(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
        cell.mean[i] = static_cast<float>(sum[i] / static_cast<double>(cell.texels.size()));
    }
}

const LocalMean::Cell& LocalMean::prepared(std::uint32_t index) const {
    Cell& cell = *mCells[index];
    std::call_once(cell.measured, [&] { measure(cell); });
    return cell;
}

void LocalMean::evaluate(Surface::Texel texel, float* out) const {
    Cell& own = *mCells[mCellOf[texel]];
    std::call_once(own.found, [&] { findNeighbors(own); });
    const glm::vec3& position = mSurface.positionMm(texel);
    std::fill_n(out, mLayout.values(), 0.0f);
    float total = 0.0f;
    for (const std::uint32_t index : own.near) {
        const Cell& cell = *mCells[index];
        const float facing = glm::dot(cell.normal, mSurface.normal(texel));
        const float t = glm::distance(cell.centerMm, position) / mRadiusMm;
        if (facing <= 0.0f || t >= 1.0f) {
            continue;
        }
        // Zero at the radius, so that nothing jumps from one texel to the next.
        const float weight =
            static_cast<float>(cell.texels.size()) * facing * (1.0f - t * t) * (1.0f - t * t);
        const float* mean = prepared(index).mean.data();
        for (std::size_t i = 0; i < mLayout.values(); ++i) {
            out[i] += weight * mean[i];
        }
        total += weight;
    }
    if (total <= 0.0f) { // bent so much that no cell faces the same way: its own
        std::copy_n(prepared(mCellOf[texel]).mean.data(), mLayout.values(), out);
        return;
    }
    for (std::size_t i = 0; i < mLayout.values(); ++i) {
        out[i] /= total;
    }
}

} // namespace celadon::subedit
