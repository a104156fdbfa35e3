#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

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

    /// Around the tiles: x, y, width, height in pixels of level 0; may end beyond the picture.
    [[nodiscard]] glm::ivec4 bounds() const;

private:
    friend class TouchedTiles;
    struct Level {
        glm::ivec2 tiles;
        std::vector<bool> covered;
        gl::Buffer list; ///< x + 65536 y
        int count = 0;
    };
    static int write(const std::vector<bool>& mask, glm::ivec2 tiles, gl::Buffer& list);

    std::vector<Level> mLevels;
};

/// For a pass that leaves a background of its own: it has to write the tiles where something is
/// seen, and those where something was when it ran before.
class TouchedTiles {
public:
    /// A group of the program, which is in use, for each; the first time for all there are.
    void dispatch(const gl::Program& program, const CoveredTiles& tiles, int level);
    /// After dispatch(): the pass goes on in these tiles as well, and so leaves something there.
    void add(const CoveredTiles& tiles, int level);

private:
    std::vector<bool> mCovered; ///< when it ran before
    gl::Buffer mList;
};

} // namespace celadon
