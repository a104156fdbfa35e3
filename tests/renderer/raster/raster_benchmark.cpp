#include "tests/renderer/raster/waves.h"

#include <benchmark/benchmark.h>

#include <array>

// What it costs to find what each pixel of 800x600 sees, by triangles and samples a pixel:
//     build/release/tests/renderer/raster/raster_benchmark
namespace celadon {
namespace {

void draw(benchmark::State& state) {
    const test::Waves waves(
        static_cast<std::uint32_t>(std::sqrt(static_cast<double>(state.range(0)) / 2.0)));
    const std::array meshes{waves.mesh()};
    const std::array places{glm::vec2(-0.125f, -0.375f), glm::vec2(0.375f, -0.125f),
                            glm::vec2(-0.375f, 0.125f), glm::vec2(0.125f, 0.375f)};
    RasterView view;
    view.size = {800, 600};
    view.toClip[0][0] = 0.6f;
    view.toClip[1][1] = 0.8f;
    view.toClip[2][2] = 0.5f;
    view.toClip[3][2] = 0.5f;
    if (state.range(1) != 0) {
        view.places = places;
    }
    TriangleRaster raster;
    for (auto _ : state) {
        raster.draw(meshes, view);
        benchmark::DoNotOptimize(raster.depths().data());
    }
    state.counters["nsPerTriangle"] = benchmark::Counter(
        static_cast<double>(state.range(0)) * 1e-9,
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(draw)
    ->ArgNames({"triangles", "places"})
    ->ArgsProduct({{2, 70'000, 560'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace
} // namespace celadon

BENCHMARK_MAIN();
