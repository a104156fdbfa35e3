#include "app/core/core_bench.h"

#include "renderer/frame_quality.h"
#include "renderer/frame_renderer.h"
#include "renderer/output/image_compare.h"
#include "renderer/scene/builtin.h"
#include "renderer/scene/light.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/recipes/recipes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace celadon::core {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 kTruthSize(160, 120);
constexpr double kTurnRadians = 0.005; ///< of the light, from frame to frame

struct Method {
    const char* name;
    FrameSettings settings;
};

std::vector<Method> methods() {
    FrameSettings paper;
    paper.splatting.scheme = Scheme::Paper;
    return {{"hierarchical", frameSettings(Quality::Default)},
            {"draft", frameSettings(Quality::Draft)},
            {"paper", paper}};
}

struct Backend {
    const char* name;
    SplatBackendKind kind;
};

/// Raster first: the others are compared with it.
std::vector<Backend> backends(const gl::Context& context) {
    std::vector<Backend> all{{"raster", SplatBackendKind::Raster},
                             {"tiled", SplatBackendKind::Tiled}};
    if (context.isSoftware()) {
        all.push_back({"cpu", SplatBackendKind::Cpu});
    }
    return all;
}

World makeWorld(const std::string& model, const std::string& material) {
    const subedit::Recipe& recipe = subedit::findRecipe(material);
    subedit::BakeSettings settings;
    settings.segments = recipe.segments;
    const auto map =
        std::make_shared<const subedit::MaterialMap>(recipe.bake(recipe.size, settings));
    WorldScale scale;
    scale.diameterMm = 100.0;
    Scene scene = makeBuiltin(model);
    const std::vector<MaterialPointer> named(scene.materials.size());
    return buildWorld(std::move(scene), map, named, nullptr, scale);
}

Light lightAt(double turn) {
    Light light;
    light.direction = glm::normalize(glm::dvec3(-0.4 * std::cos(turn) + 0.77 * std::sin(turn), -0.5,
                                                -0.77 * std::cos(turn) - 0.4 * std::sin(turn)));
    return light;
}

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json stagesOf(const StageMilliseconds& stages) {
    Json json{{"irradianceBuffer", number(stages.irradianceBuffer)},
              {"splattingBuffer", number(stages.splattingBuffer)},
              {"selection", number(stages.selection)},
              {"splatting", Json::array()},
              {"accumulation", number(stages.accumulation)},
              {"shading", number(stages.shading)},
              {"total", number(stages.total)}};
    for (const double ms : stages.splatting) {
        json["splatting"].push_back(number(ms));
    }
    return json;
}

/// Portable float map: little endian, rows from the bottom. Premultiplied linear radiance.
void writePfm(const std::filesystem::path& file, const FloatImage& image) {
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
    for (int y = image.height - 1; y >= 0; --y) {
        for (int x = 0; x < image.width; ++x) {
            std::array<float, 3> rgb{image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
            bytes.append(reinterpret_cast<const char*>(rgb.data()), sizeof(rgb));
        }
    }
    writeFileAtomically(file, std::string_view(bytes));
}

ValueErrors exitanceErrors(const FloatImage& image, const FloatImage& expected) {
    return compareValues(extractLayer(image, "exitance"), extractLayer(expected, "exitance"));
}

Json errorsOf(const ValueErrors& errors) {
    return {{"relativeRmse", number(errors.relativeRmse)}, {"meanRatio", number(errors.meanRatio)}};
}

/// Frames as a window would draw them: the light turns, nothing is read back.
double millisecondsPerFrame(FrameRenderer& renderer, const Camera& camera, int frames) {
    const auto draw = [&](int i) {
        static_cast<void>(renderer.draw(camera, std::array{lightAt(kTurnRadians * i)}, nullptr));
    };
    draw(0); // warms up
    glFinish();
    const Clock::time_point begin = Clock::now();
    for (int i = 1; i <= frames; ++i) {
        draw(i);
    }
    glFinish();
    static_cast<void>(renderer.takeTimes());
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count() / frames;
}

/// One backend at one method, size and world; its frame is compared with that of raster.
Json measure(FrameRenderer& renderer, const Camera& camera, int repeats, FloatImage& raster,
             RenderedFrame& last) {
    std::vector<StageMilliseconds> times;
    for (int i = 0; i < repeats; ++i) {
        last = renderer.render(camera, std::array{lightAt(0.0)});
        times.push_back(last.stats.milliseconds);
    }
    std::ranges::sort(times, {}, &StageMilliseconds::total);
    const StageMilliseconds& median = times[times.size() / 2];
    double splatting = median.selection;
    for (const double ms : median.splatting) {
        splatting += ms;
    }
    Json json{{"milliseconds",
               {{"median", median.total},
                {"least", times.front().total},
                {"greatest", times.back().total},
                {"wallPerFrame", number(millisecondsPerFrame(renderer, camera, 4 * repeats))}}},
              {"stages", stagesOf(median)},
              {"pairs", last.stats.samples.pairs},
              {"pairsPerSecond",
               number(static_cast<double>(last.stats.samples.pairs) / (1e-3 * splatting))},
              {"selected", last.stats.samples.selected}};
    if (raster.pixels.empty()) {
        raster = last.image;
    } else {
        json["againstRaster"] = errorsOf(exitanceErrors(last.image, raster));
    }
    return json;
}

} // namespace

