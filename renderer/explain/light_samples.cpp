#include "renderer/explain/light_samples.h"

#include <algorithm>
#include <utility>

namespace celadon {

namespace {

class Descent {
public:
    Descent(const SampleTree& tree, bool hierarchical, float distanceMm)
        : mTree(tree), mHierarchical(hierarchical), mDistanceMm(distanceMm) {}

    void visit(std::size_t level, std::size_t index) {
        const TreeNode& node = mTree.levels()[level].nodes[index];
        const bool isUsed = mHierarchical ? node.ball <= mDistanceMm : node.selected;
        if (isUsed || level == 0) {
            const gather::Sample& sample = mTree.levels()[level].samples[index];
            samples.push_back({{node.position[0], node.position[1], node.position[2]},
                               node.extent,
                               static_cast<int>(level),
                               {sample.flux[0], sample.flux[1], sample.flux[2]}});
            return;
        }
        for (std::uint32_t child = node.first; child < node.first + node.children; ++child) {
            visit(level - 1, child);
        }
    }

    std::vector<ShownSample> samples;

private:
    const SampleTree& mTree;
    bool mHierarchical;
    float mDistanceMm;
};

} // namespace

std::vector<ShownSample> samplesAtDistance(const SampleTree& tree, bool hierarchical,
                                           float distanceMm) {
    Descent descent(tree, hierarchical, distanceMm);
    if (!tree.levels().empty()) {
        const std::size_t top = tree.levels().size() - 1;
        for (std::size_t i = 0; i < tree.levels()[top].nodes.size(); ++i) {
            descent.visit(top, i);
        }
    }
    return std::move(descent.samples);
}

std::vector<std::size_t> countPerLevel(const std::vector<ShownSample>& samples) {
    std::vector<std::size_t> counts;
    for (const ShownSample& sample : samples) {
        const auto level = static_cast<std::size_t>(sample.level);
        counts.resize(std::max(counts.size(), level + 1));
        ++counts[level];
    }
    return counts;
}

} // namespace celadon
