#pragma once

#include "subedit/map/material_map.h"
#include "subedit/map/texel_rect.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

/// The mean profile of a material (Chen et al. 2012, eqs. 15 and 16): what its profiles look like
/// on average when each is measured in units of its own effective radius. The table of minimal
/// effective rendering radii (range_table.h) is computed from it.
namespace celadon::subedit {

inline constexpr int kMeanProfileIntervals = 256;

/// P over r in [0, 1], linear between kMeanProfileIntervals + 1 equally spaced samples, with
/// integral of P r dr over [0, 1] = 1.
class MeanProfile {
public:
    /// Takes samples of any scale and normalizes them.
    explicit MeanProfile(std::vector<double> samples);

    /// @param r in [0, 1]; clamped
    [[nodiscard]] double value(double r) const;
    /// Integral of P r dr over [r, 1].
    [[nodiscard]] double energyBeyond(double r) const;
    struct Point {
        double value;
        double energyBeyond;
    };
    /// Both at once.
    [[nodiscard]] Point at(double r) const;
    [[nodiscard]] std::span<const double> samples() const { return mSamples; }
    /// energyBeyond() at the samples.
    [[nodiscard]] std::span<const double> samplesBeyond() const { return mBeyond; }

private:
    std::vector<double> mSamples;
    std::vector<double> mBeyond; ///< energyBeyond at the samples
};

/// Sums of P'(r) = C P(r R_P) over tiles of a map, C such that the integral of P' r dr over [0, 1]
/// is 1: what the mean is made of, kept so that an edit costs only the tiles that it touched. The
/// three channels of a texel are summed before C is applied: they share one R_P (the largest), and
/// so count by the energy that each brings. Texels count alike, whatever their albedo.
class MeanProfileSums {
public:
    static constexpr int kTileSize = 8; ///< texels on a side

    /// @param effectiveRadiusMm R_P of each texel, as from effectiveRadiusMap()
    MeanProfileSums(const MaterialMap& map, std::span<const float> effectiveRadiusMm);

    /// Texels of `rects` have changed: the same bits as sums made anew.
    /// @param beforeTile called on any thread with each tile that will be summed: radii may be
    ///                   brought up to date there, while the tile's profiles are at hand
    void update(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                std::span<const TexelRect> rects,
                const std::function<void(const TexelRect&)>& beforeTile = {});

    [[nodiscard]] MeanProfile mean() const;

private:
    using Sum = std::array<float, kMeanProfileIntervals + 1>;
    [[nodiscard]] TexelRect tileRect(const MaterialMap& map, int tile) const;
    static void sumTile(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                        const TexelRect& rect, Sum& result);

    static constexpr int kSpanTiles = 16;
    int mTilesX = 0;
    int mTilesY = 0;
    int mSpansX = 0;
    std::vector<Sum> mTiles;                    ///< [tilesY][tilesX]
    std::vector<std::vector<double>> mSpanSums; ///< of kSpanTiles tiles of a row, in order
    std::vector<std::vector<double>> mRowSums;  ///< of each row of tiles, from its spans
};

/// Mean over all texels, from sums made anew.
/// @param effectiveRadiusMm R_P of each texel, as from effectiveRadiusMap()
[[nodiscard]] MeanProfile meanProfile(const MaterialMap& map,
                                      std::span<const float> effectiveRadiusMm);

} // namespace celadon::subedit
