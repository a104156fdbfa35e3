#include "renderer/reference/surface_reference.h"

#include "renderer/reference/cut_out.h"
#include "renderer/reference/incidence.h"
#include "renderer/reference/random.h"
#include "renderer/shading/fresnel.h"
#include "subedit/assert.h"

#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

constexpr double kSquareMetersPerSquareMillimeter = 1e-6;

/// A corner of a cell: place, and barycentric coordinates in the triangle that it is cut from.
struct Corner {
    glm::dvec3 position;
    glm::dvec2 barycentric;
};

Corner mix(const Corner& a, const Corner& b, double t) {
    return {a.position + t * (b.position - a.position),
            a.barycentric + t * (b.barycentric - a.barycentric)};
}

using Cell = std::array<Corner, 3>;

/// Cuts a cell into `count` of equal area, always across the longest edge, so that they stay round.
/// Where the number of parts on the two sides can differ, chance decides.
template<typename Visit>
void cutCell(const Cell& cell, int count, Random& random, Visit&& visit) {
    if (count == 1) {
        visit(cell);
        return;
    }
    int longest = 0;
    double squared = -1.0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 edge = cell[(i + 1) % 3].position - cell[i].position;
        if (glm::dot(edge, edge) > squared) {
            squared = glm::dot(edge, edge);
            longest = i;
        }
    }
    const Corner& a = cell[longest];
    const Corner& b = cell[(longest + 1) % 3];
    const Corner& c = cell[(longest + 2) % 3];
    const int wobble = count / 8 + 1; // up to an eighth of the parts change sides
    const int lowest = std::max(1, (count - wobble + 1) / 2);
    const int highest = count - lowest;
    const int first = lowest + static_cast<int>(random.uniform() * (highest - lowest + 1));
    const Corner cut = mix(a, b, static_cast<double>(first) / count);
    cutCell({a, cut, c}, first, random, visit);
    cutCell({cut, b, c}, count - first, random, visit);
}

/// Covariance of a place chosen evenly in a triangle: a twelfth of the sum over its corners.
std::array<float, 6> covarianceOf(const Cell& cell, glm::dvec3 mean) {
    glm::dvec3 diagonal(0.0);
    glm::dvec3 mixed(0.0); // xy xz yz
    for (const Corner& corner : cell) {
        const glm::dvec3 d = corner.position - mean;
        diagonal += d * d / 12.0;
        mixed += glm::dvec3(d.x * d.y, d.x * d.z, d.y * d.z) / 12.0;
    }
    const glm::vec3 s(diagonal);
    const glm::vec3 m(mixed);
    return {s.x, m.x, m.y, s.y, m.z, s.z};
}

struct Triangle {
    int mesh;
    std::uint32_t index;
    double area; ///< mm^2
};

Cell wholeTriangle(const World& world, const Triangle& triangle) {
    const Mesh& mesh = world.meshes[triangle.mesh].mesh;
    const std::uint32_t* index = mesh.indices.data() + 3 * std::size_t{triangle.index};
    return {Corner{glm::dvec3(mesh.positions[index[0]]), {0.0, 0.0}},
            Corner{glm::dvec3(mesh.positions[index[1]]), {1.0, 0.0}},
            Corner{glm::dvec3(mesh.positions[index[2]]), {0.0, 1.0}}};
}

std::vector<Triangle> scatteringTriangles(const World& world) {
    std::vector<Triangle> triangles;
    for (std::size_t m = 0; m < world.meshes.size(); ++m) {
        if (world.meshes[m].scattering < 0) {
            continue;
        }
        const auto count = static_cast<std::uint32_t>(world.meshes[m].mesh.triangleCount());
        for (std::uint32_t t = 0; t < count; ++t) {
            Triangle triangle{static_cast<int>(m), t, 0.0};
            const Cell cell = wholeTriangle(world, triangle);
            const glm::dvec3& p0 = cell[0].position;
            const glm::dvec3& p1 = cell[1].position;
            const glm::dvec3& p2 = cell[2].position;
            triangle.area = 0.5 * glm::length(glm::cross(p1 - p0, p2 - p0));
            if (triangle.area > 0.0) {
                triangles.push_back(triangle);
            }
        }
    }
    return triangles;
}

/// A place chosen evenly in a cell, in barycentric coordinates of the triangle.
glm::dvec2 placeWithin(const Cell& cell, Random& random) {
    const double s = std::sqrt(random.uniform());
    const double t = random.uniform();
    return (1.0 - s) * cell[0].barycentric + s * (1.0 - t) * cell[1].barycentric +
           s * t * cell[2].barycentric;
}

/// Flux that enters an area around the place, W, of all lights.
glm::dvec3 transmittedFlux(const RayScene& rays, const SurfacePoint& point, double areaMm2,
                           std::span<const Light> lights) {
    glm::dvec3 flux(0.0);
    for (const Light& light : lights) {
        const Incidence incidence = incidenceAt(light, point.positionMm);
        if (incidence.irradiance == glm::dvec3(0.0)) {
            continue;
        }
        const std::optional<Facing> facing = facingLight(point, incidence.toLight);
        if (!facing || rays.isOccluded(point, incidence.toLight, incidence.distanceMm)) {
            continue;
        }
        const double eta = static_cast<double>(rays.world().materials[point.material]->eta);
        const double crossSectionMm2 = areaMm2 * facing->geometricCosine;
        flux += fresnelTransmittance(facing->shadingCosine, eta) * incidence.irradiance *
                (crossSectionMm2 * kSquareMetersPerSquareMillimeter);
    }
    return flux;
}

