#include "app/bench/table_report.h"

#include "app/plot/chart.h"
#include "app/render_options.h"

#include <fmt/format.h>

#include <numeric>

namespace celadon::app {

namespace {

double sumOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

BenchJson stagesJson(const StageMilliseconds& stages) {
    BenchJson json;
    json["deformation"] = number(stages.deformation);
    json["irradianceBuffer"] = number(stages.irradianceBuffer);
    json["splattingBuffer"] = number(stages.splattingBuffer);
    json["selection"] = number(stages.selection);
    for (const double ms : stages.splatting) {
        json["splatting"].push_back(number(ms));
    }
    json["accumulation"] = number(stages.accumulation);
    json["shading"] = number(stages.shading);
    json["total"] = number(stages.total);
    return json;
}

BenchJson errorJson(const BenchError& error) {
    return {{"relativeRmse", number(error.relativeRmse)}, {"meanRatio", number(error.meanRatio)}};
}

BenchJson methodJson(const SceneResult& scene, const MethodResult& method) {
    BenchJson json;
    json["method"] = method.method;
    json["backend"] = backendName(method.backend);
    json["milliseconds"] = {{"median", number(method.time.medianMs)},
                            {"least", number(method.time.leastMs)},
                            {"greatest", number(method.time.greatestMs)},
                            {"frames", method.time.frames}};
    json["framesPerSecond"] = number(1000.0 / method.time.medianMs);
    json["speedUp"] = number(speedUp(scene, method));
    json["paperSpeedUp"] = number(paperSpeedUp(scene.scene, method.method));
    json["pairs"] = method.pairs > 0 ? BenchJson(method.pairs) : BenchJson(nullptr);
    json["stages"] = stagesJson(method.time.stages);
    json["imageReference"] = errorJson(method.image);
    json["splattingError"] = errorJson(method.surface);
    json["flip"] = number(method.flip);
    return json;
}

BenchJson sceneJson(const SceneResult& scene) {
    BenchJson json;
    json["name"] = scene.scene.name;
    json["model"] = scene.model;
    json["standIn"] = scene.isStandIn;
    json["triangles"] = scene.triangles;
    json["mapSize"] = {scene.scene.mapSize.x, scene.scene.mapSize.y};
    json["rangeInBoundingRadii"] = {scene.scene.range.x, scene.scene.range.y};
    json["meanRadiusPx"] = number(scene.radiusPx);
    json["imageReferenceError"] = errorJson(scene.imageReference);
    for (const MethodResult& method : scene.methods) {
        json["methods"].push_back(methodJson(scene, method));
    }
    const glm::dvec3& length = scene.modelError.meanFreePathMm;
    json["modelError"] = {{"relativeRmse", number(scene.modelError.error.relativeRmse)},
                          {"meanRatio", number(scene.modelError.error.meanRatio)},
                          {"noise", number(scene.modelError.noise)},
                          {"meanFreePath", {length.x, length.y, length.z}}};
    return json;
}

/// Part of a frame in percent.
std::string share(double ms, const BenchTime& time) {
    return cell("{:.0f}", 100.0 * ms / time.stages.total);
}

std::string speedTable(const std::vector<SceneResult>& scenes) {
    std::string text =
        "| scene | triangles | method | backend | ms (least-greatest, frames) | speed-up | "
        "paper's | Mpairs | splatting error | mean ratio | against image-reference | FLIP |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const SceneResult& scene : scenes) {
        for (const MethodResult& m : scene.methods) {
            text += fmt::format(
                "| {}{} | {} | {} | {} | {} ({}-{}, {}) | {} | {} | {} | {} | {} | {} | {} |\n",
                scene.scene.name, scene.isStandIn ? " (stand-in)" : "", scene.triangles, m.method,
                backendName(m.backend), cell("{:.0f}", m.time.medianMs),
                cell("{:.0f}", m.time.leastMs), cell("{:.0f}", m.time.greatestMs), m.time.frames,
                cell("{:.1f}", speedUp(scene, m)),
                cell("{:.1f}", paperSpeedUp(scene.scene, m.method)),
                cell("{:.1f}", m.pairs > 0 ? 1e-6 * static_cast<double>(m.pairs) : kNotMeasured),
                cell("{:.2f} %", 100.0 * m.surface.relativeRmse),
                cell("{:.4f}", m.surface.meanRatio), cell("{:.2f} %", 100.0 * m.image.relativeRmse),
                cell("{:.4f}", m.flip));
        }
    }
    return text;
}

std::string shareTable(const std::vector<SceneResult>& scenes) {
    std::string text = "\nShares of a frame in percent (the paper's Table 2):\n\n"
                       "| scene | method | backend | deformation | irradiance buffer | splatting "
                       "buffer | selection | splatting | accumulation | shading |\n"
                       "|---|---|---|---|---|---|---|---|---|---|\n";
    for (const SceneResult& scene : scenes) {
        for (const MethodResult& m : scene.methods) {
            const StageMilliseconds& s = m.time.stages;
            text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
                                scene.scene.name, m.method, backendName(m.backend),
                                share(s.deformation, m.time), share(s.irradianceBuffer, m.time),
                                share(s.splattingBuffer, m.time), share(s.selection, m.time),
                                share(sumOf(s.splatting), m.time), share(s.accumulation, m.time),
                                share(s.shading, m.time));
        }
    }
    return text;
}

