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

void CandidateList::Reaches::resize(std::size_t count) {
    for (std::vector<float>* values : {&x, &y, &z, &least, &most}) {
        values->resize(count);
    }
}

void CandidateList::Reaches::set(std::size_t i, const float* from, float leastMm, float mostMm) {
    x[i] = from[0];
    y[i] = from[1];
    z[i] = from[2];
    least[i] = leastMm * leastMm;
    most[i] = mostMm * mostMm;
}

void CandidateList::add(const gather::Candidate& candidate, float parentLeast) {
    if (mCount == mCandidates.size()) {
        const std::size_t room = 2 * mCount + 256;
        mCandidates.resize(room);
        mOwn.resize(room);
        mParents.resize(room);
    }
    mCandidates[mCount] = candidate;
    mOwn.set(mCount, candidate.position, candidate.least, candidate.most);
    const bool hasParent = candidate.parentReach > 0.0f;
    mParents.set(mCount, candidate.parent, parentLeast,
                 hasParent ? candidate.parentReach : kEverywhere);
    ++mCount;
}

void CandidateList::choose(const PointBounds& tile, std::vector<gather::Candidate>& chosen) {
    const Box box{{tile.low.x, tile.low.y, tile.low.z}, {tile.high.x, tile.high.y, tile.high.z}};
    mCounts.assign(mCount, 1);
    for (const Reaches* reaches : {&mOwn, &mParents}) {
        within(box, reaches->x.data(), reaches->y.data(), reaches->z.data(), reaches->least.data(),
               reaches->most.data(), static_cast<int>(mCount), mCounts.data());
    }
    chosen.clear();
    for (std::size_t i = 0; i < mCount; ++i) {
        if (mCounts[i] != 0) {
            chosen.push_back(mCandidates[i]);
        }
    }
}

} // namespace celadon
