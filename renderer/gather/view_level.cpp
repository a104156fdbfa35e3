#include "renderer/gather/view_level.h"

#include "renderer/gather/four.h"

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cmath>

namespace celadon {

namespace {

/// Pixels of the finer level in one of the coarser, those that scatter, by depth.
struct Children {
    std::array<std::size_t, 4> index;
    std::array<float, 4> depth;
    std::size_t count = 0;

    void add(std::size_t child, float z) {
        std::size_t i = count++;
        for (; i > 0 && depth[i - 1] > z; --i) {
            index[i] = index[i - 1];
            depth[i] = depth[i - 1];
        }
        index[i] = child;
        depth[i] = z;
    }
};

void merge(const ViewLevel& finer, const Children& children, float clusterMm, ViewLevel& level,
           std::size_t to) {
    const std::size_t middle = (children.count - 1) / 2;
    const std::size_t median = children.index[middle];
    Four position{}, normal{};
    float near = 0.0f;
    for (std::size_t i = 0; i < children.count; ++i) {
        if (std::abs(children.depth[i] - children.depth[middle]) < clusterMm) {
            position += loadFour(&finer.positions[4 * children.index[i]]);
            normal += loadFour(&finer.normals[4 * children.index[i]]);
            near += 1.0f;
        }
    }
    const float squared = dot3(normal, normal);
    normal = squared > 1e-12f ? normal * (1.0f / std::sqrt(squared)) : Four{0.0f, 0.0f, 1.0f};
    storeFour(&level.positions[4 * to], position / near);
    storeFour(&level.normals[4 * to], normal);
    storeFour(&level.surfaces[4 * to], loadFour(&finer.surfaces[4 * median]));
    level.seenAs[to] =
        finer.seenAs.empty() ? static_cast<std::uint32_t>(median) : finer.seenAs[median];
}

void makeRow(const ViewLevel& finer, float clusterMm, int row, ViewLevel& level) {
    for (int column = 0; column < level.part.z; ++column) {
        const glm::ivec2 pixel = glm::ivec2(level.part) + glm::ivec2(column, row);
        Children children;
        for (int i = 0; i < 4; ++i) {
            const std::size_t child = finer.indexOf(2 * pixel + glm::ivec2(i & 1, i >> 1));
            if (child != ViewLevel::kNowhere && finer.scatters(child)) {
                children.add(child, finer.positions[4 * child + 3]);
            }
        }
        const std::size_t to = level.indexOf(pixel);
        if (children.count > 0) {
            merge(finer, children, clusterMm, level, to);
        } else {
            storeFour(&level.positions[4 * to], Four{});
            storeFour(&level.surfaces[4 * to], Four{0.0f, 0.0f, -1.0f, 0.0f});
        }
    }
}

} // namespace

void forEachRow(const ViewLevel& level, const std::function<void(int row)>& work) {
    constexpr int kRowsATask = 8;
    tbb::parallel_for(tbb::blocked_range<int>(0, level.part.w, kRowsATask), [&](const auto& rows) {
        for (int row = rows.begin(); row < rows.end(); ++row) {
            work(row);
        }
    });
}

void makeCoarserLevels(std::span<ViewLevel> levels, float clusterMm) {
    for (std::size_t k = 1; k < levels.size(); ++k) {
        ViewLevel& level = levels[k];
        const std::size_t pixels =
            static_cast<std::size_t>(level.part.z) * static_cast<std::size_t>(level.part.w);
        for (std::vector<float>* const values :
             {&level.positions, &level.normals, &level.surfaces}) {
            values->resize(4 * pixels);
        }
        level.seenAs.resize(pixels);
        forEachRow(level, [&](int row) { makeRow(levels[k - 1], clusterMm, row, level); });
    }
}

void copyRadiiUp(std::span<ViewLevel> levels) {
    for (ViewLevel& level : levels.subspan(1)) {
        for (std::size_t i = 0; i < level.seenAs.size(); ++i) {
            if (level.scatters(i)) {
                level.surfaces[4 * i + 3] = levels[0].surfaces[4 * level.seenAs[i] + 3];
            }
        }
    }
}

} // namespace celadon
