#include "renderer/scene/rigid_solver.h"

#include "renderer/scene/fixed_point_history.h"
#include "subedit/assert.h"

#include <Eigen/SparseCholesky>
#include <glm/gtc/quaternion.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace celadon {

namespace {

constexpr int kFree = -1;
/// Cotangents of obtuse angles are negative, and would let a point run away from its neighbors.
constexpr double kLeastWeight = 0.05;
constexpr double kGreatestWeight = 20.0; // of slivers

/// Half the sum of the cotangents of the angles that face each edge, in the order of neighbors.
std::vector<double> cotangentWeights(const SurfaceGraph& graph) {
    std::vector<double> weights(graph.neighbors.size(), 0.0);
    const auto add = [&](std::uint32_t a, std::uint32_t b, double weight) {
        const auto row = graph.neighborsOf(a);
        const auto found = std::lower_bound(row.begin(), row.end(), b);
        weights[graph.starts[a] + static_cast<std::size_t>(found - row.begin())] += weight;
    };
    for (const Triangle& t : graph.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 u = graph.points[t[(k + 1) % 3]] - graph.points[t[k]];
            const glm::dvec3 v = graph.points[t[(k + 2) % 3]] - graph.points[t[k]];
            const double area2 = glm::length(glm::cross(u, v));
            const double cotangent = area2 > 0.0 ? glm::dot(u, v) / area2 : 0.0;
            add(t[(k + 1) % 3], t[(k + 2) % 3], 0.5 * cotangent);
            add(t[(k + 2) % 3], t[(k + 1) % 3], 0.5 * cotangent);
        }
    }
    for (double& weight : weights) {
        weight = std::clamp(weight, kLeastWeight, kGreatestWeight);
    }
    return weights;
}

/// The rotation next to a matrix, from one that is near (Mueller, Bender, Chentanez, Macklin 2016,
/// "A robust method to extract the rotational part of deformations").
glm::dmat3 rotationOf(const glm::dmat3& matrix, const glm::dmat3& guess) {
    constexpr int kMostSteps = 30;
    constexpr double kSmallestTurn = 1e-6; // radians; the next would be about its square
    double size = 0.0;
    for (int c = 0; c < 3; ++c) {
        size += glm::dot(matrix[c], matrix[c]);
    }
    size = std::sqrt(size);
    if (!(size > 0.0)) {
        return guess;
    }
    glm::dquat q = glm::quat_cast(guess);
    for (int step = 0; step < kMostSteps; ++step) {
        const glm::dmat3 R = glm::mat3_cast(q);
        glm::dvec3 axis(0.0);
        double along = 0.0;
        for (int c = 0; c < 3; ++c) {
            axis += glm::cross(R[c], matrix[c]);
            along += glm::dot(R[c], matrix[c]);
        }
        const glm::dvec3 omega = axis / (std::abs(along) + 1e-9 * size);
        // By 2 arctan(|omega| / 2): as far as the angle, but for the large ones, that are guesses.
        q = glm::normalize(glm::dquat(1.0, 0.5 * omega) * q);
        if (!(glm::dot(omega, omega) > kSmallestTurn * kSmallestTurn)) {
            break;
        }
    }
    return glm::mat3_cast(q);
}

/// The sum of the normals of the triangles around each point, as long as twice their areas.
std::vector<glm::dvec3> pointNormals(const SurfaceGraph& graph,
                                     const std::vector<glm::dvec3>& positions) {
    std::vector<glm::dvec3> normals(positions.size(), glm::dvec3(0.0));
    for (const Triangle& t : graph.triangles) {
        const glm::dvec3 n =
            glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
        for (const std::uint32_t i : t) {
            normals[i] += n;
        }
    }
    return normals;
}

/// The longest of some ways.
double farthestOf(const Places& ways) {
    return ways.rows() == 0 ? 0.0 : std::sqrt(ways.rowwise().squaredNorm().maxCoeff());
}

} // namespace

struct RigidSolver::State {
    const SurfaceGraph& graph;
    std::vector<std::uint32_t> held;
    std::vector<double> weights;
    std::vector<int> unknown; ///< of each point its row in the system, or kFree - where it is held
    std::vector<std::uint32_t> freePoints;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
    std::vector<glm::dvec3> positions;
    std::vector<glm::dmat3> rotations;
    std::vector<double> energies; ///< of the last local step, by point

