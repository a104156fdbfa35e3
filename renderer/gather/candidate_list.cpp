#include "renderer/gather/candidate_list.h"

#include "subedit/multiversion.h"

namespace celadon {

namespace {

struct Box {
    float low[3], high[3];
};

/// Whether each of the points may lie at a distance from the box that is within its bounds.
CELADON_MULTIVERSION
void within(const Box& box, const float* __restrict x, const float* __restrict y,
            const float* __restrict z, const float* __restrict least, const float* __restrict most,
            int count, std::int32_t* __restrict counts) {
    const float lowX = box.low[0], lowY = box.low[1], lowZ = box.low[2];
    const float highX = box.high[0], highY = box.high[1], highZ = box.high[2];
    const auto larger = [](float a, float b) { return a > b ? a : b; };
    for (int i = 0; i < count; ++i) {
        const float belowX = lowX - x[i], aboveX = x[i] - highX;
        const float belowY = lowY - y[i], aboveY = y[i] - highY;
        const float belowZ = lowZ - z[i], aboveZ = z[i] - highZ;
        const float nearX = larger(larger(belowX, aboveX), 0.0f);
        const float nearY = larger(larger(belowY, aboveY), 0.0f);
        const float nearZ = larger(larger(belowZ, aboveZ), 0.0f);
        const float farX = larger(-belowX, -aboveX);
        const float farY = larger(-belowY, -aboveY);
        const float farZ = larger(-belowZ, -aboveZ);
        const float nearest = nearX * nearX + nearY * nearY + nearZ * nearZ;
        const float farthest = farX * farX + farY * farY + farZ * farZ;
        counts[i] &= (nearest < most[i] ? 1 : 0) & (farthest >= least[i] ? 1 : 0);
    }
}

} // namespace

void CandidateList::Reaches::clear() {
    for (std::vector<float>* values : {&x, &y, &z, &least, &most}) {
        values->clear();
    }
}

void CandidateList::Reaches::add(const Distances& distances) {
    x.push_back(distances.from.x);
    y.push_back(distances.from.y);
    z.push_back(distances.from.z);
    least.push_back(distances.least * distances.least);
    most.push_back(distances.most * distances.most);
}

void CandidateList::clear() {
    mCandidates.clear();
    mOwn.clear();
    mParents.clear();
}

void CandidateList::add(const gather::Candidate& candidate, const Distances& own,
                        const Distances& parents) {
    mCandidates.push_back(candidate);
    mOwn.add(own);
    mParents.add(parents);
}

void CandidateList::choose(const PointBounds& tile, std::vector<gather::Candidate>& chosen) {
    const Box box{{tile.low.x, tile.low.y, tile.low.z}, {tile.high.x, tile.high.y, tile.high.z}};
    mCounts.assign(mCandidates.size(), 1);
    for (const Reaches* reaches : {&mOwn, &mParents}) {
        within(box, reaches->x.data(), reaches->y.data(), reaches->z.data(), reaches->least.data(),
               reaches->most.data(), static_cast<int>(mCounts.size()), mCounts.data());
    }
    chosen.clear();
    for (std::size_t i = 0; i < mCounts.size(); ++i) {
        if (mCounts[i] != 0) {
            chosen.push_back(mCandidates[i]);
        }
    }
}

} // namespace celadon
