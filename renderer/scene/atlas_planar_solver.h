#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

namespace celadon::atlas {

using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A factored symmetric positive definite matrix, solved for both coordinates of a map in one pass
/// over the factor (Eigen's own solve makes a pass for each).
class PlanarSolver {
public:
    /// @param lower its lower triangle
    explicit PlanarSolver(const Eigen::SparseMatrix<double>& lower);

    [[nodiscard]] bool isValid() const { return mIsValid; }
    [[nodiscard]] Coordinates solve(const Coordinates& right) const;

private:
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> mFactor;
    Eigen::VectorXd mInverseDiagonal;
    bool mIsValid = false;
};

} // namespace celadon::atlas
