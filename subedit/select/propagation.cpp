#include "subedit/select/propagation.h"

#include "subedit/fast_exp.h"
#include "subedit/paint/stroke_mask.h"
#include "subedit/select/profile_features.h"
#include "subedit/select/weight_filter.h"
#include "subedit/stop_point.h"

#include <Eigen/Dense>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <span>

namespace celadon::subedit {

namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t kLandmarks = 64;
constexpr std::size_t kCandidates = 4096;
constexpr std::size_t kBlock = 4096; ///< texels at a time: fixed, so that sums keep their order
/// Landmarks nearer than this (in units of the affinities' widths) say the same twice, and spoil
/// the condition of their matrix.
constexpr float kLeastSeparationSquared = 0.04f;
/// Pull towards 0, in units of the pull of a scribble on what is just like it: a texel at twice the
/// width of the affinity gets a weight of 0.15, at three times 0.001.
constexpr double kPullToZero = 0.1;
/// Weights below are none at all.
constexpr double kLeastWeight = 0.02;

/// What the scribbles say, per covered texel (in the surface's order).
struct Wishes {
    std::vector<float> weight; ///< w: how much is said
    std::vector<float> value;  ///< g: what
    double sum = 0.0;
    std::vector<std::size_t> said; ///< indices where w > 0
};

Wishes collectWishes(const Surface& surface, const Propagation& propagation) {
    const auto texels = surface.coveredTexels();
    Wishes wishes{
        std::vector<float>(texels.size(), 0.0f), std::vector<float>(texels.size(), 0.0f), 0.0, {}};
    std::vector<std::uint32_t> indexOf(surface.texelCount(), 0);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        indexOf[texels[i]] = static_cast<std::uint32_t>(i);
    }
    for (const Scribble& scribble : propagation.scribbles) {
        StrokeMask dabs(surface, scribble.brush, scribble.mirror);
        for (const StrokePoint& point : scribble.path) {
            dabs.add(point);
        }
        for (const Surface::Texel texel : dabs.takeChanged()) {
            const std::uint32_t i = indexOf[texel];
            wishes.weight[i] += dabs.weight(texel);
            wishes.value[i] += dabs.weight(texel) * scribble.strength;
        }
    }
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (wishes.weight[i] > 0.0f) {
            wishes.value[i] /= wishes.weight[i];
            wishes.weight[i] = std::min(wishes.weight[i], 1.0f);
            wishes.sum += static_cast<double>(wishes.weight[i]);
            wishes.said.push_back(i);
        }
    }
    return wishes;
}

/// Farthest-point sampling: half of the landmarks where the scribbles are, the rest anywhere.
std::vector<std::size_t> chooseLandmarks(const Matrix& features,
                                         std::span<const std::size_t> said) {
    const auto count = static_cast<std::size_t>(features.rows());
    std::vector<std::size_t> landmarks;
    std::vector<std::size_t> candidates;
    std::vector<float> nearest;
    const auto take = [&](std::size_t texel) {
        landmarks.push_back(texel);
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            const float d = (features.row(static_cast<Eigen::Index>(candidates[c])) -
                             features.row(static_cast<Eigen::Index>(texel)))
                                .squaredNorm();
            nearest[c] = std::min(nearest[c], d);
        }
    };
    const auto fill = [&](std::size_t most) {
        nearest.assign(candidates.size(), std::numeric_limits<float>::max());
        const std::vector<std::size_t> earlier = std::exchange(landmarks, {});
        for (const std::size_t texel : earlier) {
            take(texel);
        }
        while (landmarks.size() < most) {
            const auto farthest = std::max_element(nearest.begin(), nearest.end());
            if (*farthest < kLeastSeparationSquared) {
                break;
            }
            take(candidates[static_cast<std::size_t>(farthest - nearest.begin())]);
        }
    };
    const std::size_t saidStep = std::max<std::size_t>(said.size() / (kCandidates / 2), 1);
    for (std::size_t i = 0; i < said.size(); i += saidStep) {
        candidates.push_back(said[i]);
    }
    fill(kLandmarks / 2);
    candidates.clear();
    const std::size_t step = std::max<std::size_t>(count / kCandidates, 1);
    for (std::size_t i = 0; i < count; i += step) {
        candidates.push_back(i);
    }
    fill(kLandmarks);
    return landmarks;
}

/// Affinities of a block of texels with the landmarks: a block of U.
Matrix affinities(const Matrix& features, const Matrix& landmarks, std::size_t begin,
                  std::size_t end) {
    const auto rows = static_cast<Eigen::Index>(end - begin);
    const auto block = features.middleRows(static_cast<Eigen::Index>(begin), rows);
    // |a - b|^2 = |a|^2 + |b|^2 - 2 a b
    Matrix u = -2.0f * (block * landmarks.transpose());
    u.colwise() += block.rowwise().squaredNorm();
    u.rowwise() += landmarks.rowwise().squaredNorm().transpose();
    float* value = u.data();
    for (Eigen::Index i = 0; i < u.size(); ++i) {
        value[i] = fastExp(-std::max(value[i], 0.0f));
    }
    return u;
}

template<typename Work>
void forEachBlock(std::size_t count, const Work& work) {
    tbb::parallel_for(std::size_t{0}, (count + kBlock - 1) / kBlock, [&](std::size_t b) {
        work(b, b * kBlock, std::min(count, (b + 1) * kBlock));
    });
    stopPoint();
}

Eigen::Map<const Eigen::VectorXf> slice(const std::vector<float>& values, std::size_t begin,
                                        std::size_t end) {
    return {values.data() + begin, static_cast<Eigen::Index>(end - begin)};
}

