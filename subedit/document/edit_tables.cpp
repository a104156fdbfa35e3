#include "subedit/document/edit_tables.h"

#include "subedit/radius_map.h"

namespace celadon::subedit {

EditTables::EditTables(const MaterialMap& map, double energyFraction, double epsilon)
    : mEnergyFraction(energyFraction), mEpsilon(epsilon) {
    rebuild(map);
}

void EditTables::update(const MaterialMap& map, std::span<const TexelRect> rects) {
    for (const TexelRect& rect : rects) {
        if (!rect.isEmpty()) {
            updateEffectiveRadiusMap(map, rect, mEnergyFraction, mRadius);
            mSums->update(map, mRadius, rect);
            mRangeTable.reset();
        }
    }
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
