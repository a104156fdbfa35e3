#include "renderer/scene/handle_ground.h"
#include "renderer/scene/handle_solver.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/rigid_solver.h"
#include "renderer/scene/surface_graph.h"
#include "subedit/errors.h"
#include "tests/renderer/scene/tube_mesh.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace celadon {
namespace {

World worldOf(std::vector<Mesh> meshes) {
    World world;
    std::vector<const Mesh*> all;
    for (Mesh& mesh : meshes) {
        world.meshes.push_back({std::move(mesh), 0});
    }
    for (const WorldMesh& part : world.meshes) {
        all.push_back(&part.mesh);
    }
    world.sceneSphere = world.scatteringSphere = boundingSphere(all);
    return world;
}

/// Every corner with a vertex of its own, as files without an index have them.
Mesh unwelded(const Mesh& mesh) {
    Mesh result;
    for (const std::uint32_t i : mesh.indices) {
        result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
        result.positions.push_back(mesh.positions[i]);
        result.normals.push_back(mesh.normals[i]);
        result.uvs.push_back(mesh.uvs[i]);
    }
    return result;
}

SurfaceGraph graphOf(const Mesh& mesh) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        triangles.push_back({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]});
    }
    return makeGraph({mesh.positions.begin(), mesh.positions.end()}, std::move(triangles));
}

glm::dmat3 turnAbout(const glm::dvec3& axis, double degrees) {
    return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), glm::normalize(axis)));
}

PlacedHandle handle(const glm::dvec3& at, double radius, const glm::dvec3& move = glm::dvec3(0.0),
                    const glm::dmat3& turn = glm::dmat3(1.0)) {
    return {at, radius, at + move, turn};
}

std::vector<Mapped> moved(const NodePose& pose, std::size_t mesh = 0) {
    std::vector<Mapped> result;
    for (const VertexNodes& vertex : pose.binding->vertices[mesh]) {
        result.push_back(followNodes(vertex, pose));
    }
    return result;
}

struct Held {
    std::vector<std::uint32_t> points;
    std::vector<HeldPoint> targets;
};

/// The tube's ends: the lower one stays, the upper one is turned about its middle, which goes
/// there.
Held bentTube(const std::vector<glm::dvec3>& points, const glm::dmat3& turn, const glm::dvec3& to) {
    Held held;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (points[i].y < 1.0) {
            held.points.push_back(i);
            held.targets.push_back({points[i], glm::dmat3(1.0)});
        } else if (points[i].y > 99.0) {
            held.points.push_back(i);
            held.targets.push_back({turn * (points[i] - glm::dvec3(0, 100, 0)) + to, turn});
        }
    }
    return held;
}

TEST(SurfaceGraph, ClustersCoverTheSurfaceAndKeepItConnected) {
    const Mesh mesh = tube(40, 100);
    const SurfaceGraph graph = graphOf(mesh);
    const std::vector<glm::dvec3>& points = graph.points;
    const Clusters clusters = clusterSurface(graph, 200);
    EXPECT_GT(clusters.chosen.size(), 130u);
    EXPECT_LT(clusters.chosen.size(), 300u);
    const auto parts = components(clusters.graph);
    EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 0u);
    EXPECT_GT(clusters.graph.triangles.size(), clusters.chosen.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_LT(clusters.clusterOf[i], clusters.chosen.size());
        // Nearest along the surface: not farther than the spacing, some 7 mm and the detour of
        // edges.
        EXPECT_LT(glm::length(points[i] - clusters.graph.points[clusters.clusterOf[i]]), 9.0);
    }
}

TEST(RigidSolver, RigidMovesAreKeptExactly) {
    const World world = worldOf({tube(20, 30)});
    const std::vector<PlacedHandle> rest{handle({0, 0, 0}, 15), handle({0, 100, 0}, 15)};
    HandleSolver solver(world, rest);
    const glm::dmat3 turn = turnAbout({1, 2, -1}, 140.0);
    std::vector<PlacedHandle> targets = rest;
    for (PlacedHandle& target : targets) {
        target.to = turn * target.at + glm::dvec3(5, -60, 30);
        target.turn = turn;
    }
    const auto pose = solver.solve(targets);
    const std::vector<Mapped> vertices = moved(*pose);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec3 expected =
            turn * glm::dvec3(world.meshes[0].mesh.positions[i]) + glm::dvec3(5, -60, 30);
        EXPECT_LT(glm::length(vertices[i].position - expected), 1e-5) << i;
    }
}

