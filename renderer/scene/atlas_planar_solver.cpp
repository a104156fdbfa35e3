#include "renderer/scene/atlas_planar_solver.h"

namespace celadon::atlas {

PlanarSolver::PlanarSolver(const Eigen::SparseMatrix<double>& lower) {
    mFactor.compute(lower);
    if (mFactor.info() == Eigen::Success && mFactor.vectorD().minCoeff() > 0.0) {
        mInverseDiagonal = mFactor.vectorD().cwiseInverse();
        mIsValid = mInverseDiagonal.allFinite();
    }
}

Coordinates PlanarSolver::solve(const Coordinates& right) const {
    // P A P^T = L D L^T, L with ones on its diagonal that are not stored.
    const Eigen::SparseMatrix<double>& L = mFactor.matrixL().nestedExpression();
    const auto& place = mFactor.permutationP().indices();
    const Eigen::Index count = right.rows();
    Coordinates x(count, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
        x.row(place[i]) = right.row(i);
    }
    const int* begins = L.outerIndexPtr();
    const int* rows = L.innerIndexPtr();
    const double* values = L.valuePtr();
    const auto end = [&](Eigen::Index column) {
        return L.isCompressed() ? begins[column + 1] : begins[column] + L.innerNonZeroPtr()[column];
    };
    for (Eigen::Index j = 0; j < count; ++j) {
        const Eigen::RowVector2d known = x.row(j);
        for (int k = begins[j]; k < end(j); ++k) {
            x.row(rows[k]) -= values[k] * known;
        }
    }
    for (Eigen::Index j = count; j-- > 0;) {
        Eigen::RowVector2d sum = x.row(j) * mInverseDiagonal[j];
        for (int k = begins[j]; k < end(j); ++k) {
            sum -= values[k] * x.row(rows[k]);
        }
        x.row(j) = sum;
    }
    Coordinates result(count, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
        result.row(i) = x.row(place[i]);
    }
    return result;
}

} // namespace celadon::atlas
