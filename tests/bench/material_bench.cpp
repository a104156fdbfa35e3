// What a user waits for with large materials: their tables, and their files.
//
//     build/release/tests/bench/material_bench
//
// Asked for: tables of 512 x 512 texels of 24 segments under 200 ms on two cores; 1024 x 1024 x 24
// read and written in seconds.
#include "subedit/map/material_bake.h"
#include "subedit/map/material_convert.h"
#include "subedit/map/material_file.h"
#include "subedit/map/medium_bake.h"
#include "subedit/mean_profile.h"
#include "subedit/models/random_walk.h"
#include "subedit/presets.h"
#include "subedit/radius_map.h"
#include "subedit/range_table.h"
#include "subedit/recipes/recipes.h"
#include "tests/support/temporary_folder.h"

#include <benchmark/benchmark.h>

#include <map>

namespace celadon::subedit {
namespace {

/// Veined marble of `size` texels a side, made once: a small one is enlarged, which is quicker.
const MaterialMap& veinedMarble(int size) {
    static std::map<int, MaterialMap> made;
    const auto [at, isNew] = made.try_emplace(size);
    if (isNew) {
        at->second = convertMaterial(findRecipe("veined_marble").bake(128, {.segments = 24}),
                                     {.width = size, .height = size});
    }
    return at->second;
}

void effectiveRadii(benchmark::State& state) {
    const MaterialMap& map = veinedMarble(static_cast<int>(state.range(0)));
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(effectiveRadiusMap(map));
    }
}
BENCHMARK(effectiveRadii)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime();

/// R_P map, mean profile and minimal radii: all that is recomputed when a material is new.
void fullTables(benchmark::State& state) {
    const MaterialMap& map = veinedMarble(static_cast<int>(state.range(0)));
    for ([[maybe_unused]] auto _ : state) {
        const std::vector<float> radii = effectiveRadiusMap(map);
        benchmark::DoNotOptimize(RangeTable::build(meanProfile(map, radii), 0.01));
    }
}
BENCHMARK(fullTables)->Arg(512)->Arg(1024)->Unit(benchmark::kMillisecond)->UseRealTime();

void writeFile(benchmark::State& state, StoredPrecision precision) {
    const MaterialMap& map = veinedMarble(static_cast<int>(state.range(0)));
    const celadon::test::TemporaryFolder folder;
    for ([[maybe_unused]] auto _ : state) {
        writeMaterial(map, folder / "m.subedit.exr", precision);
    }
    state.counters["MB"] =
        static_cast<double>(std::filesystem::file_size(folder / "m.subedit.exr")) / 1e6;
}
BENCHMARK_CAPTURE(writeFile, half, StoredPrecision::Half)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void readFile(benchmark::State& state, StoredPrecision precision) {
    const MaterialMap& map = veinedMarble(static_cast<int>(state.range(0)));
    const celadon::test::TemporaryFolder folder;
    writeMaterial(map, folder / "m.subedit.exr", precision);
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(readMaterial(folder / "m.subedit.exr"));
    }
}
BENCHMARK_CAPTURE(readFile, half, StoredPrecision::Half)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void bakeCoefficients(benchmark::State& state) {
    const Medium& skin = findMediumPreset("skin1");
    MediumMap media;
    media.width = media.height = static_cast<int>(state.range(0));
    for (int i = 0; i < media.width * media.height; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(media.width * media.height);
        media.absorption.push_back(glm::vec3(skin.absorption) * (0.2f + 2.0f * t));
        media.reducedScattering.emplace_back(skin.reducedScattering);
    }
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(bakeMedia(media));
    }
}
BENCHMARK(bakeCoefficients)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime();

void randomWalk(benchmark::State& state) {
    const Medium& skin = findMediumPreset("skin1");
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(simulateRandomWalk(skin, {state.range(0), 1}));
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(randomWalk)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace celadon::subedit