    State(const SurfaceGraph& graph_, std::vector<std::uint32_t> held_)
        : graph(graph_), held(std::move(held_)), weights(cotangentWeights(graph_)) {
        unknown.assign(graph.points.size(), 0);
        for (const std::uint32_t point : held) {
            unknown[point] = kFree;
        }
        for (std::uint32_t i = 0; i < unknown.size(); ++i) {
            if (unknown[i] != kFree) {
                unknown[i] = static_cast<int>(freePoints.size());
                freePoints.push_back(i);
            }
        }
        std::vector<Eigen::Triplet<double>> entries;
        for (const std::uint32_t i : freePoints) {
            double diagonal = 0.0;
            for (std::size_t e = graph.starts[i]; e < graph.starts[i + 1]; ++e) {
                diagonal += weights[e];
                const int j = unknown[graph.neighbors[e]];
                if (j != kFree) {
                    entries.emplace_back(unknown[i], j, -weights[e]);
                }
            }
            entries.emplace_back(unknown[i], unknown[i], diagonal);
        }
        const auto size = static_cast<Eigen::Index>(freePoints.size());
        Eigen::SparseMatrix<double> system(size, size);
        system.setFromTriplets(entries.begin(), entries.end());
        if (size > 0) {
            factor.compute(system);
            CELADON_ASSERT(factor.info() == Eigen::Success); // diagonally dominant
        }
        positions = graph.points;
        rotations.assign(graph.points.size(), glm::dmat3(1.0));
    }

    template<typename Work>
    static void forEach(std::size_t count, const Work& work) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                  work(i);
                              }
                          });
    }

    /// Quaternions that are the mean of their neighbors', weighted as edges are, at free points.
    void spreadTurns() {
        const auto size = static_cast<Eigen::Index>(freePoints.size());
        if (size == 0 || held.empty()) {
            return;
        }
        const glm::dquat first = glm::quat_cast(rotations[held[0]]);
        Eigen::Matrix<double, Eigen::Dynamic, 4> right(size, 4);
        right.setZero();
        for (std::size_t f = 0; f < freePoints.size(); ++f) {
            const std::size_t i = freePoints[f];
            for (std::size_t e = graph.starts[i]; e < graph.starts[i + 1]; ++e) {
                const std::size_t j = graph.neighbors[e];
                if (unknown[j] == kFree) {
                    const glm::dquat q = glm::quat_cast(rotations[j]);
                    const double weight = weights[e] * (glm::dot(q, first) < 0.0 ? -1.0 : 1.0);
                    right.row(static_cast<Eigen::Index>(f)) +=
                        weight * Eigen::RowVector4d(q.w, q.x, q.y, q.z);
                }
            }
        }
        const Eigen::Matrix<double, Eigen::Dynamic, 4> turns = factor.solve(right);
        for (std::size_t f = 0; f < freePoints.size(); ++f) {
            const auto row = turns.row(static_cast<Eigen::Index>(f));
            const glm::dquat q(row(0), row(1), row(2), row(3));
            const double length = glm::length(q);
            rotations[freePoints[f]] = length > 0.0 ? glm::mat3_cast(q / length) : glm::dmat3(1.0);
        }
    }

    /// Of the edges around a point: sum w e' e^T, and sum w (e'^2 + e^2).
    struct Edges {
        glm::dmat3 covariance{0.0};
        double squares = 0.0;
        /// The energy of eq. 3 with a rotation: sum w (e' - R e)^2.
        double energy(const glm::dmat3& R) const {
            double along = 0.0;
            for (int c = 0; c < 3; ++c) {
                along += glm::dot(R[c], covariance[c]);
            }
            return squares - 2.0 * along;
        }
    };

    Edges edgesOf(std::size_t i) const {
        Edges edges;
        for (std::size_t e = graph.starts[i]; e < graph.starts[i + 1]; ++e) {
            const std::size_t j = graph.neighbors[e];
            const glm::dvec3 moved = positions[j] - positions[i];
            const glm::dvec3 rest = graph.points[j] - graph.points[i];
            edges.covariance += glm::outerProduct(weights[e] * moved, rest);
            edges.squares += weights[e] * (glm::dot(moved, moved) + glm::dot(rest, rest));
        }
        return edges;
    }

    double energy() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            sum += edgesOf(i).energy(rotations[i]);
        }
        return sum;
    }

    /// The rotation of each free point that fits its edges best (eq. 5).
    /// @return the energy with them
    double localStep() {
        energies.resize(positions.size());
        forEach(positions.size(), [&](std::size_t i) {
            const Edges edges = edgesOf(i);
            if (unknown[i] != kFree) {
                rotations[i] = rotationOf(edges.covariance, rotations[i]);
            }
            energies[i] = edges.energy(rotations[i]);
        });
        double sum = 0.0;
        for (const double one : energies) {
            sum += one;
        }
        return sum;
    }

    /// The positions of the free points that fit the rotations best (eqs. 8, 9).
    Places globalStep() const {
        const auto size = static_cast<Eigen::Index>(freePoints.size());
        Places right(size, 3);
        forEach(freePoints.size(), [&](std::size_t f) {
            const std::size_t i = freePoints[f];
            glm::dvec3 sum(0.0);
            for (std::size_t e = graph.starts[i]; e < graph.starts[i + 1]; ++e) {
                const std::size_t j = graph.neighbors[e];
                sum += 0.5 * weights[e] *
                       ((rotations[i] + rotations[j]) * (graph.points[i] - graph.points[j]));
                if (unknown[j] == kFree) {
                    sum += weights[e] * positions[j];
                }
            }
            for (int c = 0; c < 3; ++c) {
                right(static_cast<Eigen::Index>(f), c) = sum[c];
            }
        });
        if (size > 0) {
            tbb::parallel_for(0, 3,
                              [&](int c) { right.col(c) = factor.solve(right.col(c)).eval(); });
        }
        return right;
    }

    Places freePlaces() const {
        Places places(static_cast<Eigen::Index>(freePoints.size()), 3);
        for (std::size_t f = 0; f < freePoints.size(); ++f) {
            for (int c = 0; c < 3; ++c) {
                places(static_cast<Eigen::Index>(f), c) = positions[freePoints[f]][c];
            }
        }
        return places;
    }

    void place(const Places& places) {
        for (std::size_t f = 0; f < freePoints.size(); ++f) {
            const auto row = places.row(static_cast<Eigen::Index>(f));
            positions[freePoints[f]] = {row(0), row(1), row(2)};
        }
    }
};

