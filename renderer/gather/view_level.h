#pragma once

#include "renderer/gather/view_texels.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// The splatting buffer on the processor: what its levels show, each made of the next finer one.
namespace celadon {

/// What a level shows within a part of it; nothing scatters outside. RGBA, rows from the bottom.
struct ViewLevel {
    glm::ivec4 part{0};           ///< x, y, width, height
    std::vector<float> positions; ///< these and the next as ViewTexels
    std::vector<float> surfaces;
    std::vector<float> normals;        ///< xyz; undefined where nothing scatters
    std::vector<float> exitance;       ///< B^k in W/m^2; alpha: pairs
    std::vector<std::uint32_t> seenAs; ///< of a coarser level: the pixel of level 0 that it shows

    static constexpr std::size_t kNowhere = ~std::size_t{0};
    /// Of a pixel of the level; kNowhere outside of the part.
    [[nodiscard]] std::size_t indexOf(glm::ivec2 pixel) const {
        const glm::ivec2 local = pixel - glm::ivec2(part);
        const bool isInside = local.x >= 0 && local.y >= 0 && local.x < part.z && local.y < part.w;
        return isInside ? static_cast<std::size_t>(local.y) * static_cast<std::size_t>(part.z) +
                              static_cast<std::size_t>(local.x)
                        : kNowhere;
    }
    [[nodiscard]] bool scatters(std::size_t index) const {
        return positions[4 * index + 3] > 0.0f && surfaces[4 * index + 2] >= 0.0f;
    }
    [[nodiscard]] ViewTexels texels(float* sums) const {
        return {{part.z, part.w}, positions.data(), surfaces.data(), sums};
    }
};

/// Calls `work` for each row of the part, on all cores.
void forEachRow(const ViewLevel& level, const std::function<void(int row)>& work);

/// Of each 2 x 2 the one of median depth, as shaders/median_mip.comp has it.
/// @param levels level 0 filled, of the others the parts
/// @param clusterMm depths that count as one surface
void makeCoarserLevels(std::span<ViewLevel> levels, float clusterMm);

/// R_P of level 0 to all others, after profiles were edited.
void copyRadiiUp(std::span<ViewLevel> levels);

} // namespace celadon
