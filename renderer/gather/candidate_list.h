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

    /// Distances within which one counts, from least to most.
    struct Distances {
        glm::vec3 from{0.0f};
        float least = 0.0f;
        float most = kEverywhere;
    };

    void clear();
    /// @param own     from the sample
    /// @param parents from its parent, if that matters
    void add(const gather::Candidate& candidate, const Distances& own, const Distances& parents);

    /// Those that may count in a tile, in their order.
    void choose(const PointBounds& tile, std::vector<gather::Candidate>& chosen);

private:
    /// Of all candidates: place, squares of the distances.
    struct Reaches {
        std::vector<float> x, y, z, least, most;
        void clear();
        void add(const Distances& distances);
    };

    std::vector<gather::Candidate> mCandidates;
    Reaches mOwn, mParents;
    std::vector<std::int32_t> mCounts; ///< of all candidates: 1 or 0, for one tile
};

} // namespace celadon
