#include "renderer/gather/tree_change.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

namespace celadon {

namespace {

template<class T>
bool isSame(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Places of profiles follow from the knots, so that they are the same in trees of the same shape.
bool hasSameCodes(const SampleTree& a, const SampleTree& b, const gather::Sample& sample) {
    const std::size_t codes = static_cast<std::size_t>(gather::kKnotCodes) *
                              (static_cast<std::size_t>(sample.knots.segments) + 1);
    return std::memcmp(a.codes().data() + sample.profile, b.codes().data() + sample.profile,
                       codes * sizeof(std::uint16_t)) == 0;
}

} // namespace

TreeChange::TreeChange(const SampleTree& before, const SampleTree& after)
    : mBefore(before), mAfter(after) {
    if (!after.hasShapeOf(before)) {
        mEverything = true;
        return;
    }
    mChanged.resize(after.levels().size());
    if (&before == &after) {
        for (std::size_t level = 0; level < mChanged.size(); ++level) {
            mChanged[level].resize(after.levels()[level].nodes.size(), 0);
        }
        return;
    }
    for (std::size_t level = 0; level < mChanged.size() && !mEverything; ++level) {
        compare(level);
        const auto leaves = static_cast<std::ptrdiff_t>(mChanged[0].size());
        mEverything = level == 0 && 2 * std::ranges::count(mChanged[0], 1) > leaves;
    }
}

void TreeChange::compare(std::size_t level) {
    const SampleTree::Level& a = mBefore.levels()[level];
    const SampleTree::Level& b = mAfter.levels()[level];
    const bool hasSamples = level < static_cast<std::size_t>(mAfter.settings().levels);
    std::vector<std::uint8_t>& changed = mChanged[level];
    changed.resize(b.nodes.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, changed.size(), 512), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const TreeNode& node = b.nodes[i];
                bool isChanged = !isSame(a.nodes[i], node) ||
                                 (hasSamples && (!isSame(a.samples[i], b.samples[i]) ||
                                                 !hasSameCodes(mBefore, mAfter, b.samples[i])));
                for (std::uint32_t j = node.first; level > 0 && j < node.first + node.children;
                     ++j) {
                    isChanged = isChanged || mChanged[level - 1][j] != 0;
                }
                changed[i] = isChanged ? 1 : 0;
                // Children fade in where their parent's ball ends.
                if (level > 0 && a.nodes[i].ball != node.ball) {
                    std::fill_n(mChanged[level - 1].begin() + node.first, node.children, 1);
                }
            }
        });
}

} // namespace celadon
