#pragma once

#include "renderer/raster/screen_vertex.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

/// What filling a triangle needs, from its snapped corners.
namespace celadon {

/// Rows or columns of a picture, both counted.
struct RasterRange {
    int first, last;
};

/// Positive to the left of a directed edge. Of an edge and its reverse, one counts points on it as
/// inside.
class EdgeFunction {
public:
    EdgeFunction(const ScreenVertex& from, const ScreenVertex& to)
        : mAcross(std::int64_t{from.y} - to.y),
          mUp(std::int64_t{to.x} - from.x),
          mOffset(-mAcross * from.x - mUp * from.y -
                  (mAcross > 0 || (mAcross == 0 && mUp < 0) ? 0 : 1)) {}

    [[nodiscard]] std::int64_t at(std::int64_t x, std::int64_t y) const {
        return mAcross * x + mUp * y + mOffset;
    }
    /// From a pixel to the next in its row, and to that above.
    [[nodiscard]] std::int64_t stepAcross() const { return mAcross * kSubpixels; }
    [[nodiscard]] std::int64_t stepUp() const { return mUp * kSubpixels; }

private:
    std::int64_t mAcross, mUp, mOffset;
};

/// Of depth over the picture.
struct DepthPlane {
    double origin = 0.0, across = 0.0, up = 0.0; ///< depth at vertex 0, its change a subpixel
    std::int32_t x = 0, y = 0;                   ///< vertex 0
    float least = 0.0f, greatest = 0.0f;         ///< of what the triangle has, up to the near plane

    DepthPlane() = default; ///< most small triangles need none
    DepthPlane(const std::array<ScreenVertex, 3>& t, std::int64_t area)
        : origin(static_cast<double>(t[0].z)),
          x(t[0].x),
          y(t[0].y),
          least(std::clamp(std::min({t[0].z, t[1].z, t[2].z}), 0.0f, 1.0f)),
          greatest(std::clamp(std::max({t[0].z, t[1].z, t[2].z}), 0.0f, 1.0f)) {
        const double z1 = static_cast<double>(t[1].z) - origin;
        const double z2 = static_cast<double>(t[2].z) - origin;
        const double scale = 1.0 / static_cast<double>(area);
        across = (z1 * (t[2].y - y) - z2 * (t[1].y - y)) * scale;
        up = (z2 * (t[1].x - x) - z1 * (t[2].x - x)) * scale;
    }

    [[nodiscard]] double at(std::int32_t px, std::int32_t py) const {
        return origin + across * (px - x) + up * (py - y);
    }
};

} // namespace celadon