std::string runBench(const gl::Context& context, const BenchRequest& request) {
    if (request.pictures) {
        std::error_code error;
        std::filesystem::create_directories(*request.pictures, error);
        if (error) {
            throw OutputError(request.pictures->string(), error.message(),
                              "name a folder that can be written");
        }
    }
    Json json{{"program", "celadon-core"},
              {"context",
               {{"kind", gl::contextKindName(context.kind())},
                {"renderer", context.renderer()},
                {"version", context.version()},
                {"software", context.isSoftware()}}},
              {"runs", Json::array()}};
    for (const std::string& model : request.models) {
        for (const std::string& material : request.materials) {
            const World world = makeWorld(model, material);
            for (const Method& method : methods()) {
                FloatImage truth;
                for (const glm::ivec2 size : request.sizes) {
                    FloatImage raster;
                    for (const Backend& backend : backends(context)) {
                        FrameSettings settings = method.settings;
                        settings.size = size;
                        settings.layers = true;
                        settings.statistics = true;
                        settings.splatting.backend = backend.kind;
                        if (request.irradianceSize) {
                            settings.splatting.fixIrradianceSize(*request.irradianceSize);
                        }
                        const Camera camera =
                            chooseCamera(world, {}, static_cast<double>(size.x) / size.y);
                        FrameRenderer renderer(context, world, settings);
                        RenderedFrame frame;
                        Json run{{"model", model},
                                 {"material", material},
                                 {"method", method.name},
                                 {"backend", backend.name},
                                 {"size", {size.x, size.y}}};
                        run.update(measure(renderer, camera, request.repeats, raster, frame));
                        if (request.truth) {
                            settings.size = kTruthSize;
                            settings.statistics = false;
                            const auto render = [&] {
                                return FrameRenderer(context, world, settings)
                                    .render(chooseCamera(world, {}, 4.0 / 3.0),
                                            std::array{lightAt(0.0)})
                                    .image;
                            };
                            const FloatImage image = render();
                            if (truth.pixels.empty()) {
                                settings.solver = SolverKind::ImageReference;
                                truth = render();
                            }
                            run["imageReference"] = errorsOf(exitanceErrors(image, truth));
                        }
                        if (request.pictures) {
                            writePfm(*request.pictures / fmt::format("{}_{}_{}_{}_{}x{}.pfm", model,
                                                                     material, method.name,
                                                                     backend.name, size.x, size.y),
                                     frame.image);
                        }
                        json["runs"].push_back(std::move(run));
                    }
                }
            }
        }
    }
    return json.dump(2) + "\n";
}

} // namespace celadon::core