TrianglePoint placeOn(const Triangle& triangle, glm::dvec2 barycentric) {
    return {triangle.mesh, triangle.index, barycentric.x, barycentric.y};
}

SurfacePoint pointAt(const World& world, const Triangle& triangle, glm::dvec2 barycentric) {
    return surfacePoint(world, placeOn(triangle, barycentric));
}

/// The patches of one triangle, cut into `cells`.
void cutTriangle(const RayScene& rays, const Triangle& triangle, int cells, Random& random,
                 std::span<const Light> lights, SurfacePatches& patches) {
    const double area = triangle.area / cells;
    cutCell(wholeTriangle(rays.world(), triangle), cells, random, [&](const Cell& cell) {
        const glm::dvec2 chosen = placeWithin(cell, random);
        if (isCutOut(rays.world(), placeOn(triangle, chosen))) {
            return;
        }
        const glm::dvec3 flux =
            transmittedFlux(rays, pointAt(rays.world(), triangle, chosen), area, lights);
        if (flux == glm::dvec3(0.0)) {
            return;
        }
        const glm::dvec2 center =
            (cell[0].barycentric + cell[1].barycentric + cell[2].barycentric) / 3.0;
        const SurfacePoint mean = pointAt(rays.world(), triangle, center);
        patches.patches.push_back({glm::vec3(mean.positionMm), glm::vec3(mean.shadingNormal),
                                   glm::vec3(flux), covarianceOf(cell, mean.positionMm), mean.uv,
                                   mean.material});
        patches.triangles.push_back({glm::vec3(cell[0].position), glm::vec3(cell[1].position),
                                     glm::vec3(cell[2].position)});
    });
}

} // namespace

SurfacePatches SurfaceReference::samplePatches(std::span<const Light> lights, int count,
                                               std::uint64_t seed) const {
    CELADON_ASSERT(count >= 1);
    const World& world = mRays.world();
    const std::vector<Triangle> triangles = scatteringTriangles(world);
    double totalArea = 0.0;
    for (const Triangle& triangle : triangles) {
        totalArea += triangle.area;
    }
    if (totalArea <= 0.0) {
        return {};
    }
    constexpr std::size_t kTrianglesPerTask = 64;
    const std::size_t tasks = (triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
    std::vector<SurfacePatches> parts(tasks);
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
        const std::size_t end = std::min(triangles.size(), (task + 1) * kTrianglesPerTask);
        for (std::size_t i = task * kTrianglesPerTask; i < end; ++i) {
            // The expected number of cells, rounded up or down by chance.
            Random random(seed, i);
            const double expected = count * (triangles[i].area / totalArea);
            const int cells = std::max(1, static_cast<int>(expected + random.uniform()));
            cutTriangle(mRays, triangles[i], cells, random, lights, parts[task]);
        }
    });

    SurfacePatches all;
    for (const SurfacePatches& part : parts) {
        all.patches.insert(all.patches.end(), part.patches.begin(), part.patches.end());
        all.triangles.insert(all.triangles.end(), part.triangles.begin(), part.triangles.end());
    }
    return all;
}

SurfaceReferenceResult SurfaceReference::solve(std::span<const ExitPoint> exitPoints,
                                               std::span<const Light> lights,
                                               const SurfaceReferenceOptions& options) const {
    SurfaceReferenceResult result;
    result.exitance.assign(exitPoints.size(), glm::vec3(0.0f));
    result.standardError.assign(exitPoints.size(), glm::vec3(0.0f));
    std::array<GatherResult, 2> halves;
    for (int half = 0; half < 2; ++half) {
        GatherOptions gather = options.gather;
        if (options.gather.progress) {
            gather.progress = [&, half](double done) {
                options.gather.progress(0.5 * (half + done));
            };
        }
        const SurfacePatches samples =
            samplePatches(lights, std::max(1, options.samples / 2), 2 * options.seed + half);
        result.litFlux += 0.5 * totalFlux(samples.patches);
        gather.triangles = samples.triangles;
        halves[half] = gatherExitance(exitPoints, samples.patches, mRays.world().materials, gather);
        result.pairs += halves[half].pairs;
        if (halves[half].cancelled) {
            result.cancelled = true;
            return result;
        }
    }
    double squaredError = 0.0;
    double squaredExitance = 0.0;
    for (std::size_t i = 0; i < exitPoints.size(); ++i) {
        const glm::vec3 a = halves[0].exitance[i];
        const glm::vec3 b = halves[1].exitance[i];
        result.exitance[i] = 0.5f * (a + b);
        result.standardError[i] = 0.5f * glm::abs(a - b);
        const glm::dvec3 error(result.standardError[i]);
        const glm::dvec3 exitance(result.exitance[i]);
        squaredError += glm::dot(error, error);
        squaredExitance += glm::dot(exitance, exitance);
    }
    if (squaredExitance > 0.0) {
        result.relativeError = std::sqrt(squaredError / squaredExitance);
    }
    return result;
}

} // namespace celadon
