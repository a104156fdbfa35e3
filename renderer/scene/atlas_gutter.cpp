#include "renderer/scene/atlas_gutter.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace celadon {
namespace {

/// Bounds the work that coordinates stretched over millions of repeats can ask for.
constexpr double kMostTestsPerTexel = 512.0;

int repeated(std::int64_t i, int size) {
    return static_cast<int>(((i % size) + size) % size);
}

class Coverage {
public:
    Coverage(int width, int height)
        : mWidth(width),
          mHeight(height),
          mSource(static_cast<std::size_t>(width) * height, -1),
          mTestsLeft(kMostTestsPerTexel * width * height) {}

    void addTriangle(const glm::vec2& u0, const glm::vec2& u1, const glm::vec2& u2) {
        const glm::dvec2 size(mWidth, mHeight);
        // Into the first repeat, in texels with centers at integers.
        const glm::dvec2 tile =
            glm::floor(glm::min(glm::min(glm::dvec2(u0), glm::dvec2(u1)), glm::dvec2(u2)));
        glm::dvec2 p[3] = {glm::dvec2(u0), glm::dvec2(u1), glm::dvec2(u2)};
        for (glm::dvec2& q : p) {
            q = (q - tile) * size - 0.5;
            if (!std::isfinite(q.x) || !std::isfinite(q.y)) {
                return;
            }
        }
        bool any = false;
        const glm::dvec2 low = glm::ceil(glm::min(glm::min(p[0], p[1]), p[2]));
        const glm::dvec2 high = glm::floor(glm::max(glm::max(p[0], p[1]), p[2]));
        const double area = cross(p[1] - p[0], p[2] - p[0]);
        const double tests = (high.x - low.x + 1.0) * (high.y - low.y + 1.0);
        if (area != 0.0 && tests <= mTestsLeft) {
            mTestsLeft -= tests;
            for (auto y = static_cast<std::int64_t>(low.y); y <= static_cast<std::int64_t>(high.y);
                 ++y) {
                for (auto x = static_cast<std::int64_t>(low.x);
                     x <= static_cast<std::int64_t>(high.x); ++x) {
                    const glm::dvec2 q(x, y);
                    if (cross(p[1] - p[0], q - p[0]) * area >= 0.0 &&
                        cross(p[2] - p[1], q - p[1]) * area >= 0.0 &&
                        cross(p[0] - p[2], q - p[2]) * area >= 0.0) {
                        cover(x, y);
                        any = true;
                    }
                }
            }
        }
        if (!any) {
            const glm::dvec2 middle = glm::floor((p[0] + p[1] + p[2]) / 3.0 + 0.5);
            if (std::abs(middle.x) < 1e15 && std::abs(middle.y) < 1e15) {
                // A coordinate of exactly 1 belongs to the last texel, not to the next repeat.
                cover(middle.x == mWidth ? mWidth - 1 : static_cast<std::int64_t>(middle.x),
                      middle.y == mHeight ? mHeight - 1 : static_cast<std::int64_t>(middle.y));
            }
        }
    }

    std::vector<int> takeSource() { return std::move(mSource); }

private:
    static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

    void cover(std::int64_t x, std::int64_t y) {
        const int index = repeated(y, mHeight) * mWidth + repeated(x, mWidth);
        mSource[index] = index;
    }

    int mWidth, mHeight;
    std::vector<int> mSource;
    double mTestsLeft;
};

/// The nearest covered texel of each row, then of all rows within the radius: exact, since rows and
/// columns separate (Felzenszwalb and Huttenlocher 2012 do the second pass in linear time; within a
/// small radius a plain search is as quick).
void spread(std::vector<int>& source, int width, int height, int radius) {
    std::vector<int> nearestInRow(source.size(), -1);
    for (int y = 0; y < height; ++y) {
        const int row = y * width;
        for (int x = 0, last = -1; x < width; ++x) {
            last = source[row + x] >= 0 ? x : last;
            nearestInRow[row + x] = last;
        }
        for (int x = width - 1, last = -1; x >= 0; --x) {
            last = source[row + x] >= 0 ? x : last;
            int& nearest = nearestInRow[row + x];
            if (last >= 0 && (nearest < 0 || last - x < x - nearest)) {
                nearest = last;
            }
        }
    }
    std::vector<int> spreadSource = source;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (source[y * width + x] >= 0) {
                continue;
            }
            std::int64_t best = static_cast<std::int64_t>(radius) * radius;
            int& found = spreadSource[y * width + x];
            for (int row = std::max(0, y - radius); row <= std::min(height - 1, y + radius);
                 ++row) {
                const int nearest = nearestInRow[row * width + x];
                if (nearest < 0) {
                    continue;
                }
                const std::int64_t dx = nearest - x;
                const std::int64_t dy = row - y;
                const std::int64_t distance = dx * dx + dy * dy;
                if (distance < best || (distance == best && found < 0)) {
                    best = distance;
                    found = row * width + nearest;
                }
            }
        }
    }
    source = std::move(spreadSource);
}

} // namespace

std::vector<int> dilationSource(std::span<const Mesh* const> meshes, int width, int height,
                                int radiusTexels) {
    Coverage coverage(width, height);
    for (const Mesh* mesh : meshes) {
        if (mesh->uvs.empty()) {
            continue;
        }
        for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
            coverage.addTriangle(mesh->uvs[mesh->indices[i]], mesh->uvs[mesh->indices[i + 1]],
                                 mesh->uvs[mesh->indices[i + 2]]);
        }
    }
    std::vector<int> source = coverage.takeSource();
    spread(source, width, height, std::max(radiusTexels, 0));
    return source;
}

} // namespace celadon
