#pragma once

#include "renderer/reference/ray_scene.h"
#include "renderer/scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

/// Turns flux that leaves the surface into radiant exitance per pixel: what a camera's pixel sees
/// of the surface is the area that counts it. No GL.
namespace celadon {

class ExitanceFilm {
public:
    /// @param rays  referred to @param size of the picture in pixels
    ExitanceFilm(const RayScene& rays, const CameraView& camera, glm::ivec2 size);

    struct Splat {
        std::size_t pixel; ///< x + width y, rows from the bottom
        double perArea;    ///< 1/m^2: exitance per flux
    };
    /// Where flux that leaves at a point counts; nothing where no pixel sees the front of the
    /// surface there. The expected sum of flux times `perArea` is the mean exitance over the part
    /// of the pixel that shows scattering surface, weighted by its area in the picture.
    [[nodiscard]] std::optional<Splat> project(const SurfacePoint& point) const;

    [[nodiscard]] std::size_t pixelCount() const { return mCoverage.size(); }

private:
    const RayScene& mRays;
    CameraView mCamera;
    glm::ivec2 mSize;
    std::vector<float> mCoverage; ///< part of each pixel that shows scattering surface

    [[nodiscard]] float coverageOf(int x, int y) const;
};

} // namespace celadon
