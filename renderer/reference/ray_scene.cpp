#include "renderer/reference/ray_scene.h"

#include "renderer/reference/cut_out.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <embree3/rtcore.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace celadon {

SurfacePoint surfacePoint(const World& world, const TrianglePoint& place) {
    CELADON_ASSERT(static_cast<std::size_t>(place.mesh) < world.meshes.size());
    const WorldMesh& worldMesh = world.meshes[place.mesh];
    const Mesh& mesh = worldMesh.mesh;
    CELADON_ASSERT(place.triangle < mesh.triangleCount());
    const std::uint32_t* index = mesh.indices.data() + 3 * std::size_t{place.triangle};
    const glm::dvec3 weights(1.0 - place.u - place.v, place.u, place.v);

    SurfacePoint point;
    const glm::dvec3 p0(mesh.positions[index[0]]);
    const glm::dvec3 p1(mesh.positions[index[1]]);
    const glm::dvec3 p2(mesh.positions[index[2]]);
    point.positionMm = weights.x * p0 + weights.y * p1 + weights.z * p2;
    const glm::dvec3 cross = glm::cross(p1 - p0, p2 - p0);
    const double area = glm::length(cross);
    point.geometricNormal = area > 0.0 ? cross / area : glm::dvec3(0.0, 0.0, 1.0);

    glm::dvec3 normal(0.0);
    if (mesh.normals.size() == mesh.positions.size()) {
        for (int i = 0; i < 3; ++i) {
            normal += weights[i] * glm::dvec3(mesh.normals[index[i]]);
        }
    }
    // Opposite vertex normals can cancel out; the triangle's own is then the only sensible one.
    const double length = glm::length(normal);
    point.shadingNormal = length > 1e-6 ? normal / length : point.geometricNormal;

    if (mesh.uvs.size() == mesh.positions.size()) {
        glm::dvec2 uv(0.0);
        for (int i = 0; i < 3; ++i) {
            uv += weights[i] * glm::dvec2(mesh.uvs[index[i]]);
        }
        point.uv = glm::vec2(uv);
    }
    point.material = worldMesh.scattering;
    const auto look = static_cast<std::size_t>(mesh.material);
    point.doubleSided = look < world.looks.size() && world.looks[look].doubleSided;
    return point;
}

namespace {

/// Of Embree, for one ray: a hit where the mesh is cut out does not count.
void passCutOut(const RTCFilterFunctionNArguments* arguments) {
    const auto& world = *static_cast<const World*>(arguments->geometryUserPtr);
    RTCHitN* const hit = arguments->hit;
    const TrianglePoint place{static_cast<int>(RTCHitN_geomID(hit, 1, 0)),
                              RTCHitN_primID(hit, 1, 0), static_cast<double>(RTCHitN_u(hit, 1, 0)),
                              static_cast<double>(RTCHitN_v(hit, 1, 0))};
    if (isCutOut(world, place)) {
        arguments->valid[0] = 0;
    }
}

} // namespace

/// Owns the device and the scene; Embree reports failures through the device.
struct RayScene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    glm::dvec3 center{0.0};
    double liftMm = 0.0;

    Embree() : device(rtcNewDevice(nullptr)) {
        if (device == nullptr) {
            throw Error("ray tracing", "Embree cannot start", "", ExitCode::Failed);
        }
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    }
    ~Embree() {
        if (scene != nullptr) {
            rtcReleaseScene(scene);
        }
        if (device != nullptr) {
            rtcReleaseDevice(device);
        }
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    void check() const {
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
            throw Error("ray tracing", "Embree cannot build its tree", "use a smaller mesh",
                        ExitCode::Failed);
        }
    }

    void add(const World& world, unsigned id) {
        const Mesh& mesh = world.meshes[id].mesh;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), mesh.triangleCount()));
        if (vertices == nullptr || indices == nullptr) {
            rtcReleaseGeometry(geometry);
            check();
            return;
        }
        for (const glm::vec3 p : mesh.positions) {
            const glm::vec3 local(glm::dvec3(p) - center);
            vertices = std::copy_n(&local.x, 3, vertices);
        }
        std::copy_n(mesh.indices.begin(), 3 * mesh.triangleCount(), indices);
        if (mayBeCutOut(world, mesh)) {
            rtcSetGeometryUserData(geometry, const_cast<World*>(&world));
            rtcSetGeometryIntersectFilterFunction(geometry, passCutOut);
            rtcSetGeometryOccludedFilterFunction(geometry, passCutOut);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }
};

RayScene::RayScene(const World& world) : mWorld(&world), mEmbree(std::make_unique<Embree>()) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const WorldMesh& mesh : world.meshes) {
        for (const glm::vec3 p : mesh.mesh.positions) {
            low = glm::min(low, glm::dvec3(p));
            high = glm::max(high, glm::dvec3(p));
        }
    }
    if (low.x <= high.x) {
        mEmbree->center = 0.5 * (low + high);
        // A hit is good to a few units in the last place of the largest coordinate, the positions
        // themselves to one of theirs before they were moved.
        const double extent = glm::length(high - low);
        const double magnitude = std::max({extent, glm::length(low), glm::length(high)});
        mEmbree->liftMm = 2e-6 * extent + 1.2e-7 * magnitude;
    }
    for (std::size_t i = 0; i < world.meshes.size(); ++i) {
        if (world.meshes[i].mesh.triangleCount() > 0) {
            mEmbree->add(world, static_cast<unsigned>(i));
        }
    }
    rtcCommitScene(mEmbree->scene);
    mEmbree->check();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

namespace {

RTCRay makeRay(glm::dvec3 origin, glm::dvec3 direction, double length) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0.0f;
    ray.tfar = static_cast<float>(length);
    ray.mask = ~0u;
    return ray;
}

} // namespace

std::optional<RayScene::Hit> RayScene::nearest(glm::dvec3 origin, glm::dvec3 direction,
                                               double distanceMm) const {
    RTCRayHit query{};
    query.ray = makeRay(origin - mEmbree->center, direction, distanceMm);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(mEmbree->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return Hit{{static_cast<int>(query.hit.geomID), query.hit.primID,
                static_cast<double>(query.hit.u), static_cast<double>(query.hit.v)},
               static_cast<double>(query.ray.tfar)};
}

glm::dvec3 RayScene::liftedOrigin(const SurfacePoint& from, glm::dvec3 direction) const {
    const double side = glm::dot(from.geometricNormal, direction) < 0.0 ? -1.0 : 1.0;
    return from.positionMm + side * mEmbree->liftMm * from.geometricNormal;
}

bool RayScene::isOccluded(const SurfacePoint& from, glm::dvec3 direction, double distanceMm) const {
    RTCRay ray = makeRay(liftedOrigin(from, direction) - mEmbree->center, direction, distanceMm);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(mEmbree->scene, &context, &ray);
    return ray.tfar < 0.0f;
}

} // namespace celadon
