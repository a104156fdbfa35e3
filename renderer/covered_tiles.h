#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

/// With Rasterizer::Processor: the tiles of a picture, and of its mips, where something is seen, so
/// that passes leave the background alone (shaders/include/covered_group.glsl). A software driver
/// takes as long for a pixel that returns at once as for any other.
namespace celadon {

class CoveredTiles {
public:
    static constexpr int kTilePx = 32; ///< the work group of such passes

    /// @param size of level 0; all sizes halve, rounded up @param levels >= 1
    CoveredTiles(glm::ivec2 size, int levels);

    /// @param triangles [picture][row][column] of one or several pictures: 0 where nothing is seen
    /// @param size of these, at most that of level 0
    /// @param others of the same size and levels, whose tiles count as well; may be null
    void find(std::span<const std::uint32_t> triangles, glm::ivec2 size,
              const CoveredTiles* others = nullptr);

    /// A group of the program, which is in use, for each tile.
    void dispatch(const gl::Program& program, int level) const;

    /// The same for tiles where something is seen or was since touchedDone(): what a pass has to
    /// write that leaves a background of its own.
    void dispatchTouched(const gl::Program& program, int level) const;
    void touchedDone();

private:
    struct Level {
        glm::ivec2 tiles;
        std::vector<bool> covered, touched;
        gl::Buffer coveredList, touchedList; ///< x + 65536 y
        int coveredCount = 0, touchedCount = 0;
    };
    static int list(const std::vector<bool>& mask, glm::ivec2 tiles, gl::Buffer& buffer);

    std::vector<Level> mLevels;
};

} // namespace celadon
