#include "subedit/document/edit_tables.h"

#include "subedit/radius_map.h"

namespace celadon::subedit {

EditTables::EditTables(const MaterialMap& map, double energyFraction, double epsilon)
    : mEnergyFraction(energyFraction), mEpsilon(epsilon) {
    rebuild(map);
}

void EditTables::update(const MaterialMap& map, std::span<const TexelRect> rects) {
    if (rects.empty()) {
        return;
    }
    mSums->update(map, mRadius, rects, [&](const TexelRect& tile) {
        for (const TexelRect& rect : rects) {
            const TexelRect both = intersect(tile, rect);
            if (!both.isEmpty()) {
                updateEffectiveRadii(map, both, mEnergyFraction, mRadius);
            }
        }
    });
    mRangeTable.reset();
}

void EditTables::rebuild(const MaterialMap& map) {
    mRadius = effectiveRadiusMap(map, mEnergyFraction);
    mSums.emplace(map, mRadius);
    mRangeTable.reset();
}

const RangeTable& EditTables::rangeTable() {
    if (!mRangeTable) {
        mRangeTable = RangeTable::build(mSums->mean(), mEpsilon);
    }
    return *mRangeTable;
}

} // namespace celadon::subedit
