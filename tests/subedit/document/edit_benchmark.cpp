#include "subedit/document/document.h"
#include "subedit/document/edit_tables.h"
#include "subedit/map/material_bake.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>

// What painting costs on a map of 1024 x 1024 texels and 24 segments, and tables made anew:
//     build/release/tests/subedit/document/edit_benchmark
namespace celadon::subedit {
namespace {

constexpr int kSize = 1024;

MaterialMap materialOf(int size) {
    AppearanceMap appearance;
    appearance.width = appearance.height = size;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float wave =
                std::sin(0.05f * static_cast<float>(x)) * std::cos(0.03f * static_cast<float>(y));
            appearance.albedo.emplace_back(0.8f + 0.1f * wave, 0.6f, 0.5f - 0.2f * wave);
            appearance.effectiveRadius.emplace_back(6.0f + 2.0f * wave, 4.0f, 2.0f + wave);
        }
    }
    BakeSettings settings;
    settings.segments = 24;
    settings.maxRadiusMm = 40.0;
    return bakeAppearance(appearance, settings);
}

const MaterialMap& material() {
    static const MaterialMap map = materialOf(kSize);
    return map;
}

/// 1 mm a texel.
std::shared_ptr<const Surface> surface() {
    static const auto flat = std::make_shared<const Surface>(makeFlatSurface(kSize, kSize, kSize));
    return flat;
}

StrokePoint at(float x, float y) {
    return {{x, -y, 0.0f}, {0.0f, 0.0f, 1.0f}, {}, 1.0f};
}

EditOperator operatorOf(int index) {
    switch (index) {
    case 0:
        return ScaleAlbedo{{0.9f, 0.95f, 0.9f}};
    case 1:
        return ScaleRange{{0.8f, 0.9f, 1.1f}};
    default: {
        const float* p = material().logProfile.data() + material().index(100, 100, 0);
        return Mix{{24, material().maxRadiusMm, std::vector<float>(p, p + 75)}, 0.5f};
    }
    }
}

/// One dab of as many texels as 64 x 64 has: the map, R_P, and the tables, as a frame needs them.
void dab(benchmark::State& state) {
    Document document(material(), surface());
    EditTables tables(document.material());
    static_cast<void>(document.takeChanges());
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(100.0f, 900.0f);
    std::size_t texels = 0;
    for (auto _ : state) {
        state.PauseTiming();
        document.beginStroke({operatorOf(static_cast<int>(state.range(0))),
                              {.radiusMm = 36.1f, .hardness = 0.5f},
                              {},
                              {}});
        const StrokePoint point = at(place(random), place(random));
        state.ResumeTiming();
        document.addStrokePoint(point);
        tables.update(document.material(), document.takeChanges().rects);
        if (state.range(1) != 0) {
            benchmark::DoNotOptimize(tables.rangeTable().values().data());
        }
        state.PauseTiming();
        texels = document.endStroke().texels;
        state.ResumeTiming();
    }
    state.counters["texels"] = static_cast<double>(texels);
}
BENCHMARK(dab)
    ->ArgNames({"operator", "rangeTable"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}})
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// All tables of a map just opened, as large on a side as the argument says.
void tablesAnew(benchmark::State& state) {
    const MaterialMap map = materialOf(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        EditTables tables(map);
        benchmark::DoNotOptimize(tables.rangeTable().values().data());
    }
}
BENCHMARK(tablesAnew)
    ->Arg(512)
    ->Arg(1024)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Of the process so far, or now, MB.
double memoryMb(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(field)) {
            return std::stod(line.substr(line.find_first_of("0123456789"))) / 1024.0;
        }
    }
    return 0.0;
}

/// 1,000 strokes of 1 % of the map each, all undone, all done again.
void thousandStrokes(benchmark::State& state) {
    constexpr int kStrokes = 1000;
    for (auto _ : state) {
        const double before = memoryMb("VmRSS");
        Document document(material(), surface());
        std::mt19937 random(2);
        std::uniform_real_distribution<float> place(80.0f, 860.0f);
        using Clock = std::chrono::steady_clock;
        const auto seconds = [](Clock::time_point since) {
            return std::chrono::duration<double>(Clock::now() - since).count();
        };
        auto start = Clock::now();
        std::size_t texels = 0;
        for (int i = 0; i < kStrokes; ++i) {
            const float x = place(random);
            const float y = place(random);
            const Brush brush{.radiusMm = 30.0f, .flow = 0.5f};
            texels += document
                          .execute(StrokeCommand{
                              operatorOf(i % 3), brush, {}, {at(x, y), at(x + 130.0f, y)}})
                          .texels;
        }
        state.counters["strokeMs"] = seconds(start) * 1e3 / kStrokes;
        state.counters["texelsPerStroke"] = static_cast<double>(texels) / kStrokes;
        state.counters["historyMB"] = static_cast<double>(document.historyBytes()) / 1048576.0;
        state.counters["documentMB"] = memoryMb("VmRSS") - before; // map and history
        double slowest = 0.0;
        start = Clock::now();
        while (document.canUndo()) {
            const auto one = Clock::now();
            document.undo();
            slowest = std::max(slowest, seconds(one));
        }
        state.counters["undoMs"] = seconds(start) * 1e3 / kStrokes;
        state.counters["slowestUndoMs"] = slowest * 1e3;
        if (document.material().logProfile != material().logProfile) {
            state.SkipWithError("undo did not give back the bytes");
        }
        start = Clock::now();
        while (document.redo()) {
        }
        state.counters["redoMs"] = seconds(start) * 1e3 / kStrokes;
        state.counters["peakProcessMB"] = memoryMb("VmHWM"); // the material as opened included
    }
}
BENCHMARK(thousandStrokes)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

} // namespace
} // namespace celadon::subedit

BENCHMARK_MAIN();
