#pragma once

#include "renderer/scene/atlas_rest_shape.h"

#include <optional>

/// A chart laid into the plane, or the reason why not: one chart, no neighbors, no packing.
namespace celadon::atlas {

/// Area-weighted measures of a flattened chart; 1 is perfect.
struct Distortion {
    double area = 1.0;  ///< mean of max(s, 1/s), s the area ratio
    double angle = 1.0; ///< mean ratio of the singular values of the Jacobian
    double worst = 1.0; ///< 99th percentile of max(largest, 1 / smallest singular value)
};

struct FlattenLimits {
    Distortion distortion;
    int polishIterations = 6; ///< of the symmetric energy, after the quick one
};

struct Chart {
    ChartMesh mesh;
    Planar uv; ///< isometric scale: the area in the plane is that on the surface
    Distortion distortion;
    double area = 0.0; ///< on the surface
};

/// Flattens; an annulus or a sphere with more holes is tried with its holes, then cut open.
/// @return nothing when the chart is closed, has handles, overlaps itself, or exceeds the limits
[[nodiscard]] std::optional<Chart> flattenChart(const Surface& surface, ChartMesh mesh,
                                                const FlattenLimits& limits);

/// Brings a chart nearer to isometry; leaves it as it is if it would then overlap itself.
void polishChart(const Surface& surface, Chart& chart);

} // namespace celadon::atlas
