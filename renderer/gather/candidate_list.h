#pragma once

#include "renderer/gather/pair_kernel.h"
#include "renderer/scene/point_bounds.h"

#include <cstdint>
#include <vector>

namespace celadon {

/// Samples that may count somewhere, and at what distances: a tile chooses those that may count in
/// it, eight at a time.
class CandidateList {
public:
    static constexpr float kEverywhere = 1e18f; ///< a distance beyond all, mm; its square is finite

    void clear() { mCount = 0; }
    /// @param parentLeast  it matters only where some of a tile is that far from its parent
    void add(const gather::Candidate& candidate, float parentLeast);

    /// Those that may count in a tile, in their order.
    void choose(const PointBounds& tile, std::vector<gather::Candidate>& chosen);

private:
    /// Of all candidates: from where, and squares of the distances.
    struct Reaches {
        std::vector<float> x, y, z, least, most;
        void resize(std::size_t count);
        void set(std::size_t i, const float* from, float leastMm, float mostMm);
    };

    std::size_t mCount = 0; ///< of what there is room for
    std::vector<gather::Candidate> mCandidates;
    Reaches mOwn, mParents;
    std::vector<std::int32_t> mCounts; ///< of all candidates: 1 or 0, for one tile
};

} // namespace celadon
