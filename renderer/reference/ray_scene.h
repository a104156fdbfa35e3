#pragma once

#include "renderer/scene/world.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

/// Rays against all triangles of a world, scattering and opaque, by Embree; what is cut out of a
/// mesh lets them pass. Coordinates are world
/// millimeters in double; inside, the scene is moved to its center, so that a scene far from the
/// origin loses nothing.
namespace celadon {

/// A place on a mesh by its barycentric coordinates: (1 - u - v) p0 + u p1 + v p2.
struct TrianglePoint {
    int mesh = 0;
    std::uint32_t triangle = 0;
    double u = 0.0;
    double v = 0.0;
};

/// What the mesh is there.
struct SurfacePoint {
    glm::dvec3 positionMm{0.0};
    glm::dvec3 geometricNormal{0.0}; ///< unit, of the front (counter-clockwise) side
    glm::dvec3 shadingNormal{0.0};   ///< unit, interpolated; on the front side as the file has it
    glm::vec2 uv{0.0f};              ///< (0, 0) where the mesh has none
    int material = -1;               ///< index into World::materials; -1: opaque
    bool doubleSided = false;
};

[[nodiscard]] SurfacePoint surfacePoint(const World& world, const TrianglePoint& place);

class RayScene {
public:
    /// @param world  referred to; must outlive this object and keep its meshes as they are
    /// @throws Error (ExitCode::Failed) when Embree cannot start or runs out of memory
    explicit RayScene(const World& world);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    struct Hit {
        TrianglePoint place;
        double distanceMm = 0.0;
    };

    /// First surface along the ray, either side. Thread-safe.
    /// @param direction   unit length
    /// @param distanceMm  how far to look
    [[nodiscard]] std::optional<Hit>
    nearest(glm::dvec3 origin, glm::dvec3 direction,
            double distanceMm = std::numeric_limits<double>::infinity()) const;

    /// Where a ray that leaves a point of the surface has to start so as not to meet that surface
    /// again: a hair off it, on the side that the ray goes to.
    [[nodiscard]] glm::dvec3 liftedOrigin(const SurfacePoint& from, glm::dvec3 direction) const;

    /// Whether anything lies between a point of the surface and `distanceMm` along `direction`,
    /// starting at liftedOrigin(); nothing nearer than that is seen. Thread-safe.
    /// @param distanceMm  infinity for all the way
    [[nodiscard]] bool isOccluded(const SurfacePoint& from, glm::dvec3 direction,
                                  double distanceMm) const;

    [[nodiscard]] const World& world() const { return *mWorld; }

private:
    struct Embree;
    const World* mWorld;
    std::unique_ptr<Embree> mEmbree;
};

} // namespace celadon
