// In place of renderer/reference/ray_scene.cpp in a program without Embree: the solvers that trace
// rays say so. Linked before the libraries, so that theirs is not taken.
#include "renderer/reference/ray_scene.h"
#include "subedit/errors.h"

namespace celadon {

namespace {

[[noreturn]] void refuse() {
    throw UsageError("ray tracing", "is not in this small program", "take 'celadon' for it");
}

} // namespace

struct RayScene::Embree {};

SurfacePoint surfacePoint(const World&, const TrianglePoint&) {
    refuse();
}

RayScene::RayScene(const World&) {
    refuse();
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<RayScene::Hit> RayScene::nearest(glm::dvec3, glm::dvec3, double) const {
    refuse();
}

glm::dvec3 RayScene::liftedOrigin(const SurfacePoint&, glm::dvec3) const {
    refuse();
}

bool RayScene::isOccluded(const SurfacePoint&, glm::dvec3, double) const {
    refuse();
}

} // namespace celadon
