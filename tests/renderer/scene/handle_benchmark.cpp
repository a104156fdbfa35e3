#include "renderer/scene/handle_solver.h"
#include "tests/renderer/scene/tube_mesh.h"

#include <benchmark/benchmark.h>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>

// What it costs to drag a handle of a bent tube, by its vertices:
//     build/release/tests/renderer/scene/handle_benchmark
namespace celadon {
namespace {

/// The tests' tube with waves, so that clusters differ.
World wavyTube(int around, int along) {
    Mesh mesh = tube(around, along);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::vec3& p = mesh.positions[i];
        const double angle = std::atan2(p.z, p.x);
        p +=
            static_cast<float>(2.0 * std::sin(0.2 * p.y) * std::cos(3.0 * angle)) * mesh.normals[i];
    }
    World world;
    world.meshes.push_back({std::move(mesh), 0});
    const std::array<const Mesh*, 1> all{&world.meshes.front().mesh};
    world.sceneSphere = world.scatteringSphere = boundingSphere(all);
    return world;
}

void drag(benchmark::State& state) {
    const auto around = static_cast<int>(std::sqrt(static_cast<double>(state.range(0)) / 2.0));
    const World world = wavyTube(around, 2 * around);
    const std::vector<PlacedHandle> rest{{{0, 0, 0}, 14, {0, 0, 0}, glm::dmat3(1.0)},
                                         {{0, 100, 0}, 14, {0, 100, 0}, glm::dmat3(1.0)}};
    HandleSolver solver(world, rest);
    int frame = 0;
    for (auto _ : state) {
        std::vector<PlacedHandle> targets = rest;
        const double t = 0.1 * ++frame;
        targets[1].to += glm::dvec3(40.0 * std::sin(t), -20.0, 15.0 * std::cos(t));
        targets[1].turn = glm::mat3_cast(
            glm::angleAxis(-0.9 * std::sin(t), glm::normalize(glm::dvec3(0.2, 0.1, 1.0))));
        benchmark::DoNotOptimize(
            solver.solve(targets, state.range(1) != 0 ? Settling::Preview : Settling::Full));
    }
    state.counters["nodes"] = static_cast<double>(solver.effort().nodes);
    state.counters["iterations"] = solver.effort().iterations;
    state.counters["msPerIteration"] = solver.effort().msPerIteration;
}
BENCHMARK(drag)
    ->ArgNames({"vertices", "preview"})
    ->ArgsProduct({{2000, 5000, 16000, 190000}, {0, 1}})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace
} // namespace celadon

BENCHMARK_MAIN();
