#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

using Places = Eigen::Matrix<double, Eigen::Dynamic, 3>; ///< a point in each row

/// Where the steps of x <- g(x) lead to, guessed from the last few of them: the combination of them
/// that would have moved least (Anderson 1965; for alternating steps like these Peng et al. 2018,
/// "Anderson acceleration for geometry optimization and physics simulation").
class FixedPointHistory {
public:
    void clear() { mCount = 0; }

    /// @return the next x
    Places next(const Places& x, const Places& g) {
        const Places move = g - x;
        const int used = std::min(mCount, kSteps);
        if (mCount > 0) {
            const int slot = (mCount - 1) % kSteps;
            const auto at = static_cast<std::size_t>(slot);
            mMoveChanges[at] = move - mLastMove;
            mPlaceChanges[at] = g - mLastPlaces;
            for (int i = 0; i < used; ++i) {
                mProducts(slot, i) = mProducts(i, slot) =
                    productOf(mMoveChanges[at], mMoveChanges[static_cast<std::size_t>(i)]);
            }
        }
        mLastMove = move;
        mLastPlaces = g;
        ++mCount;
        if (used == 0) {
            return g;
        }
        Eigen::MatrixXd products = mProducts.topLeftCorner(used, used);
        Eigen::VectorXd right(used);
        for (int i = 0; i < used; ++i) {
            right(i) = productOf(mMoveChanges[static_cast<std::size_t>(i)], move);
        }
        // Steps much alike make the system nearly singular: a little damping keeps its solution
        // small.
        products.diagonal() *= 1.0 + 1e-10;
        const Eigen::VectorXd weight = products.ldlt().solve(right);
        Places result = g;
        for (int i = 0; i < used; ++i) {
            if (!std::isfinite(weight(i))) {
                clear();
                return g;
            }
            result -= weight(i) * mPlaceChanges[static_cast<std::size_t>(i)];
        }
        return result;
    }

private:
    static double productOf(const Places& a, const Places& b) {
        return (a.array() * b.array()).sum();
    }

    static constexpr int kSteps = 6;
    int mCount = 0; ///< of steps seen
    Places mLastMove, mLastPlaces;
    std::array<Places, kSteps> mMoveChanges, mPlaceChanges;
    Eigen::Matrix<double, kSteps, kSteps> mProducts; ///< of the changes of moves
};

} // namespace celadon
