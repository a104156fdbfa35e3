#include "subedit/select/profile_distance.h"

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

ProfileDistance::ProfileDistance(const float* reference, const ProfileLayout& layout)
    : mLayout(layout),
      mEnergy(layout.segments),
      mReference(reference, reference + layout.values()),
      mMean(layout.values()) {
    mEnergy.compute(reference);
    for (int c = 0; c < 3; ++c) {
        mReferenceAlbedo += mEnergy.albedo(c, layout.spacingMm());
    }
}

float ProfileDistance::operator()(const float* logProfile) {
    mEnergy.compute(logProfile);
    float squared = 0.5f * mReferenceAlbedo;
    for (int c = 0; c < 3; ++c) {
        squared += 0.5f * mEnergy.albedo(c, mLayout.spacingMm());
    }
    for (std::size_t i = 0; i < mMean.size(); ++i) {
        mMean[i] = 0.5f * (mReference[i] + logProfile[i]); // ln sqrt(P Q), linear between knots too
    }
    mEnergy.compute(mMean.data());
    for (int c = 0; c < 3; ++c) {
        squared -= mEnergy.albedo(c, mLayout.spacingMm());
    }
    return std::sqrt(std::max(squared / 3.0f, 0.0f));
}

} // namespace celadon::subedit