TEST(RigidSolver, NoIterationRaisesTheEnergyAndHandlesStayWhereTheyAreTold) {
    const Mesh mesh = tube(16, 40);
    const SurfaceGraph graph = graphOf(mesh);
    const std::vector<glm::dvec3>& points = graph.points;
    const auto [held, targets] = bentTube(points, turnAbout({0, 0, 1}, 90.0), {-60, 60, 0});
    RigidSolver solver(graph, held);
    solver.setTargets(targets);
    solver.iterate();
    double energy = solver.energy();
    const double first = energy;
    for (int k = 0; k < 60; ++k) {
        solver.iterate();
        EXPECT_LE(solver.energy(), energy * (1.0 + 1e-12)) << k;
        energy = solver.energy();
    }
    EXPECT_LT(energy, 0.3 * first);
    for (std::size_t k = 0; k < held.size(); ++k) {
        EXPECT_EQ(solver.positions()[held[k]], targets[k].to);
    }
    // A bent tube keeps its girth: the ring half way is still about 20 mm wide.
    const std::size_t middle = 20 * 16;
    EXPECT_NEAR(glm::length(solver.positions()[middle] - solver.positions()[middle + 8]), 20.0,
                3.0);
}

TEST(HandleSolver, PartsThatShareNoVertexAreWeldedWhereTheyTouch) {
    const std::vector<PlacedHandle> rest{handle({0, 0, 0}, 12), handle({0, 100, 0}, 12)};
    std::vector<PlacedHandle> targets = rest;
    targets[1].to += glm::dvec3(30, -10, 0);
    const World welded = worldOf({tube(12, 20)});
    const World apart = worldOf({unwelded(tube(12, 20))});
    HandleSolver first(welded, rest);
    HandleSolver second(apart, rest);
    EXPECT_EQ(first.effort().vertices, second.effort().vertices);
    EXPECT_THAT(second.warnings(), testing::IsEmpty());
    const auto a = moved(*first.solve(targets));
    const auto b = moved(*second.solve(targets));
    const std::vector<std::uint32_t>& indices = welded.meshes[0].mesh.indices;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        EXPECT_LT(glm::length(a[indices[i]].position - b[i].position), 1e-6);
    }
}

TEST(HandleSolver, PartsWithoutAHandleAreCarriedAlongWithAWarning) {
    Mesh lonely = tube(8, 4, {0, 95, 40});
    lonely.positions.emplace_back(7.0f, 7.0f, 7.0f); // of no triangle
    lonely.normals.emplace_back(0.0f, 1.0f, 0.0f);
    const World world = worldOf({tube(12, 20), lonely});
    const std::vector<PlacedHandle> rest{handle({0, 0, 0}, 12), handle({0, 100, 0}, 12)};
    HandleSolver solver(world, rest);
    ASSERT_EQ(solver.warnings().size(), 2u);
    EXPECT_THAT(solver.warnings()[0], testing::HasSubstr("1 of the model's 2 separate parts"));
    EXPECT_THAT(solver.warnings()[1], testing::HasSubstr("1 vertices belong to no triangle"));
    std::vector<PlacedHandle> targets = rest;
    targets[1].to += glm::dvec3(0, 0, 30);
    const auto pose = solver.solve(targets);
    const auto vertices = moved(*pose, 1);
    EXPECT_NEAR(vertices[0].position.z - double(lonely.positions[0].z), 30.0, 1.0);
    EXPECT_EQ(vertices.back().position, glm::dvec3(7.0));
}

TEST(HandleSolver, HandlesWithoutAVertexOfTheirOwnAreRefused) {
    const World world = worldOf({tube(12, 20)});
    try {
        HandleSolver(world, {handle({0, 0, 0}, 500), handle({0, 100, 0}, 1)});
        ADD_FAILURE() << "was taken";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("handle 1"));
        EXPECT_THAT(error.what(), testing::HasSubstr("handle 0 holds the nearest"));
    }
    World empty = worldOf({tube(12, 20)});
    for (glm::vec3& p : empty.meshes[0].mesh.positions) {
        p = glm::vec3(1.0f);
    }
    EXPECT_THROW(HandleSolver(empty, {handle({0, 0, 0}, 5)}), InputError);
}