RigidSolver::RigidSolver(const SurfaceGraph& graph, std::vector<std::uint32_t> held)
    : mState(std::make_unique<State>(graph, std::move(held))) {}
RigidSolver::~RigidSolver() = default;
RigidSolver::RigidSolver(RigidSolver&&) noexcept = default;
RigidSolver& RigidSolver::operator=(RigidSolver&&) noexcept = default;

void RigidSolver::start(std::span<const MovedNode> guess) {
    CELADON_ASSERT(guess.size() == mState->positions.size());
    for (std::size_t i = 0; i < guess.size(); ++i) {
        mState->positions[i] = guess[i].to;
        mState->rotations[i] = rotationOf(guess[i].linear, glm::dmat3(1.0));
    }
}

void RigidSolver::startFromHeld() {
    mState->spreadTurns();
    mState->place(mState->globalStep());
}

void RigidSolver::setTargets(std::span<const HeldPoint> targets) {
    CELADON_ASSERT(targets.size() == mState->held.size());
    for (std::size_t k = 0; k < targets.size(); ++k) {
        mState->positions[mState->held[k]] = targets[k].to;
        mState->rotations[mState->held[k]] = targets[k].turn;
    }
}

double RigidSolver::iterate() {
    const Places before = mState->freePlaces();
    mState->localStep();
    const Places after = mState->globalStep();
    mState->place(after);
    return farthestOf(after - before);
}

int RigidSolver::settle(double still, int mostIterations) {
    State& s = *mState;
    FixedPointHistory history;
    Places given = s.freePlaces();
    Places fallback = given; // what the last step alone would have made
    double lowest = std::numeric_limits<double>::infinity();
    for (int iteration = 1;; ++iteration) {
        double energy = s.localStep();
        if (energy > lowest) { // the guess went too far
            given = fallback;
            s.place(given);
            energy = s.localStep();
            history.clear();
        }
        lowest = energy;
        fallback = s.globalStep();
        if (iteration == mostIterations || farthestOf(fallback - given) <= still) {
            s.place(fallback);
            return iteration;
        }
        given = history.next(given, fallback);
        s.place(given);
    }
}

double RigidSolver::energy() const {
    return mState->energy();
}

std::span<const glm::dvec3> RigidSolver::positions() const {
    return mState->positions;
}

std::span<const glm::dmat3> RigidSolver::rotations() const {
    return mState->rotations;
}

std::vector<MovedNode> RigidSolver::nodes() const {
    const SurfaceGraph& graph = mState->graph;
    const std::vector<glm::dvec3> before = pointNormals(graph, graph.points);
    const std::vector<glm::dvec3> after = pointNormals(graph, mState->positions);
    std::vector<MovedNode> result(graph.points.size());
    State::forEach(result.size(), [&](std::size_t i) {
        result[i] = {mState->positions[i], mState->rotations[i]};
        // The linear map that takes the edges nearest to where they went, and the normal to that
        // of the surface there: F = (sum e' e^T) (sum e e^T)^-1.
        glm::dmat3 moved(0.0);
        glm::dmat3 rest(0.0);
        double size = 0.0;
        for (const std::uint32_t j : graph.neighborsOf(i)) {
            const glm::dvec3 e = graph.points[j] - graph.points[i];
            moved += glm::outerProduct(mState->positions[j] - mState->positions[i], e);
            rest += glm::outerProduct(e, e);
            size += 0.5 * glm::dot(e, e);
        }
        const double lengths = glm::length(before[i]) * glm::length(after[i]);
        if (!(lengths > 0.0)) {
            return;
        }
        const glm::dvec3 n = glm::normalize(before[i]);
        moved += size * glm::outerProduct(glm::normalize(after[i]), n);
        rest += size * glm::outerProduct(n, n);
        constexpr double kFlat = 1e-6; // edges that lie on a line say nothing across it
        if (glm::determinant(rest) > kFlat * size * size * size) {
            result[i].linear = moved * glm::inverse(rest);
        }
    });
    return result;
}

} // namespace celadon
