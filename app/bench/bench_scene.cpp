#include "app/bench/bench_scene.h"

#include "app/bench/triangle_count.h"
#include "app/render_scene.h"
#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/models/normalized_diffusion.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace celadon::app {

namespace {

constexpr double kDiameterMm = 100.0;
constexpr int kSegments = 32;
constexpr int kRanges = 64; ///< different profiles of a map
constexpr std::array<double, 3> kChannelRange{1.0, 0.8, 0.65};

/// A few waves that do not repeat over the map, in [0, 1].
double smoothNoise(double u, double v) {
    const double tau = 2.0 * std::numbers::pi;
    const double sum = std::sin(tau * (3.0 * u + 1.7 * std::sin(tau * 2.0 * v))) +
                       std::sin(tau * (4.0 * v + 1.3 * std::sin(tau * 3.0 * u + 1.0))) +
                       0.5 * std::sin(tau * (9.0 * u - 7.0 * v));
    return std::clamp(0.5 + sum / 5.0, 0.0, 1.0);
}

/// Empty where the scene has none, or it is not there.
std::filesystem::path modelFile(const BenchScene& scene) {
    const char* const folder = std::getenv("CELADON_MODELS");
    if (folder == nullptr || scene.model.empty()) {
        return {};
    }
    std::filesystem::path file = std::filesystem::path(folder) / scene.model;
    return std::filesystem::exists(file) ? file : std::filesystem::path();
}

} // namespace

std::vector<BenchScene> benchScenes(const std::string& suite) {
    std::vector<BenchScene> scenes{{"dragon",
                                    "mesh/stanford_dragon_871k.ply",
                                    "vase",
                                    560'000,
                                    {110, 110},
                                    {0.12, 0.30},
                                    false,
                                    {2.8, 10, 14, 31},
                                    "twist:y:40"},
                                   {"buddha",
                                    "mesh/happy_buddha_100k.obj",
                                    "shell",
                                    100'000,
                                    {145, 275},
                                    {0.04, 0.15},
                                    false,
                                    {14, 22, 48, 57}},
                                   {"bunny",
                                    "mesh/stanford_bunny_69k_ascii.ply",
                                    "vase",
                                    70'000,
                                    {277, 277},
                                    {0.06, 0.25},
                                    true,
                                    {5.6, 14, 36, 66}},
                                   {"bird",
                                    "mesh/penguin_27k.obj",
                                    "sphere",
                                    54'000,
                                    {224, 214},
                                    {0.15, 0.30},
                                    false,
                                    {2.0, 16, 10, 60}},
                                   {"parent",
                                    "mesh/hand_16k.obj",
                                    "shell",
                                    30'000,
                                    {504, 504},
                                    {0.10, 0.20},
                                    false,
                                    {5.9, 12, 30, 49}},
                                   {"elephant",
                                    "mesh/armadillo_86k.obj",
                                    "vase",
                                    20'000,
                                    {212, 138},
                                    {0.08, 0.35},
                                    false,
                                    {3.7, 17, 19, 53}}};
    if (suite == "table1") {
        return scenes;
    }
    if (suite == "quick") {
        return {{"vase", "", "vase", 0, {128, 128}, {0.06, 0.25}, true, {}},
                {"sphere", "", "sphere", 0, {128, 128}, {0.10, 0.20}, false, {}}};
    }
    throw UsageError("--suite " + suite, "no such suite", "take quick or table1");
}

bool isModelMissing(const BenchScene& scene) {
    return !scene.model.empty() && modelFile(scene).empty();
}

std::string modelFolderMessage() {
    const char* const folder = std::getenv("CELADON_MODELS");
    return folder == nullptr
               ? "since CELADON_MODELS is not set: put it into a folder and name that"
               : fmt::format("below '{}', which CELADON_MODELS names: put it there", folder);
}

BenchWorld loadBenchWorld(const BenchScene& scene) {
    BenchWorld loaded;
    loaded.isStandIn = isModelMissing(scene);
    const std::filesystem::path file = modelFile(scene);
    loaded.model = file.empty() ? "builtin:" + scene.standIn : file.string();
    Scene model = readModel(loaded.model);
    if (scene.triangles > 0) {
        model = withTriangleCount(std::move(model), scene.triangles);
    }
    const std::vector<MaterialPointer> named(model.materials.size());
    WorldScale scale;
    scale.diameterMm = kDiameterMm;
    const MaterialPointer material = benchMaterial(scene, 0.5 * kDiameterMm);
    loaded.world = buildWorld(std::move(model), material, named, nullptr, scale);
    for (const WorldMesh& mesh : loaded.world.meshes) {
        loaded.triangles += mesh.mesh.triangleCount();
    }
    return loaded;
}

MaterialPointer benchMaterial(const BenchScene& scene, double boundingRadiusMm) {
    const double perShape = 1.0 / subedit::normalizedDiffusionRadius(0.95);
    auto map = std::make_shared<subedit::MaterialMap>();
    map->name = "bench " + scene.name;
    map->width = scene.mapSize.x;
    map->height = scene.mapSize.y;
    map->segments = kSegments;
    map->eta = static_cast<float>(kBenchEta);
    const auto longest =
        subedit::normalizedDiffusionCurve(1.0, scene.range.y * boundingRadiusMm * perShape);
    map->maxRadiusMm = static_cast<float>(subedit::radiusHolding(longest, 0.999));
    const std::size_t values = static_cast<std::size_t>(map->knots()) * 3;
    std::vector<float> profiles(kRanges * values);
    for (std::size_t i = 0; i < kRanges; ++i) {
        const double t = static_cast<double>(i) / (kRanges - 1);
        const double R_P = boundingRadiusMm * (scene.range.x + t * (scene.range.y - scene.range.x));
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<double> knots(static_cast<std::size_t>(map->knots()));
            subedit::fitChannel(
                subedit::normalizedDiffusionCurve(kBenchAlbedo[static_cast<int>(c)],
                                                  R_P * kChannelRange[c] * perShape),
                kSegments, static_cast<double>(map->maxRadiusMm), knots.data());
            for (std::size_t k = 0; k < knots.size(); ++k) {
                profiles[i * values + k * 3 + c] = static_cast<float>(knots[k]);
            }
        }
    }
    map->logProfile.reserve(static_cast<std::size_t>(map->width * map->height) * values);
    for (int y = 0; y < map->height; ++y) {
        for (int x = 0; x < map->width; ++x) {
            const double u = (x + 0.5) / map->width;
            const double v = (y + 0.5) / map->height;
            const double t = scene.hasCells
                                 ? static_cast<double>((int(u * 10.0) + int(v * 10.0)) % 2)
                                 : smoothNoise(u, v);
            const auto i = static_cast<std::ptrdiff_t>(std::lround(t * (kRanges - 1)));
            const auto from = profiles.begin() + i * static_cast<std::ptrdiff_t>(values);
            map->logProfile.insert(map->logProfile.end(), from,
                                   from + static_cast<std::ptrdiff_t>(values));
        }
    }
    return map;
}

} // namespace celadon::app
