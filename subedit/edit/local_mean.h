#pragma once

#include "subedit/edit/profile_source.h"

#include <memory>
#include <mutex>
#include <vector>

/// The mean of ln P around a texel, on its own side of the surface: the base on which heterogeneity
/// is a difference. Texels are gathered in cells of half the radius, once; a mean then weighs the
/// cells around it.
namespace celadon::subedit {

class LocalMean {
public:
    /// @param source must outlive this, and not change
    LocalMean(const Surface& surface, const ProfileLayout& layout, float radiusMm,
              const ProfileSource& source);
    ~LocalMean();

    /// From several threads at once.
    /// @param texel covered
    /// @param out   knots x 3 values
    void evaluate(Surface::Texel texel, float* out) const;

private:
    struct Cell;
    struct CellKey {
        int x, y, z;
        int side; ///< which of the six axis directions the normal is nearest to
        auto operator<=>(const CellKey&) const = default;
    };
    [[nodiscard]] CellKey keyOf(Surface::Texel texel) const;
    [[nodiscard]] const Cell& prepared(std::uint32_t cell) const;
    void findNeighbors(Cell& cell) const;
    void measure(Cell& cell) const;

    const Surface& mSurface;
    ProfileLayout mLayout;
    float mRadiusMm;
    float mCellMm;
    const ProfileSource& mSource;
    std::vector<CellKey> mKeys; ///< ascending
    std::vector<std::unique_ptr<Cell>> mCells;
    std::vector<std::uint32_t> mCellOf; ///< per texel of the map
};

} // namespace celadon::subedit
