// The view when the command line leaves it open: camera.h, chooseCamera.
#include "renderer/scene/camera.h"
#include "subedit/errors.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace celadon {

namespace {

constexpr double kAzimuthDegrees = 30.0; ///< from +z towards +x
constexpr double kElevationDegrees = 18.0;
constexpr double kFittedFraction = 0.92; ///< of the picture's half size; the rest is margin

glm::dvec3 threeQuarterDirection() {
    const double azimuth = glm::radians(kAzimuthDegrees);
    const double elevation = glm::radians(kElevationDegrees);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

template<class Visit>
void forEachScatteringVertex(const World& world, Visit&& visit) {
    for (const WorldMesh& part : world.meshes) {
        if (part.scattering < 0) {
            continue;
        }
        for (const std::uint32_t index : part.mesh.indices) {
            visit(glm::dvec3(part.mesh.positions[index]));
        }
    }
}

/// The eye nearest to the object from which every scattering vertex is inside the picture, with the
/// object in its middle. With c = (x, y, z) in the frame of the camera (z forward), being left of
/// the right plane from eye e is x - e_x <= t (z - e_z), and so on for the other three planes: four
/// maxima over the vertices, then e_z is the least depth that leaves room.
glm::dvec3 fittedEye(const World& world, const CameraFrame& frame, double fovYDegrees,
                     double aspect) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double tangentY = std::tan(glm::radians(0.5 * fovYDegrees)) * kFittedFraction;
    const glm::dvec2 t(tangentY * aspect, tangentY);
    const glm::dvec3 center = world.scatteringSphere.center;
    const auto visit = [&](auto&& see) { // a vertex's place in the picture plane, and its depth
        forEachScatteringVertex(world, [&](const glm::dvec3& position) {
            const glm::dvec3 p = position - center;
            see(glm::dvec2(glm::dot(p, frame.right), glm::dot(p, frame.up)),
                glm::dot(p, frame.forward));
        });
    };
    glm::dvec2 high(-kInfinity);
    glm::dvec2 low(-kInfinity);
    visit([&](glm::dvec2 xy, double z) {
        high = glm::max(high, xy - t * z);
        low = glm::max(low, -xy - t * z);
    });
    const glm::dvec2 depth = -(high + low) / (2.0 * t);
    const double z = std::min(depth.x, depth.y);
    glm::dvec2 xy = 0.5 * (high - low);
    // Where there is room to spare, the middle of the room is not that of the picture. Newton's
    // method on the sum of the least and greatest slope, which is zero when the margins are equal.
    constexpr int kCenteringSteps = 4;
    for (int step = 0; step < kCenteringSteps; ++step) {
        glm::dvec2 least(kInfinity);
        glm::dvec2 most(-kInfinity);
        glm::dvec2 leastDepth(1.0);
        glm::dvec2 mostDepth(1.0);
        visit([&](glm::dvec2 vertex, double vertexZ) {
            const double distance = vertexZ - z;
            const glm::dvec2 slope = (vertex - xy) / distance;
            for (int axis = 0; axis < 2; ++axis) {
                if (slope[axis] < least[axis]) {
                    least[axis] = slope[axis];
                    leastDepth[axis] = distance;
                }
                if (slope[axis] > most[axis]) {
                    most[axis] = slope[axis];
                    mostDepth[axis] = distance;
                }
            }
        });
        xy += (least + most) / (1.0 / leastDepth + 1.0 / mostDepth);
    }
    return center + xy.x * frame.right + xy.y * frame.up + z * frame.forward;
}

} // namespace

Camera chooseCamera(const World& world, const ViewRequest& request, double aspect) {
    const double unit = world.millimetersPerUnit;
    const glm::dvec3 center = world.scatteringSphere.center;
    const bool placed = request.from || request.at;

    Camera camera;
    if (!placed && !world.cameras.empty()) {
        camera = world.cameras.front();
    }
    if (request.fovYDegrees) {
        camera.fovYDegrees = *request.fovYDegrees;
        camera.orthographicHeight.reset();
    }
    if (request.up) {
        camera.up = *request.up;
    }
    if (!placed && !world.cameras.empty()) {
        validateCamera(camera);
        return camera;
    }

    camera.at = request.at ? *request.at * unit : center;
    camera.eye = request.from ? *request.from * unit : camera.at + threeQuarterDirection();
    const glm::dvec3 forward = camera.at - camera.eye;
    if (!request.up && std::abs(forward.y) > 0.9999 * glm::length(forward)) {
        camera.up = {0.0, 0.0, forward.y < 0.0 ? -1.0 : 1.0};
    }
    const CameraFrame frame = cameraFrame(camera); // refuses what does not make a view
    if (!request.from) {
        const glm::dvec3 eye = fittedEye(world, frame, camera.fovYDegrees, aspect);
        const double distance = glm::dot(center - eye, frame.forward);
        if (request.at) { // look at it exactly; as far off as fits when looking at the object
            camera.eye = camera.at - distance * frame.forward;
        } else {
            camera.eye = eye;
            camera.at = eye + distance * frame.forward;
        }
    }
    validateCamera(camera);
    return camera;
}

} // namespace celadon
