#include "app/bench/scaling_suite.h"

#include "app/bench/bench_scene.h"
#include "app/bench/table_suite.h"
#include "app/log.h"
#include "app/plot/chart.h"
#include "app/render_options.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

namespace celadon::app {

namespace {

/// Each triangle in four, on its own plane; normals and texture coordinates linear.
Mesh subdivided(const Mesh& mesh) {
    Mesh fine = mesh;
    fine.indices.clear();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, isNew] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(fine.positions.size()));
        if (isNew) {
            fine.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
            fine.normals.push_back(glm::normalize(mesh.normals[a] + mesh.normals[b]));
            fine.uvs.push_back(0.5f * (mesh.uvs[a] + mesh.uvs[b]));
        }
        return place->second;
    };
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const std::array corners{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
        const std::array halves{middle(corners[0], corners[1]), middle(corners[1], corners[2]),
                                middle(corners[2], corners[0])};
        for (std::size_t i = 0; i < 3; ++i) {
            fine.indices.insert(fine.indices.end(), {corners[i], halves[i], halves[(i + 2) % 3]});
        }
        fine.indices.insert(fine.indices.end(), halves.begin(), halves.end());
    }
    return fine;
}

/// One frame to measure: how large the varied quantity is, and what to render.
struct Case {
    double amount;
    World world;
    glm::ivec2 size;
    int irradianceSize;
};

struct Variation {
    std::string name, unit;
    std::vector<Case> cases;
};

constexpr int kIrradianceSize = 512;
constexpr glm::dvec2 kRange(0.05, 0.10);

World worldOfRange(double factor) {
    BenchScene scene{"vase", "", "vase", 0, {128, 128}, kRange * factor, true, {}, {}};
    return loadBenchWorld(scene).world;
}

double triangleCount(const World& world) {
    std::size_t count = 0;
    for (const WorldMesh& mesh : world.meshes) {
        count += mesh.mesh.triangleCount();
    }
    return static_cast<double>(count);
}

std::vector<Variation> variations(glm::ivec2 size) {
    std::vector<Variation> all{{"range", "greatest Rₚ, bounding radii", {}},
                               {"pixels", "pixels of the picture", {}},
                               {"texels", "texels of the light view", {}},
                               {"triangles", "triangles", {}}};
    for (const double factor : {1.0, 2.0, 4.0}) {
        all[0].cases.push_back({kRange.y * factor, worldOfRange(factor), size, kIrradianceSize});
    }
    const World usual = worldOfRange(2.0);
    for (const int part : {2, 1}) {
        const glm::ivec2 s = size / part;
        all[1].cases.push_back({double(s.x) * s.y, usual, s, kIrradianceSize});
    }
    all[1].cases.push_back({4.0 * size.x * size.y, usual, 2 * size, kIrradianceSize});
    for (const int texels : {256, 512, 1024}) {
        all[2].cases.push_back({double(texels) * texels, usual, size, texels});
    }
    World world = usual;
    for (int i = 0; i < 3; ++i) {
        all[3].cases.push_back({triangleCount(world), world, size, kIrradianceSize});
        for (WorldMesh& mesh : world.meshes) {
            mesh.mesh = subdivided(mesh.mesh);
        }
    }
    return all;
}

struct Growth {
    std::string method;
    std::vector<glm::dvec2> ms, pairs; ///< over the varied quantity
};

plot::Drawing chartOf(const Variation& variation, const std::vector<Growth>& growths) {
    plot::LineChart chart;
    chart.title = fmt::format("Time over {}", variation.name);
    chart.x = {variation.unit, true, {}, {}};
    chart.y = {"ms a frame", true, {}, {}};
    chart.legend = plot::Legend::TopLeft;
    std::size_t color = 0;
    for (const Growth& growth : growths) {
        plot::Series series{
            fmt::format("{}, exponent {:.2f}", growth.method, growthExponent(growth.ms)), growth.ms,
            plot::seriesColor(color++)};
        series.hasDots = true;
        chart.series.push_back(series);
    }
    return plot::drawChart(chart);
}

} // namespace

double growthExponent(const std::vector<glm::dvec2>& points) {
    double n = 0.0;
    glm::dvec2 sum(0.0);
    double xx = 0.0;
    double xy = 0.0;
    for (const glm::dvec2& point : points) {
        if (point.x > 0.0 && point.y > 0.0) {
            const glm::dvec2 l(std::log(point.x), std::log(point.y));
            n += 1.0;
            sum += l;
            xx += l.x * l.x;
            xy += l.x * l.y;
        }
    }
    const double spread = n * xx - sum.x * sum.x;
    return n >= 2.0 && spread > 0.0 ? (n * xy - sum.x * sum.y) / spread : kNotMeasured;
}

BenchDocument runScaling(const gl::Context& context, const ScalingOptions& options) {
    BenchDocument document;
    document.json = documentHead("scaling", describeMachine(context));
    document.json["backend"] = backendName(options.backend);
    document.json["variations"] = BenchJson::array();
    document.markdown = "Cost grows as the varied quantity to the power of the exponent:\n\n"
                        "| varied | method | values | ms | exponent of time | exponent of pairs |\n"
                        "|---|---|---|---|---|---|\n";
    for (const Variation& variation : variations(options.size)) {
        BenchJson entry{{"varied", variation.name}, {"unit", variation.unit}};
        std::vector<Growth> growths;
        for (BenchMethod method : benchMethods()) {
            if (method.name != "none" && method.name != "paper" && method.name != "hierarchical") {
                continue;
            }
            Growth growth{method.name, {}, {}};
            std::string amounts;
            std::string times;
            for (const Case& c : variation.cases) {
                log::info("{} {:g}: {}", variation.name, c.amount, method.name);
                method.settings.splatting.fixIrradianceSize(c.irradianceSize);
                method.settings.splatting.backend = options.backend;
                const MeasuredFrame frame =
                    measureFrames(context, c.world, method.settings, c.size,
                                  benchView(c.world, c.size), options.budget);
                growth.ms.emplace_back(c.amount, frame.time.medianMs);
                growth.pairs.emplace_back(c.amount, static_cast<double>(frame.pairs));
                amounts += fmt::format("{}{:g}", amounts.empty() ? "" : ", ", c.amount);
                times += fmt::format("{}{:.0f}", times.empty() ? "" : ", ", frame.time.medianMs);
                entry["frames"].push_back({{"method", method.name},
                                           {"amount", c.amount},
                                           {"milliseconds", number(frame.time.medianMs)},
                                           {"pairs", frame.pairs}});
            }
            entry["exponents"][method.name] = {{"time", number(growthExponent(growth.ms))},
                                               {"pairs", number(growthExponent(growth.pairs))}};
            document.markdown +=
                fmt::format("| {} | {} | {} | {} | {} | {} |\n", variation.name, method.name,
                            amounts, times, cell("{:.2f}", growthExponent(growth.ms)),
                            cell("{:.2f}", growthExponent(growth.pairs)));
            growths.push_back(std::move(growth));
        }
        document.charts.emplace_back(fmt::format("scaling_{}.svg", variation.name),
                                     chartOf(variation, growths));
        document.json["variations"].push_back(entry);
    }
    return document;
}

} // namespace celadon::app
