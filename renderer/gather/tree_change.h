#pragma once

#include "renderer/gather/sample_tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// What differs between two trees, so that pixels that none of it reaches keep their sums. No GL
/// here.
namespace celadon {

class TreeChange {
public:
    /// Compares two trees of hierarchical samples, which may be one. Both outlive this.
    TreeChange(const SampleTree& before, const SampleTree& after);

    /// The trees stand for different texels, or for texels most of which changed: gathering all is
    /// as quick as finding out what to keep.
    [[nodiscard]] bool isEverything() const { return mEverything; }
    /// Whether a node, or one below it, brings something else or brings it at other distances: also
    /// where only its parent's ball is another one.
    [[nodiscard]] bool at(std::size_t level, std::size_t index) const {
        return mChanged[level][index] != 0;
    }
    [[nodiscard]] const SampleTree& before() const { return mBefore; }
    [[nodiscard]] const SampleTree& after() const { return mAfter; }

private:
    void compare(std::size_t level);

    const SampleTree& mBefore;
    const SampleTree& mAfter;
    std::vector<std::vector<std::uint8_t>> mChanged; ///< [level][node]
    bool mEverything = false;
};

} // namespace celadon
