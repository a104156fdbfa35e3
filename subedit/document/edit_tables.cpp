#include "subedit/document/edit_tables.h"

#include "subedit/radius_map.h"

#include <tbb/parallel_for.h>

namespace celadon::subedit {

EditTables::EditTables(const MaterialMap& map, double energyFraction, double epsilon)
    : mEnergyFraction(energyFraction), mEpsilon(epsilon) {
    rebuild(map);
}

void EditTables::update(const MaterialMap& map, std::span<const TexelRect> rects) {
    if (rects.empty()) {
        return;
    }
    tbb::parallel_for(std::size_t{0}, rects.size(), [&](std::size_t i) {
        updateEffectiveRadiusMap(map, rects[i], mEnergyFraction, mRadius);
    });
    mSums->update(map, mRadius, rects);
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
