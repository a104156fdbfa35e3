#include "app/bench/bench_report.h"

#include "app/plot/chart.h"
#include "app/plot/write_plot.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

namespace celadon::app {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

const MethodResult* find(const SceneResult& scene, const std::string& method) {
    for (const MethodResult& result : scene.methods) {
        if (result.method == method) {
            return &result;
        }
    }
    return nullptr;
}

double timeOf(const SceneResult& scene, const std::string& method) {
    const MethodResult* result = find(scene, method);
    return result != nullptr ? result->time.medianMs : kNotMeasured;
}

/// Times as fast as with no acceleration.
double speedUp(const SceneResult& scene, const std::string& method) {
    return timeOf(scene, "none") / timeOf(scene, method);
}

double paperSpeedUp(const SceneResult& scene) {
    const auto& fps = scene.scene.paperFps;
    return fps[0] > 0.0 ? fps[3] / fps[0] : kNotMeasured;
}

Json stagesOf(const StageMilliseconds& stages) {
    Json json;
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

Json errorsOf(const BenchError& error) {
    return {{"relativeRmse", number(error.relativeRmse)}, {"meanRatio", number(error.meanRatio)}};
}

/// A cell of the table, "-" where nothing was measured.
std::string cell(const char* format, double value) {
    return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

} // namespace

std::string describeProcessor() {
    std::string name = "unknown processor";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) {
            name = line.substr(line.find(':') + 2);
            break;
        }
    }
    return fmt::format("{}, {} threads", name, std::thread::hardware_concurrency());
}

std::string toJson(const BenchReport& report) {
    Json json;
    json["suite"] = report.options.suite;
    json["context"] = {
        {"kind", report.contextKind}, {"renderer", report.renderer}, {"version", report.version}};
    json["processor"] = report.processor;
    json["size"] = {report.options.size.x, report.options.size.y};
    json["truthSize"] = {report.options.truthSize.x, report.options.truthSize.y};
    json["scenes"] = Json::array();
    for (const SceneResult& scene : report.scenes) {
        Json entry;
        entry["name"] = scene.scene.name;
        entry["model"] = scene.model;
        entry["standIn"] = scene.isStandIn;
        entry["triangles"] = scene.triangles;
        entry["mapSize"] = {scene.scene.mapSize.x, scene.scene.mapSize.y};
        entry["rangeInBoundingRadii"] = {scene.scene.range.x, scene.scene.range.y};
        entry["paperSpeedUp"] = number(paperSpeedUp(scene));
        for (const MethodResult& method : scene.methods) {
            Json m;
            m["method"] = method.method;
            m["milliseconds"] = {{"median", number(method.time.medianMs)},
                                 {"least", number(method.time.leastMs)},
                                 {"greatest", number(method.time.greatestMs)},
                                 {"frames", method.time.frames}};
            m["framesPerSecond"] = number(1000.0 / method.time.medianMs);
            m["speedUp"] = number(speedUp(scene, method.method));
            m["pairs"] = method.time.pairs > 0 ? Json(method.time.pairs) : Json(nullptr);
            m["stages"] = stagesOf(method.time.stages);
            m["imageReference"] = errorsOf(method.image);
            m["surfaceReference"] = errorsOf(method.surface);
            m["flip"] = number(method.flip);
            entry["methods"].push_back(m);
        }
        json["scenes"].push_back(entry);
    }
    return json.dump(2) + "\n";
}

std::string toMarkdown(const BenchReport& report) {
    std::string text = fmt::format("{}x{}, {} ({}), {}\n\n"
                                   "| scene | triangles | method | ms | speed-up | paper's | "
                                   "relative RMSE | mean ratio | FLIP |\n"
                                   "|---|---|---|---|---|---|---|---|---|\n",
                                   report.options.size.x, report.options.size.y, report.renderer,
                                   report.contextKind, report.processor);
    for (const SceneResult& scene : report.scenes) {
        const auto& fps = scene.scene.paperFps;
        for (const MethodResult& method : scene.methods) {
            const std::size_t column = method.method == "multires"   ? 1
                                       : method.method == "adaptive" ? 2
                                       : method.method == "none"     ? 0
                                                                     : 3;
            text += fmt::format(
                "| {}{} | {} | {} | {} | {} | {} | {} | {} | {} |\n", scene.scene.name,
                scene.isStandIn ? " (stand-in)" : "", scene.triangles, method.method,
                cell("{:.0f}", method.time.medianMs), cell("{:.1f}", speedUp(scene, method.method)),
                cell("{:.1f}", fps[0] > 0.0 ? fps[column] / fps[0] : kNotMeasured),
                cell("{:.2f} %", 100.0 * method.image.relativeRmse),
                cell("{:.4f}", method.image.meanRatio), cell("{:.4f}", method.flip));
        }
    }
    return text;
}

void writePlots(const BenchReport& report, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw OutputError(folder.string(), error.message(), "name a folder that can be written");
    }
    plot::BarChart speed;
    speed.title = "Speed-up over no acceleration";
    speed.y.label = "times as fast";
    speed.y.isLogarithmic = true;
    speed.valueFormat = "{:.0f}";
    speed.series = {{"Chen et al. 2012, full", plot::seriesColor(0), {}},
                    {"paper's scheme here", plot::seriesColor(1), {}},
                    {"hierarchical", plot::seriesColor(2), {}},
                    {"hierarchical, draft", plot::seriesColor(3), {}}};
    plot::LineChart tradeOff;
    tradeOff.title = "Error against time";
    tradeOff.x = {"ms a frame", true, {}, {}};
    tradeOff.y = {"relative RMSE of exitance, %", true, {}, {}};
    std::size_t color = 0;
    for (const SceneResult& scene : report.scenes) {
        speed.groups.push_back(scene.scene.name);
        speed.series[0].values.push_back(paperSpeedUp(scene));
        speed.series[1].values.push_back(speedUp(scene, "paper"));
        speed.series[2].values.push_back(speedUp(scene, "hierarchical"));
        speed.series[3].values.push_back(speedUp(scene, "draft"));
        plot::Series points{scene.scene.name, {}, plot::seriesColor(color++)};
        points.hasDots = true;
        points.dash = {2.0, 4.0};
        for (const MethodResult& method : scene.methods) {
            points.points.emplace_back(method.time.medianMs, 100.0 * method.image.relativeRmse);
        }
        tradeOff.series.push_back(points);
    }
    plot::writePlot(folder / "speedup.svg", plot::drawChart(speed));
    plot::writePlot(folder / "error_time.svg", plot::drawChart(tradeOff));
}

} // namespace celadon::app
