#include "renderer/scene/atlas_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace celadon::atlas {
namespace {

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

} // namespace

std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points) {
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) {
        return points;
    }
    // Andrew 1979: lower chain, then upper chain.
    std::vector<Eigen::Vector2d> hull;
    const auto chain = [&](auto begin, auto end) {
        const std::size_t base = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0.0) {
                hull.pop_back();
            }
            hull.push_back(*p);
        }
        hull.pop_back(); // begins the other chain
    };
    chain(points.begin(), points.end());
    chain(points.rbegin(), points.rend());
    return hull;
}

double boxAngle(const std::vector<std::vector<Eigen::Vector2d>>& loops) {
    std::vector<Eigen::Vector2d> points;
    for (const std::vector<Eigen::Vector2d>& loop : loops) {
        points.insert(points.end(), loop.begin(), loop.end());
    }
    const std::vector<Eigen::Vector2d> hull = convexHull(std::move(points));
    // A smallest box has a side along an edge of the hull (Freeman and Shapira 1975).
    double best = std::numeric_limits<double>::infinity();
    double angle = 0.0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Eigen::Vector2d edge = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
        const Eigen::Vector2d normal(-edge.y(), edge.x());
        double lowX = 0.0, highX = 0.0, highY = 0.0;
        for (const Eigen::Vector2d& p : hull) {
            lowX = std::min(lowX, (p - hull[i]).dot(edge));
            highX = std::max(highX, (p - hull[i]).dot(edge));
            highY = std::max(highY, (p - hull[i]).dot(normal));
        }
        const double area = (highX - lowX) * highY;
        if (area < best) {
            best = area;
            const double upright = -std::atan2(edge.y(), edge.x());
            angle = highX - lowX >= highY ? upright : upright + 0.5 * std::numbers::pi;
        }
    }
    return angle;
}

} // namespace celadon::atlas