/// Weights of the covered texels.
std::vector<float> solve(const Matrix& features, const Wishes& wishes) {
    const auto count = static_cast<std::size_t>(features.rows());
    const std::vector<std::size_t> chosen = chooseLandmarks(features, wishes.said);
    const auto m = static_cast<Eigen::Index>(chosen.size());
    Matrix landmarks(m, features.cols());
    for (Eigen::Index l = 0; l < m; ++l) {
        landmarks.row(l) =
            features.row(static_cast<Eigen::Index>(chosen[static_cast<std::size_t>(l)]));
    }
    Eigen::MatrixXd a = affinities(landmarks, landmarks, 0, chosen.size()).cast<double>();
    a.diagonal().array() += 1e-4;
    const Eigen::LDLT<Eigen::MatrixXd> solveA(a);

    // Z v = U A^-1 U^T v for v = 1, w and w g.
    const std::size_t blocks = (count + kBlock - 1) / kBlock;
    std::vector<Eigen::MatrixXd> products(blocks);
    forEachBlock(count, [&](std::size_t b, std::size_t begin, std::size_t end) {
        const Matrix u = affinities(features, landmarks, begin, end);
        Eigen::MatrixXf v(u.rows(), 3);
        v.col(0).setOnes();
        v.col(1) = slice(wishes.weight, begin, end);
        v.col(2) = v.col(1).cwiseProduct(slice(wishes.value, begin, end));
        products[b] = (u.transpose() * v).cast<double>();
    });
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(m, 3);
    for (const Eigen::MatrixXd& p : products) {
        product += p;
    }
    const Eigen::MatrixXf rowSums = solveA.solve(product).cast<float>();

    // Minimum: (D - 2 lambda Z) e = Z (w g), D = diag(Z w + 2 lambda Z 1 + mu).
    const double lambda = wishes.sum / static_cast<double>(count); // the paper's choice
    double pull = 0.0;
    std::size_t pulls = 0;
    const std::size_t step = std::max<std::size_t>(wishes.said.size() / kCandidates, 1);
    for (std::size_t s = 0; s < wishes.said.size(); s += step, ++pulls) {
        const Matrix u = affinities(features, landmarks, wishes.said[s], wishes.said[s] + 1);
        pull += std::max(static_cast<double>((u * rowSums.col(1))(0)), 0.0);
    }
    pull /= static_cast<double>(pulls);
    const double mu = kPullToZero * pull;

    // Woodbury: e = D^-1 b + 2 lambda D^-1 U (A - 2 lambda U^T D^-1 U)^-1 U^T D^-1 b.
    std::vector<float> diagonal(count);
    std::vector<float> right(count);
    std::vector<Eigen::MatrixXd> grams(blocks);
    forEachBlock(count, [&](std::size_t b, std::size_t begin, std::size_t end) {
        const Matrix u = affinities(features, landmarks, begin, end);
        const Eigen::MatrixXf z = u * rowSums;
        Matrix scaled(u.rows(), m + 1);
        for (Eigen::Index i = 0; i < u.rows(); ++i) {
            const std::size_t texel = begin + static_cast<std::size_t>(i);
            const float d = std::max(z(i, 1), 0.0f) +
                            2.0f * static_cast<float>(lambda) * std::max(z(i, 0), 0.0f) +
                            static_cast<float>(mu);
            diagonal[texel] = d;
            right[texel] = z(i, 2);
            scaled.row(i).head(m) = u.row(i) / d;
            scaled(i, m) = z(i, 2) / d;
        }
        grams[b] = (u.transpose() * scaled).cast<double>();
    });
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(m, m + 1);
    for (const Eigen::MatrixXd& g : grams) {
        gram += g;
    }
    const Eigen::MatrixXd inner = a - 2.0 * lambda * gram.leftCols(m);
    const Eigen::VectorXf correction =
        (2.0 * lambda * Eigen::PartialPivLU<Eigen::MatrixXd>(inner).solve(gram.col(m)))
            .cast<float>();

    std::vector<float> weights(count);
    forEachBlock(count, [&](std::size_t, std::size_t begin, std::size_t end) {
        const Matrix u = affinities(features, landmarks, begin, end);
        const Eigen::VectorXf far = u * correction;
        for (std::size_t texel = begin; texel < end; ++texel) {
            const double e =
                static_cast<double>(right[texel] + far(static_cast<Eigen::Index>(texel - begin))) /
                static_cast<double>(diagonal[texel]) * (1.0 + kPullToZero);
            weights[texel] =
                static_cast<float>(std::clamp((e - kLeastWeight) / (1.0 - kLeastWeight), 0.0, 1.0));
        }
    });
    return weights;
}

} // namespace

WeightMask propagate(const MaterialMap& map, const Surface& surface,
                     const Propagation& propagation) {
    WeightMask mask(map.width, map.height);
    const Wishes wishes = collectWishes(surface, propagation);
    if (wishes.said.empty()) {
        return mask;
    }
    const auto texels = surface.coveredTexels();
    const int profileDimensions = kProfileFeatures;
    const int dimensions = profileDimensions + (propagation.distanceMm ? 3 : 0);
    Matrix features(static_cast<Eigen::Index>(texels.size()), dimensions);
    profileFeatures(map, texels, 1.0f / propagation.similarity, features.data(), dimensions);
    if (propagation.distanceMm) {
        for (std::size_t i = 0; i < texels.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                features(static_cast<Eigen::Index>(i), profileDimensions + axis) =
                    (surface.positionMm(texels[i])[axis] - surface.lowMm()[axis]) /
                    *propagation.distanceMm;
            }
        }
    }
    const std::vector<float> weights = solve(features, wishes);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        mask.set(std::size_t{texels[i]}, weightFromFloat(weights[i]));
    }
    repeatInGutters(surface, mask);
    return mask;
}

} // namespace celadon::subedit