// What takes long is made once, for all who move a world and however many handles they have.
TEST(HandleSolver, ShareWhatTheyKnowOfTheShapeAtRest) {
    World world = worldOf({tube(24, 40)});
    const std::vector<PlacedHandle> one{handle({0, 0, 0}, 14)};
    const std::vector<PlacedHandle> two{handle({0, 0, 0}, 14), handle({0, 100, 0}, 14)};
    const auto alone = moved(*HandleSolver(world, two).solve(two));
    world.handleGround = std::make_shared<HandleGround>();
    const auto first = HandleSolver(world, one).solve(one);
    const auto second = HandleSolver(world, two).solve(two);
    EXPECT_EQ(first->binding, second->binding);
    const auto shared = moved(*second);
    for (std::size_t i = 0; i < shared.size(); ++i) {
        EXPECT_EQ(shared[i].position, alone[i].position);
    }
    // Another component is held: other nodes.
    World parts = worldOf({tube(24, 40), tube(24, 40)});
    for (glm::vec3& p : parts.meshes[1].mesh.positions) {
        p.x += 300.0f;
    }
    parts.handleGround = std::make_shared<HandleGround>();
    const std::vector<PlacedHandle> other{handle({300, 0, 0}, 14)};
    EXPECT_NE(HandleSolver(parts, one).solve(one)->binding,
              HandleSolver(parts, other).solve(other)->binding);
    EXPECT_FALSE(HandleSolver(parts, one).warnings().empty());
}

// Above kMostNodes a few points carry the rest: what they make of it is as smooth as the shape, its
// normals are those of the moved surface, and it is near what all vertices would have made.
TEST(HandleSolver, LargeModelsFollowAProxySmoothly) {
    const World large = worldOf({tube(100, 210)});
    const World small = worldOf({tube(50, 105)}); // every second vertex
    const std::vector<PlacedHandle> rest{handle({0, 0, 0}, 14), handle({0, 100, 0}, 14)};
    std::vector<PlacedHandle> targets = rest;
    targets[1].to += glm::dvec3(50, -25, 0);
    targets[1].turn = turnAbout({0, 0, 1}, -60.0);
    HandleSolver proxy(large, rest);
    HandleSolver whole(small, rest);
    EXPECT_GT(proxy.effort().vertices, kMostNodes);
    EXPECT_LT(proxy.effort().nodes, 2 * kClusterNodes);
    EXPECT_EQ(whole.effort().nodes, whole.effort().vertices);
    const auto a = moved(*proxy.solve(targets));
    const auto b = moved(*whole.solve(targets));
    const Mesh& mesh = large.meshes[0].mesh;
    double farthest = 0.0;
    for (std::size_t j = 0; j <= 105; ++j) {
        for (std::size_t i = 0; i < 50; ++i) {
            farthest = std::max(
                farthest, glm::length(a[2 * j * 100 + 2 * i].position - b[j * 50 + i].position));
        }
    }
    EXPECT_LT(farthest,
              2.5); // mm of 100: another triangulation, and neither has settled to the last
    double worst = 0.0;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t j = 30; j <= 180;
         ++j) { // not at the handles' edges, where the surface creases
        for (std::size_t i = 0; i < 100; ++i) {
            const auto p = [&](std::size_t di, std::size_t dj) {
                return a[(j + dj - 1) * 100 + (i + 99 + di) % 100].position;
            };
            const glm::dvec3 seen =
                glm::normalize(glm::cross(p(1, 2) - p(1, 0), p(2, 1) - p(0, 1)));
            const std::size_t v = j * 100 + i;
            const glm::dvec3 carried =
                glm::normalize(cofactors(a[v].jacobian) * glm::dvec3(mesh.normals[v]));
            const double angle = glm::degrees(std::acos(std::min(1.0, glm::dot(seen, carried))));
            worst = std::max(worst, angle);
            sum += angle;
            ++count;
        }
    }
    // The step of the difference is as long as nodes are apart, so that their trace is all in it.
    EXPECT_LT(worst, 9.0);
    EXPECT_LT(sum / double(count), 1.2);
}

