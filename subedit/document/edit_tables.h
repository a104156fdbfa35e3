#pragma once

#include "subedit/mean_profile.h"
#include "subedit/range_table.h"

#include <optional>
#include <span>
#include <vector>

/// What the renderer derives from a material, kept up to date while it is edited: R_P of every
/// texel, the mean profile, and the table of minimal effective rendering radii (DESIGN 3.3). An
/// update costs what it touches; the result has the same bits as tables made anew.
namespace celadon::subedit {

class EditTables {
public:
    /// @param epsilon of eq. 14
    explicit EditTables(const MaterialMap& map, double energyFraction = 0.95,
                        double epsilon = 0.01);

    /// Texels in `rects` have changed. The range table follows at the next rangeTable().
    void update(const MaterialMap& map, std::span<const TexelRect> rects);
    /// Everything has changed, size and layout included.
    void rebuild(const MaterialMap& map);

    [[nodiscard]] std::span<const float> effectiveRadiusMm() const { return mRadius; }
    [[nodiscard]] MeanProfile meanProfile() const { return mSums->mean(); }
    /// Made when asked for after a change: some 2 ms, which a painting frame need not always pay.
    [[nodiscard]] const RangeTable& rangeTable();

private:
    double mEnergyFraction;
    double mEpsilon;
    std::vector<float> mRadius;
    std::optional<MeanProfileSums> mSums;
    std::optional<RangeTable> mRangeTable;
};

} // namespace celadon::subedit
