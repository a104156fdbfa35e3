#include "renderer/scene/atlas_merge.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace celadon::atlas {
namespace {

constexpr FlattenLimits kMergeLimits{{1.10, 1.25, 2.0}, 4};
/// Least part of the smaller chart's border that the two must share.
constexpr double kLeastShared = 0.10;
/// A union whose border is longer than that of a disk of its area by more than this is no gain: it
/// would be hard to paint on and to pack. Charts that are worse already may get no worse.
constexpr double kMostSpread = 2.0;
/// Bounds the work: triangles tried, relative to all.
constexpr double kEffort = 10.0;

double perimeter(const Chart& chart) {
    double sum = 0.0;
    for (const double length : chart.mesh.loopLengths) {
        sum += length;
    }
    return sum;
}

double spread(double border, double area) {
    return border / std::sqrt(4.0 * std::numbers::pi * area);
}

struct Candidate {
    double score; ///< shared border, relative to the smaller chart's
    int a, b;     ///< chart numbers, a < b
};

class Merger {
public:
    Merger(const Surface& surface, std::vector<Chart>& charts)
        : mSurface(surface), mCharts(charts), mChartOf(surface.triangleCount(), -1) {
        for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
            claim(c);
        }
        mBudget = kEffort * surface.triangleCount();
    }

    void run() {
        while (mBudget > 0.0) {
            const std::vector<Candidate> round = chooseRound();
            if (round.empty()) {
                break;
            }
            std::vector<std::optional<Chart>> unions(round.size());
            tbb::parallel_for(std::size_t{0}, round.size(),
                              [&](std::size_t i) { unions[i] = tryMerge(round[i]); });
            for (std::size_t i = 0; i < round.size(); ++i) {
                const auto [score, a, b] = round[i];
                mBudget -= mCharts[a].mesh.triangleCount() + mCharts[b].mesh.triangleCount();
                if (!unions[i]) {
                    mFailed.insert({a, b});
                    continue;
                }
                // A new number, so that failures remembered for the parts do not bind the union.
                const int merged = static_cast<int>(mCharts.size());
                mCharts[a].mesh = {};
                mCharts[b].mesh = {};
                mCharts.push_back(std::move(*unions[i]));
                claim(merged);
            }
        }
        std::erase_if(mCharts, [](const Chart& chart) { return chart.mesh.triangles.empty(); });
    }

private:
    void claim(int chart) {
        for (const int t : mCharts[chart].mesh.triangles) {
            mChartOf[t] = chart;
        }
    }

    /// Pairs that share no chart with each other, the best first.
    std::vector<Candidate> chooseRound() const {
        std::map<std::pair<int, int>, double> shared;
        for (int c = 0; c < static_cast<int>(mCharts.size()); ++c) {
            const ChartMesh& mesh = mCharts[c].mesh;
            for (std::size_t h = 0; h < mesh.twins.size(); ++h) {
                const int halfEdge = 3 * (mesh.triangles.empty() ? 0 : mesh.triangles[h / 3]) +
                                     static_cast<int>(h % 3);
                const int twin = mesh.twins[h] < 0 ? mSurface.twins[halfEdge] : -1;
                const int other = twin < 0 ? c : mChartOf[twin / 3];
                if (other <= c) {
                    continue;
                }
                const std::array<int, 3>& v = mSurface.triangles[halfEdge / 3];
                shared[{c, other}] +=
                    (mSurface.positions[v[(h + 1) % 3]] - mSurface.positions[v[h % 3]]).norm();
            }
        }
        std::vector<Candidate> candidates;
        for (const auto& [pair, length] : shared) {
            const double borderA = perimeter(mCharts[pair.first]);
            const double borderB = perimeter(mCharts[pair.second]);
            const double score = length / std::min(borderA, borderB);
            if (score < kLeastShared || mFailed.contains(pair) ||
                !staysCompact(pair, borderA, borderB, length)) {
                continue;
            }
            candidates.push_back({score, pair.first, pair.second});
        }
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& x, const Candidate& y) { return x.score > y.score; });
        std::vector<bool> taken(mCharts.size(), false);
        std::erase_if(candidates, [&](const Candidate& candidate) {
            if (taken[candidate.a] || taken[candidate.b]) {
                return true;
            }
            taken[candidate.a] = taken[candidate.b] = true;
            return false;
        });
        return candidates;
    }

    bool staysCompact(std::pair<int, int> pair, double borderA, double borderB,
                      double shared) const {
        const Chart& a = mCharts[pair.first];
        const Chart& b = mCharts[pair.second];
        const double before = std::max(spread(borderA, a.area), spread(borderB, b.area));
        return spread(borderA + borderB - 2.0 * shared, a.area + b.area) <=
               std::max(kMostSpread, before);
    }

    std::optional<Chart> tryMerge(const Candidate& candidate) const {
        const std::vector<int>& a = mCharts[candidate.a].mesh.triangles;
        const std::vector<int>& b = mCharts[candidate.b].mesh.triangles;
        std::vector<int> triangles(a.size() + b.size());
        std::merge(a.begin(), a.end(), b.begin(), b.end(), triangles.begin());
        return flattenChart(mSurface, buildChartMesh(mSurface, std::move(triangles)), kMergeLimits);
    }

    const Surface& mSurface;
    std::vector<Chart>& mCharts;
    std::vector<int> mChartOf; ///< per triangle
    std::set<std::pair<int, int>> mFailed;
    double mBudget = 0.0;
};

} // namespace

void mergeCharts(const Surface& surface, std::vector<Chart>& charts) {
    Merger(surface, charts).run();
}

} // namespace celadon::atlas
