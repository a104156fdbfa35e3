#include "renderer/scene/load_triangulate.h"

#include "subedit/assert.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::loaders {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

glm::dvec3 newellNormal(std::span<const glm::vec3> corners) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    }
    return sum;
}

void splitQuad(std::span<const glm::vec3> corners, Triangles& triangles) {
    const auto normalOf = [&](int a, int b, int c) {
        return glm::cross(glm::dvec3(corners[b]) - glm::dvec3(corners[a]),
                          glm::dvec3(corners[c]) - glm::dvec3(corners[a]));
    };
    // A diagonal lies inside when the two triangles that it makes face the same way.
    const bool inside02 = glm::dot(normalOf(0, 1, 2), normalOf(0, 2, 3)) > 0.0;
    const bool inside13 = glm::dot(normalOf(0, 1, 3), normalOf(1, 2, 3)) > 0.0;
    const double length02 = glm::distance(glm::dvec3(corners[0]), glm::dvec3(corners[2]));
    const double length13 = glm::distance(glm::dvec3(corners[1]), glm::dvec3(corners[3]));
    if (inside02 != inside13 ? inside02 : length02 <= length13) {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    } else {
        triangles.push_back({0, 1, 3});
        triangles.push_back({1, 2, 3});
    }
}

/// Clips the ears of a polygon in the plane. Removing an ear changes only its two neighbors, so a
/// list of candidates needs each corner a bounded number of times: O(corners * reflex corners).
class EarClipper {
public:
    explicit EarClipper(std::vector<glm::dvec2> points) : mPoints(std::move(points)) {
        const auto count = static_cast<std::uint32_t>(mPoints.size());
        mNext.resize(count);
        mPrevious.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            mNext[i] = (i + 1) % count;
            mPrevious[i] = (i + count - 1) % count;
        }
        mAlive.assign(count, true);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (turn(mPrevious[i], i, mNext[i]) <= 0.0) {
                mReflex.push_back(i);
            }
        }
    }

    /// No corner turns inwards; straight ones may be among them.
    [[nodiscard]] bool isConvex() const {
        return std::none_of(mReflex.begin(), mReflex.end(),
                            [&](std::uint32_t i) { return turn(mPrevious[i], i, mNext[i]) < 0.0; });
    }

    [[nodiscard]] bool isStrictlyConvex() const { return mReflex.empty(); }

    void clip(Triangles& triangles) {
        std::vector<std::uint32_t> candidates;
        for (std::uint32_t i = static_cast<std::uint32_t>(mPoints.size()); i-- > 0;) {
            candidates.push_back(i);
        }
        std::size_t left = mPoints.size();
        std::uint32_t some = 0;
        while (left > 3) {
            std::uint32_t ear = 0;
            if (candidates.empty()) {
                ear = some; // crosses itself, or is flat: any corner is as good
            } else {
                ear = candidates.back();
                candidates.pop_back();
                if (!mAlive[ear] || !isEar(ear)) {
                    continue;
                }
            }
            const std::uint32_t before = mPrevious[ear];
            const std::uint32_t after = mNext[ear];
            triangles.push_back({before, ear, after});
            mAlive[ear] = false;
            mNext[before] = after;
            mPrevious[after] = before;
            some = after;
            --left;
            candidates.push_back(before);
            candidates.push_back(after);
        }
        triangles.push_back({mPrevious[some], some, mNext[some]});
    }

private:
    std::vector<glm::dvec2> mPoints;
    std::vector<std::uint32_t> mNext, mPrevious, mReflex;
    std::vector<bool> mAlive;

    [[nodiscard]] double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const glm::dvec2 u = mPoints[b] - mPoints[a];
        const glm::dvec2 v = mPoints[c] - mPoints[a];
        return u.x * v.y - u.y * v.x;
    }

    [[nodiscard]] bool isEar(std::uint32_t corner) {
        const std::uint32_t before = mPrevious[corner];
        const std::uint32_t after = mNext[corner];
        if (turn(before, corner, after) <= 0.0) {
            return false;
        }
        // Only reflex corners can lie in the triangle first; those that became convex stay convex.
        std::erase_if(mReflex, [&](std::uint32_t i) {
            return !mAlive[i] || turn(mPrevious[i], i, mNext[i]) > 0.0;
        });
        for (const std::uint32_t i : mReflex) {
            const bool isCorner = i == before || i == corner || i == after;
            const bool touches = mPoints[i] == mPoints[before] || mPoints[i] == mPoints[corner] ||
                                 mPoints[i] == mPoints[after];
            if (!isCorner && !touches && turn(before, corner, i) >= 0.0 &&
                turn(corner, after, i) >= 0.0 && turn(after, before, i) >= 0.0) {
                return false;
            }
        }
        return true;
    }
};

std::vector<glm::dvec2> project(std::span<const glm::vec3> corners, const glm::dvec3& normal) {
    // Drop the axis along which the polygon is seen largest, keeping its winding.
    const glm::dvec3 size = glm::abs(normal);
    int u = 0;
    int v = 1;
    double sign = normal.z;
    if (size.x >= size.y && size.x >= size.z) {
        u = 1;
        v = 2;
        sign = normal.x;
    } else if (size.y >= size.z) {
        u = 2;
        v = 0;
        sign = normal.y;
    }
    if (sign < 0.0) {
        std::swap(u, v);
    }
    std::vector<glm::dvec2> points;
    points.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        points.emplace_back(corner[u], corner[v]);
    }
    return points;
}

} // namespace

bool triangulate(std::span<const glm::vec3> corners, Triangles& triangles) {
    CELADON_ASSERT(corners.size() >= 3);
    if (corners.size() == 3) {
        triangles.push_back({0, 1, 2});
        return true;
    }
    if (corners.size() == 4) {
        splitQuad(corners, triangles);
        return true;
    }
    EarClipper clipper(project(corners, newellNormal(corners)));
    const bool tooMany = corners.size() > kMaxConcaveCorners;
    if (clipper.isStrictlyConvex() || (tooMany && clipper.isConvex())) {
        for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) {
            triangles.push_back({0, i, i + 1});
        }
        return true;
    }
    if (tooMany) {
        return false;
    }
    clipper.clip(triangles);
    return true;
}

} // namespace celadon::loaders
