#pragma once

#include "subedit/paint/brush.h"
#include "subedit/paint/surface.h"

#include <array>
#include <memory>
#include <vector>

/// The weights that a stroke lays on a surface, dab by dab. A dab fills the part of a ball around
/// its center that the surface connects with the center inside the ball: charts and their seams do
/// not show, and neither the far side of a thin part nor a neighboring finger is touched.
namespace celadon::subedit {

class StrokeMask {
public:
    using Texel = Surface::Texel;

    /// @param surface must outlive the mask
    StrokeMask(const Surface& surface, const Brush& brush, const Mirror& mirror = {});

    /// Goes on to `point`: a dab at the first one, then one every `spacing` radii along the path.
    /// A radius below a texel counts as one.
    /// A lifted point has a dab of its own, and nothing between it and the one before.
    /// The same points give the same weights, however they are grouped into calls.
    /// @throws InputError if two points are so far apart that 100,000 dabs lie between them
    void add(const StrokePoint& point);

    /// Weight in [0, 1] of a covered texel; background texels have that of their source.
    [[nodiscard]] float weight(Texel texel) const;

    /// Covered texels whose weight has changed since the last call, each once, in the order of
    /// their change.
    [[nodiscard]] std::vector<Texel> takeChanged();

    /// Position and normal of a path's point on this surface; nothing if no texel is near.
    [[nodiscard]] static std::optional<StrokePoint>
    resolve(const Surface& surface, const StrokePoint& point, float withinMm);

private:
    struct Dab {
        glm::vec3 centerMm;
        glm::vec3 normal;
        float flow;
    };
    void addMirrored(const Dab& dab);
    void addDab(const Dab& dab);

    static constexpr int kTileTexels = 64; ///< few: a dab leaves a map's row soon
    /// What is known of consecutive texels; made where a dab comes by.
    struct Tile {
        std::array<float, kTileTexels> weight{};
        std::array<std::uint32_t, kTileTexels> changed{}; ///< the takeChanged() it is listed for
    };
    [[nodiscard]] Tile& tileOf(Texel texel);
    /// Marks a texel as visited by the dab. @return whether it was not yet
    bool visit(Texel texel);

    const Surface& mSurface;
    Brush mBrush;
    float mRadiusMm; ///< the brush's, or what reaches a texel wherever its center is
    Mirror mMirror;
    std::vector<glm::vec3> mSides;
    std::vector<std::unique_ptr<Tile>> mTiles;
    std::vector<Texel> mChanged;
    std::uint32_t mChangeRound = 1;
    std::vector<std::uint64_t> mVisited; ///< a bit for each texel; all 0 between dabs
    std::vector<Texel> mVisitedWords;    ///< those that are not 0
    /// A texel of a dab's flood, and where it lies from the dab.
    struct Reached {
        Texel texel;
        float distance; ///< from the center, mm
        float cosine;   ///< of both normals
    };
    std::vector<Reached> mFront;

    std::optional<StrokePoint> mLast;
    float mUntilNextMm = 0.0f; ///< along the path from mLast to the next dab
};

} // namespace celadon::subedit
