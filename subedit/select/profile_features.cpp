#include "subedit/select/profile_features.h"

#include "subedit/edit/profile_editor.h"
#include "subedit/fast_exp.h"
#include "subedit/stop_point.h"

#include <Eigen/Dense>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace celadon::subedit {

namespace {

constexpr std::size_t kSamples = 2048; ///< texels that the principal components are taken from

/// sqrt(P) at the knots times the root of what each stands for, so that the squared distance of two
/// such vectors is D^2: hat functions over r dr, 1/2 of 2 pi, a third for each channel.
std::vector<float> knotRoots(const ProfileLayout& layout) {
    const float h = layout.spacingMm();
    std::vector<float> roots;
    for (int k = 0; k < layout.knots(); ++k) {
        const float hat =
            k == 0 ? h * h / 6.0f
                   : (k < layout.segments ? static_cast<float>(k) * h * h
                                          : (static_cast<float>(k) / 2.0f - 1.0f / 6.0f) * h * h);
        const float root = std::sqrt(std::numbers::pi_v<float> / 3.0f * hat);
        roots.insert(roots.end(), 3, root);
    }
    return roots;
}

void rootProfile(const float* logProfile, const std::vector<float>& roots, float* out) {
    for (std::size_t i = 0; i < roots.size(); ++i) {
        out[i] = roots[i] * fastExp(0.5f * logProfile[i]);
    }
}

} // namespace

void profileFeatures(const MaterialMap& map, std::span<const Surface::Texel> texels, float scale,
                     float* out, int stride) {
    const ProfileLayout layout = layoutOf(map);
    const std::vector<float> roots = knotRoots(layout);
    const auto values = static_cast<Eigen::Index>(layout.values());

    const std::size_t step = std::max<std::size_t>(texels.size() / kSamples, 1);
    const auto samples = static_cast<Eigen::Index>((texels.size() + step - 1) / step);
    Eigen::MatrixXf sampled(values, samples);
    for (Eigen::Index s = 0; s < samples; ++s) {
        rootProfile(map.logProfile.data() +
                        texels[static_cast<std::size_t>(s) * step] * layout.values(),
                    roots, sampled.col(s).data());
    }
    const Eigen::VectorXf mean = sampled.rowwise().mean();
    sampled.colwise() -= mean;
    const Eigen::MatrixXf covariance = sampled * sampled.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(covariance);
    // Eigenvalues ascend: the last columns matter most. Few knots give fewer directions.
    const Eigen::Index used = std::min<Eigen::Index>(kProfileFeatures, values);
    const Eigen::MatrixXf basis = solver.eigenvectors().rightCols(used).transpose() * scale;
    const Eigen::VectorXf offset = basis * mean;

    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          Eigen::VectorXf root(values);
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              rootProfile(map.logProfile.data() + texels[i] * layout.values(),
                                          roots, root.data());
                              float* row = out + i * static_cast<std::size_t>(stride);
                              std::fill_n(row, kProfileFeatures, 0.0f);
                              Eigen::Map<Eigen::VectorXf>(row, used) = basis * root - offset;
                          }
                      });
    stopPoint();
}

} // namespace celadon::subedit
