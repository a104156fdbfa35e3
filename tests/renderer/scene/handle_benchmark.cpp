#include "renderer/scene/handle_solver.h"

#include <benchmark/benchmark.h>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <numbers>

// What it costs to drag a handle of a bent tube, by its vertices:
//     build/release/tests/renderer/scene/handle_benchmark
namespace celadon {
namespace {

/// Along y from 0 to 100 mm, radius 10 mm with waves, so that clusters differ.
World tube(int around, int along) {
    Mesh mesh;
    for (int j = 0; j <= along; ++j) {
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / around;
            const double y = 100.0 * j / along;
            const double radius = 10.0 + 2.0 * std::sin(0.2 * y) * std::cos(3.0 * angle);
            mesh.positions.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
            mesh.normals.emplace_back(std::cos(angle), 0.0, std::sin(angle));
            mesh.uvs.emplace_back(0.0f, 0.0f);
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(j * around + i % around);
    };
    for (int j = 0; j < along; ++j) {
        for (int i = 0; i < around; ++i) {
            mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j),
                                                     at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    }
    World world;
    world.meshes.push_back({std::move(mesh), 0});
    const std::array<const Mesh*, 1> all{&world.meshes.front().mesh};
    world.sceneSphere = world.scatteringSphere = boundingSphere(all);
    return world;
}

void drag(benchmark::State& state) {
    const auto around = static_cast<int>(std::sqrt(static_cast<double>(state.range(0)) / 2.0));
    const World world = tube(around, 2 * around);
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