// Guessing ahead finds what many plain steps find, in fewer.
TEST(RigidSolver, SettlesWherePlainStepsDo) {
    const Mesh mesh = tube(16, 40);
    const SurfaceGraph graph = graphOf(mesh);
    const std::vector<glm::dvec3>& points = graph.points;
    const auto [held, targets] = bentTube(points, turnAbout({0, 0, 1}, 50.0), {-30, 80, 0});
    RigidSolver plain(graph, held);
    plain.setTargets(targets);
    plain.startFromHeld();
    int steps = 1;
    while (plain.iterate() > 1e-7) {
        ++steps;
    }
    RigidSolver ahead(graph, held);
    ahead.setTargets(targets);
    ahead.startFromHeld();
    const int guessed = ahead.settle(1e-7, 10000);
    EXPECT_LT(guessed, steps / 3) << steps;
    EXPECT_LE(ahead.energy(), plain.energy() * (1.0 + 1e-6));
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LT(glm::length(ahead.positions()[i] - plain.positions()[i]), 1e-3) << i;
    }
}

TEST(HandleSolver, APreviewIsNearWhatSettles) {
    const World world = worldOf({tube(24, 120)});
    const std::vector<PlacedHandle> rest{handle({0, 0, 0}, 14), handle({0, 100, 0}, 14)};
    std::vector<PlacedHandle> targets = rest;
    targets[1].to += glm::dvec3(50, -25, 0);
    targets[1].turn = turnAbout({0, 0, 1}, -60.0);
    HandleSolver solver(world, rest);
    const auto preview = moved(*solver.solve(targets, Settling::Preview));
    const int few = solver.effort().iterations;
    const auto settled = moved(*solver.solve(targets));
    EXPECT_LT(few, solver.effort().iterations);
    // Long waves settle last: a part of the way of the handle is left to them.
    const double way = glm::length(targets[1].to - rest[1].to);
    for (std::size_t i = 0; i < settled.size(); ++i) {
        EXPECT_LT(glm::length(preview[i].position - settled[i].position), 0.15 * way) << i;
    }
}

TEST(HandleSolver, APoseDoesNotDependOnTheOnesBefore) {
    const World world = worldOf({tube(24, 60)});
    const std::vector<PlacedHandle> rest{handle({0, 0, 0}, 14), handle({0, 100, 0}, 14)};
    const auto at = [&](double x) {
        std::vector<PlacedHandle> targets = rest;
        targets[1].to += glm::dvec3(x, 0, 0);
        return targets;
    };
    HandleSolver one(world, rest);
    HandleSolver other(world, rest);
    static_cast<void>(one.solve(at(-70.0)));
    static_cast<void>(one.solve(at(20.0)));
    const auto a = moved(*one.solve(at(40.0)));
    const auto b = moved(*other.solve(at(40.0)));
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
    }
}

TEST(NodeBlend, TheJacobianIsTheDerivativeOfWhereAVertexGoes) {
    const auto binding = std::make_shared<NodeBinding>();
    NodePose pose{binding, {}};
    for (int n = 0; n < 5; ++n) {
        const double t = 1.3 * n;
        binding->places.emplace_back(3.0 * std::cos(t), 2.0 * std::sin(2.0 * t), n * 0.7);
        pose.nodes.push_back({binding->places.back() + glm::dvec3(std::sin(t), t, 1.0),
                              turnAbout({1, t, 0.3}, 20.0 * t)});
    }
    VertexNodes vertex;
    vertex.at = {0.4f, 0.3f, 0.9f};
    std::copy_n(std::array{0u, 1u, 2u, 3u, 4u}.begin(), 5, vertex.nodes.begin());
    const double h = 1.0 / 1024.0; // exact in float
    for (int c = 0; c < 3; ++c) {
        VertexNodes before = vertex;
        VertexNodes after = vertex;
        before.at[c] -= static_cast<float>(h);
        after.at[c] += static_cast<float>(h);
        const double width = double(after.at[c]) - double(before.at[c]);
        const glm::dvec3 slope =
            (followNodes(after, pose).position - followNodes(before, pose).position) / width;
        EXPECT_LT(glm::length(slope - followNodes(vertex, pose).jacobian[c]), 1e-4) << c;
    }
}

} // namespace
} // namespace celadon
