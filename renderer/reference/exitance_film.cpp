#include "renderer/reference/exitance_film.h"

#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace celadon {

namespace {

constexpr double kSquareMillimetersPerSquareMeter = 1e6;
/// Rays on a side of a pixel; odd, so that its center, which decides whether it is seen, is one.
constexpr int kCoverageSide = 5;

} // namespace

ExitanceFilm::ExitanceFilm(const RayScene& rays, const CameraView& camera, glm::ivec2 size)
    : mRays(rays),
      mCamera(camera),
      mSize(size),
      mCoverage(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)) {
    oneapi::tbb::parallel_for(0, size.y, [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            mCoverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)] = coverageOf(x, y);
        }
    });
}

float ExitanceFilm::coverageOf(int x, int y) const {
    int seen = 0;
    for (int i = 0; i < kCoverageSide * kCoverageSide; ++i) {
        const double across = x + (i % kCoverageSide + 0.5) / kCoverageSide - 0.5 * mSize.x;
        const double up = y + (i / kCoverageSide + 0.5) / kCoverageSide - 0.5 * mSize.y;
        glm::dvec3 origin = mCamera.eye;
        glm::dvec3 direction = mCamera.frame.forward;
        const glm::dvec3 aside = across * mCamera.frame.right + up * mCamera.frame.up;
        if (mCamera.orthographic) {
            // An orthographic view sees what is behind the eye, too.
            const BoundingSphere& scene = mRays.world().sceneSphere;
            const double before = glm::dot(scene.center - origin, direction) - 1.001 * scene.radius;
            origin += mCamera.pixelWidth.offset * aside + before * direction;
        } else {
            direction = glm::normalize(direction + mCamera.pixelWidth.scale * aside);
        }
        const auto hit = mRays.nearest(origin, direction);
        if (hit && mRays.world().meshes[hit->place.mesh].scattering >= 0) {
            ++seen;
        }
    }
    return static_cast<float>(seen) / (kCoverageSide * kCoverageSide);
}

std::optional<ExitanceFilm::Splat> ExitanceFilm::project(const SurfacePoint& point) const {
    const glm::dvec3 fromEye = point.positionMm - mCamera.eye;
    const double depth = glm::dot(fromEye, mCamera.frame.forward);
    const double width = mCamera.pixelWidth.atDepthMm(depth);
    if (!mCamera.orthographic && depth <= 0.0) {
        return std::nullopt;
    }
    const double x = glm::dot(fromEye, mCamera.frame.right) / width + 0.5 * mSize.x;
    const double y = glm::dot(fromEye, mCamera.frame.up) / width + 0.5 * mSize.y;
    if (!(x >= 0.0 && y >= 0.0 && x < mSize.x && y < mSize.y)) {
        return std::nullopt;
    }
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(mSize.x) +
                              static_cast<std::size_t>(x);
    const double distance = glm::length(fromEye);
    const glm::dvec3 toEye = mCamera.orthographic ? -mCamera.frame.forward : -fromEye / distance;
    const double facing = glm::dot(point.geometricNormal, toEye);
    if (facing <= 0.0 || mCoverage[pixel] <= 0.0f ||
        mRays.isOccluded(point, toEye,
                         mCamera.orthographic ? std::numeric_limits<double>::infinity()
                                              : distance)) {
        return std::nullopt;
    }
    // An area dA fills dA cos / (width^2 cos_c) pixels, cos_c of the angle with the view's axis.
    const double axial = mCamera.orthographic ? 1.0 : depth / distance;
    const double pixelsPerArea =
        facing / (width * width * axial) * kSquareMillimetersPerSquareMeter;
    return Splat{pixel, pixelsPerArea / static_cast<double>(mCoverage[pixel])};
}

} // namespace celadon
