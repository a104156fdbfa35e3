#include "renderer/scene/atlas_overlap.h"

#include <algorithm>
#include <cmath>

namespace celadon::atlas {
namespace {

struct Segment {
    int a, b; ///< local vertices
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Which side of the line through p and q; 0 within rounding of it.
int side(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& x) {
    const Eigen::Vector2d u = q - p;
    const Eigen::Vector2d v = x - p;
    const double value = cross(u, v);
    const double rounding = 1e-14 * (std::abs(u.x() * v.y()) + std::abs(u.y() * v.x()));
    return value > rounding ? 1 : value < -rounding ? -1 : 0;
}

bool boxesTouch(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& d) {
    return std::max(a.x(), b.x()) >= std::min(c.x(), d.x()) &&
           std::max(c.x(), d.x()) >= std::min(a.x(), b.x()) &&
           std::max(a.y(), b.y()) >= std::min(c.y(), d.y()) &&
           std::max(c.y(), d.y()) >= std::min(a.y(), b.y());
}

/// Touching counts; neighbors along the border share an end and meet only if one folds back.
bool segmentsMeet(const Planar& uv, const Segment& s, const Segment& t) {
    if (s.b == t.a || s.a == t.b) {
        const Eigen::Vector2d& shared = uv[s.b == t.a ? s.b : s.a];
        const Eigen::Vector2d u = uv[s.b == t.a ? s.a : s.b] - shared;
        const Eigen::Vector2d v = uv[s.b == t.a ? t.b : t.a] - shared;
        return std::abs(cross(u, v)) <= 1e-14 * u.norm() * v.norm() && u.dot(v) > 0.0;
    }
    const Eigen::Vector2d &a = uv[s.a], &b = uv[s.b], &c = uv[t.a], &d = uv[t.b];
    return boxesTouch(a, b, c, d) && side(a, b, c) * side(a, b, d) <= 0 &&
           side(c, d, a) * side(c, d, b) <= 0;
}

/// Each segment listed in the cells of a grid that its box touches.
class SegmentGrid {
public:
    SegmentGrid(const Planar& uv, const std::vector<Segment>& segments) {
        mLow = uv[segments[0].a];
        Eigen::Vector2d high = mLow;
        for (const Segment& s : segments) {
            mLow = mLow.cwiseMin(uv[s.a]);
            high = high.cwiseMax(uv[s.a]);
        }
        const Eigen::Vector2d size = (high - mLow).cwiseMax(1e-300);
        mSide = std::clamp(static_cast<int>(segments.size() / 4), 1, 512);
        mCellsPerUnit = size.cwiseInverse() * static_cast<double>(mSide);
        mCells.resize(static_cast<std::size_t>(mSide) * mSide);
    }

    template<typename Visit>
    void forCells(const Planar& uv, const Segment& s, Visit&& visit) {
        const Eigen::Vector2d a = (uv[s.a] - mLow).cwiseProduct(mCellsPerUnit);
        const Eigen::Vector2d b = (uv[s.b] - mLow).cwiseProduct(mCellsPerUnit);
        const auto cell = [&](double x) { return std::clamp(static_cast<int>(x), 0, mSide - 1); };
        for (int y = cell(std::min(a.y(), b.y())); y <= cell(std::max(a.y(), b.y())); ++y) {
            for (int x = cell(std::min(a.x(), b.x())); x <= cell(std::max(a.x(), b.x())); ++x) {
                visit(mCells[static_cast<std::size_t>(y) * mSide + x]);
            }
        }
    }

private:
    Eigen::Vector2d mLow, mCellsPerUnit;
    int mSide = 1;
    std::vector<std::vector<int>> mCells;
};

bool bordersCross(const ChartMesh& mesh, const Planar& uv) {
    std::vector<Segment> segments;
    for (const std::vector<int>& loop : mesh.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            segments.push_back({loop[i], loop[(i + 1) % loop.size()]});
        }
    }
    SegmentGrid grid(uv, segments);
    bool crossing = false;
    for (int i = 0; i < static_cast<int>(segments.size()) && !crossing; ++i) {
        grid.forCells(uv, segments[i], [&](std::vector<int>& cell) {
            for (const int j : cell) {
                crossing = crossing || (j != i && segmentsMeet(uv, segments[i], segments[j]));
            }
            cell.push_back(i);
        });
    }
    return crossing;
}

double loopArea(const Planar& uv, const std::vector<int>& loop) {
    double doubled = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        doubled += cross(uv[loop[i]] - uv[loop[0]], uv[loop[(i + 1) % loop.size()]] - uv[loop[0]]);
    }
    return 0.5 * doubled;
}

} // namespace

bool overlapsItself(const ChartMesh& mesh, const Planar& uv) {
    if (mesh.triangleCount() == 1) {
        return false;
    }
    // One border runs counterclockwise, around everything; the others clockwise, around holes.
    int outer = 0;
    for (const std::vector<int>& loop : mesh.loops) {
        outer += loopArea(uv, loop) > 0.0 ? 1 : 0;
    }
    return outer != 1 || bordersCross(mesh, uv);
}

} // namespace celadon::atlas