std::string modelTable(const std::vector<SceneResult>& scenes) {
    std::string text = "\nModel error: surface-reference with the profile of a homogeneous medium "
                       "against light traced in it, noise taken out:\n\n"
                       "| scene | mean free path | relative RMSE | mean ratio | noise |\n"
                       "|---|---|---|---|---|\n";
    for (const SceneResult& scene : scenes) {
        text += fmt::format("| {} | {:.3g} mm | {} | {} | {} |\n", scene.scene.name,
                            scene.modelError.meanFreePathMm.x,
                            cell("{:.1f} %", 100.0 * scene.modelError.error.relativeRmse),
                            cell("{:.3f}", scene.modelError.error.meanRatio),
                            cell("{:.1f} %", 100.0 * scene.modelError.noise));
    }
    return text;
}

plot::Drawing speedChart(const std::vector<SceneResult>& scenes, SplatBackendKind backend) {
    plot::BarChart chart;
    chart.title = fmt::format("Speed-up over no acceleration, {}", backendName(backend));
    chart.y.label = "times as fast";
    chart.y.isLogarithmic = true;
    chart.valueFormat = "{:.0f}";
    chart.series = {{"Chen et al. 2012, full", plot::seriesColor(0), {}},
                    {"paper's scheme here", plot::seriesColor(1), {}},
                    {"hierarchical", plot::seriesColor(2), {}},
                    {"hierarchical, draft", plot::seriesColor(3), {}}};
    const auto value = [&](const SceneResult& scene, const char* method) {
        const MethodResult* result = findMethod(scene, method, backend);
        return result != nullptr ? speedUp(scene, *result) : kNotMeasured;
    };
    for (const SceneResult& scene : scenes) {
        chart.groups.push_back(scene.scene.name);
        chart.series[0].values.push_back(paperSpeedUp(scene.scene, "paper"));
        chart.series[1].values.push_back(value(scene, "paper"));
        chart.series[2].values.push_back(value(scene, "hierarchical"));
        chart.series[3].values.push_back(value(scene, "draft"));
    }
    return plot::drawChart(chart);
}

/// One line a scene through its methods.
plot::Drawing tradeOffChart(const std::vector<SceneResult>& scenes, SplatBackendKind backend) {
    plot::LineChart chart;
    chart.title = fmt::format("Error against time, {}", backendName(backend));
    chart.x = {"ms a frame", true, {}, {}};
    chart.y = {"relative RMSE of exitance, %", true, {}, {}};
    std::size_t color = 0;
    for (const SceneResult& scene : scenes) {
        plot::Series points{scene.scene.name, {}, plot::seriesColor(color++)};
        points.hasDots = true;
        points.dash = {2.0, 4.0};
        for (const MethodResult& m : scene.methods) {
            if (m.backend == backend) {
                points.points.emplace_back(m.time.medianMs, 100.0 * m.image.relativeRmse);
            }
        }
        chart.series.push_back(points);
    }
    return plot::drawChart(chart);
}

} // namespace

BenchDocument tableDocument(const BenchMachine& machine, const TableOptions& options,
                            const std::vector<SceneResult>& scenes) {
    BenchDocument document;
    document.json = documentHead(options.suite, machine);
    document.json["size"] = {options.size.x, options.size.y};
    document.json["truthOnOneBlockIn"] = options.truthBlocks;
    document.json["scenes"] = BenchJson::array();
    for (const SceneResult& scene : scenes) {
        document.json["scenes"].push_back(sceneJson(scene));
    }
    document.markdown = fmt::format("{}x{}, {} ({}), {}\n\n", options.size.x, options.size.y,
                                    machine.renderer, machine.contextKind, machine.processor) +
                        speedTable(scenes) + shareTable(scenes);
    if (options.modelError) {
        document.markdown += modelTable(scenes);
    }
    for (const SplatBackendKind backend : options.backends) {
        const std::string ending = fmt::format("_{}.svg", backendName(backend));
        document.charts.emplace_back("speedup" + ending, speedChart(scenes, backend));
        document.charts.emplace_back("error_time" + ending, tradeOffChart(scenes, backend));
    }
    return document;
}

} // namespace celadon::app
