#pragma once

#include <numeric>
#include <vector>

namespace celadon::atlas {

/// Disjoint sets; the representative is always the smallest member, so that results do not depend
/// on the order of unions.
class UnionFind {
public:
    explicit UnionFind(int count) : mParent(static_cast<std::size_t>(count)) {
        std::iota(mParent.begin(), mParent.end(), 0);
    }

    [[nodiscard]] int find(int i) {
        while (mParent[i] != i) {
            mParent[i] = mParent[mParent[i]];
            i = mParent[i];
        }
        return i;
    }

    void unite(int a, int b) {
        a = find(a);
        b = find(b);
        if (a < b) {
            mParent[b] = a;
        } else {
            mParent[a] = b;
        }
    }

private:
    std::vector<int> mParent;
};

} // namespace celadon::atlas
