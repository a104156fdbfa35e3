#pragma once

#include "renderer/reference/patch.h"
#include "renderer/reference/ray_scene.h"
#include "renderer/scene/world.h"
#include "subedit/map/material_map.h"

#include <glm/glm.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

/// Materials and shapes for the tests of renderer/reference/.
namespace celadon::testing {

/// 2 pi integral of P r dr of a stored profile, by quadrature.
inline double storedAlbedo(const subedit::MaterialMap& map, int channel = 0, int x = 0, int y = 0) {
    double sum = 0;
    const double width = static_cast<double>(map.maxRadiusMm) / map.segments;
    constexpr int kSteps = 60; // even; Simpson's rule
    for (int k = 0; k < map.segments; ++k) {
        const double a = map.logKnot(x, y, k)[channel];
        const double b = map.logKnot(x, y, k + 1)[channel];
        for (int i = 0; i <= kSteps; ++i) {
            const double f = static_cast<double>(i) / kSteps;
            const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
            sum += weight / (3 * kSteps) * std::exp(a + (b - a) * f) * (k + f) * width * width;
        }
    }
    return 2 * std::numbers::pi * sum;
}

/// Albedo A and length l per channel: P = A (e^(-r/l) + e^(-r/3l)) / (8 pi l r), whose integral
/// over the plane is A; the first knot is such that the stored profile's integral is A as well.
inline void setTwoExponentials(subedit::MaterialMap& map, int x, int y, glm::dvec3 albedo,
                               glm::dvec3 lengthMm) {
    for (int c = 0; c < 3; ++c) {
        const double l = lengthMm[c];
        for (int k = 1; k <= map.segments; ++k) {
            const double r = static_cast<double>(map.maxRadiusMm) * k / map.segments;
            const double p = albedo[c] * (std::exp(-r / l) + std::exp(-r / (3 * l))) /
                             (8 * std::numbers::pi * l * r);
            map.logProfile[map.index(x, y, k) + c] =
                std::max(static_cast<float>(std::log(p)), subedit::kLogProfileFloor);
        }
        float low = map.logKnot(x, y, 1)[c];
        float high = low + 12;
        for (int i = 0; i < 40; ++i) {
            const float middle = 0.5f * (low + high);
            map.logProfile[map.index(x, y, 0) + c] = middle;
            (storedAlbedo(map, c, x, y) < albedo[c] ? low : high) = middle;
        }
    }
}

/// `cells` chooses albedo and length of each texel: {albedo, lengthMm}.
inline MaterialPointer
makeMaterial(int size, float maxRadiusMm, int segments,
             const std::function<std::pair<glm::dvec3, glm::dvec3>(int, int)>& cells,
             float eta = 1.3f) {
    auto map = std::make_shared<subedit::MaterialMap>();
    map->width = map->height = size;
    map->segments = segments;
    map->maxRadiusMm = maxRadiusMm;
    map->eta = eta;
    map->logProfile.resize(static_cast<std::size_t>(size) * size * map->knots() * 3);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto [albedo, length] = cells(x, y);
            setTwoExponentials(*map, x, y, albedo, length);
        }
    }
    return map;
}

/// Homogeneous. R_P(0.95) is 8.1 times the length, and r_s = 18 lengths hold 99.8 %.
inline MaterialPointer makeHomogeneous(glm::dvec3 lengthMm, float maxRadiusMm,
                                       glm::dvec3 albedo = {0.9, 0.7, 0.5}, float eta = 1.3f) {
    return makeMaterial(
        1, maxRadiusMm, 32, [&](int, int) { return std::pair(albedo, lengthMm); }, eta);
}

/// Triangles of a grid over [0, 1]^2, each vertex where `place` puts its parameters; normals by
/// differences, so that they are the smooth surface's. u x v is the front.
inline Mesh makeGrid(int across, int along, const std::function<glm::dvec3(glm::dvec2)>& place) {
    Mesh mesh;
    for (int j = 0; j <= along; ++j) {
        for (int i = 0; i <= across; ++i) {
            const glm::dvec2 uv(static_cast<double>(i) / across, static_cast<double>(j) / along);
            const double e = 1e-5;
            const glm::dvec3 du = place(uv + glm::dvec2(e, 0)) - place(uv - glm::dvec2(e, 0));
            const glm::dvec3 dv = place(uv + glm::dvec2(0, e)) - place(uv - glm::dvec2(0, e));
            mesh.positions.emplace_back(place(uv));
            mesh.normals.emplace_back(glm::normalize(glm::cross(du, dv)));
            mesh.uvs.emplace_back(uv);
        }
    }
    for (int j = 0; j < along; ++j) {
        for (int i = 0; i < across; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (across + 1) + i);
            const auto b = a + static_cast<std::uint32_t>(across) + 1;
            for (const std::uint32_t index : {a, a + 1, b + 1, a, b + 1, b}) {
                mesh.indices.push_back(index);
            }
        }
    }
    return mesh;
}

/// A closed box about the origin, each face a grid of one cell.
inline Mesh makeBox(glm::dvec3 size, glm::dvec3 center = {0, 0, 0}) {
    Mesh box;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 normal(0);
            glm::dvec3 u(0);
            glm::dvec3 v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1.0;
            const auto first = static_cast<std::uint32_t>(box.positions.size());
            for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                box.positions.emplace_back(center +
                                           0.5 * size * (normal + corner.x * u + corner.y * v));
                box.normals.emplace_back(normal);
                box.uvs.emplace_back(0.5 * (corner + 1.0));
            }
            for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) {
                box.indices.push_back(first + index);
            }
        }
    }
    return box;
}

/// Flat, facing +z, about the origin.
inline Mesh makeSlab(double widthMm, int cells, double z = 0) {
    return makeGrid(cells, cells, [=](glm::dvec2 uv) {
        return glm::dvec3(widthMm * (uv.x - 0.5), widthMm * (uv.y - 0.5), z);
    });
}

inline Mesh makeSphere(double radiusMm, int cells, glm::dvec3 center = {0, 0, 0}) {
    Mesh mesh = makeGrid(2 * cells, cells, [=](glm::dvec2 uv) {
        const double phi = 2 * std::numbers::pi * uv.x;
        // The poles are a hair's breadth open, so that normals by differences exist there.
        const double theta = std::numbers::pi * (1e-4 + (1 - 2e-4) * (1 - uv.y));
        return center + radiusMm * glm::dvec3(std::sin(theta) * std::cos(phi),
                                              std::sin(theta) * std::sin(phi), std::cos(theta));
    });
    return mesh;
}

/// A plate bent into three quarters of a tube, its outside in front, with a wave along it.
inline Mesh makeBentPlate(double radiusMm, double lengthMm, int cells) {
    return makeGrid(cells, cells, [=](glm::dvec2 uv) {
        const double phi = 1.5 * std::numbers::pi * uv.x;
        const double radius = radiusMm * (1 + 0.1 * std::sin(9 * uv.y));
        return glm::dvec3(radius * std::cos(phi), radius * std::sin(phi), lengthMm * (uv.y - 0.5));
    });
}

struct Part {
    Mesh mesh;
    int scattering = 0;
};

inline World makeWorld(std::vector<Part> parts, std::vector<MaterialPointer> materials) {
    World world;
    Scene everything;
    std::vector<bool> scatters;
    for (Part& part : parts) {
        everything.meshes.push_back(part.mesh);
        scatters.push_back(part.scattering >= 0);
        world.meshes.push_back({std::move(part.mesh), part.scattering});
    }
    world.looks.emplace_back();
    world.materials = std::move(materials);
    world.scatteringSphere = boundingSphere(everything, scatters);
    world.sceneSphere = boundingSphere(everything);
    return world;
}

inline Light directionalLight(glm::dvec3 direction, glm::dvec3 color = glm::dvec3(1)) {
    Light light;
    light.direction = glm::normalize(direction);
    light.color = color;
    return light;
}

inline Light pointLight(glm::dvec3 positionMm, glm::dvec3 color = glm::dvec3(1)) {
    Light light;
    light.kind = Light::Kind::Point;
    light.position = positionMm;
    light.color = color;
    return light;
}

/// Places chosen evenly over the scattering surface.
inline std::vector<ExitPoint> randomExitPoints(const World& world, int count, unsigned seed = 7) {
    std::vector<TrianglePoint> triangles;
    std::vector<double> areas;
    for (std::size_t m = 0; m < world.meshes.size(); ++m) {
        const Mesh& mesh = world.meshes[m].mesh;
        for (std::uint32_t t = 0; world.meshes[m].scattering >= 0 && t < mesh.triangleCount();
             ++t) {
            const glm::dvec3 p0(mesh.positions[mesh.indices[3 * t]]);
            const glm::dvec3 p1(mesh.positions[mesh.indices[3 * t + 1]]);
            const glm::dvec3 p2(mesh.positions[mesh.indices[3 * t + 2]]);
            triangles.push_back({static_cast<int>(m), t, 0, 0});
            areas.push_back(glm::length(glm::cross(p1 - p0, p2 - p0)));
        }
    }
    std::mt19937 random(seed);
    std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<ExitPoint> exits;
    for (int i = 0; i < count; ++i) {
        TrianglePoint place = triangles[choose(random)];
        const double s = std::sqrt(uniform(random));
        const double t = uniform(random);
        place.u = s * (1 - t);
        place.v = s * t;
        const SurfacePoint point = surfacePoint(world, place);
        exits.push_back({glm::vec3(point.positionMm), point.uv, point.material});
    }
    return exits;
}

} // namespace celadon::testing
