#include "renderer/output/frame_stats.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace celadon {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template<typename Range>
Json numbers(const Range& values) {
    Json list = Json::array();
    for (const double value : values) {
        list.push_back(number(value));
    }
    return list;
}

Json millisecondsJson(const StageMilliseconds& ms) {
    return Json{{"deformation", number(ms.deformation)},
                {"irradianceBuffer", number(ms.irradianceBuffer)},
                {"splattingBuffer", number(ms.splattingBuffer)},
                {"selection", number(ms.selection)},
                {"splatting", numbers(ms.splatting)},
                {"accumulation", number(ms.accumulation)},
                {"shading", number(ms.shading)},
                {"total", number(ms.total)}};
}

Json frameJson(const FrameStats& frame) {
    Json json;
    json["frame"] = frame.frame;
    json["milliseconds"] = millisecondsJson(frame.milliseconds);
    json["samples"] = Json{{"candidates", frame.samples.candidates},
                           {"selected", Json(frame.samples.selected)},
                           {"pairs", frame.samples.pairs}};
    json["flux"] =
        Json{{"lit", numbers(frame.flux.lit)}, {"selected", numbers(frame.flux.selected)}};
    json["effectiveRadius"] = Json{{"min", number(frame.effectiveRadius.minMm)},
                                   {"mean", number(frame.effectiveRadius.meanMm)},
                                   {"max", number(frame.effectiveRadius.maxMm)},
                                   {"pixels", number(frame.effectiveRadius.meanPixels)}};
    if (std::isfinite(frame.reference.relativeError)) {
        json["reference"] = Json{{"relativeError", number(frame.reference.relativeError)},
                                 {"paths", frame.reference.paths},
                                 {"lostFlux", number(frame.reference.lostFlux)}};
    }
    return json;
}

} // namespace

std::string toJson(const RenderStats& stats) {
    Json json;
    json["context"] = Json{{"kind", stats.contextKind},
                           {"renderer", stats.contextRenderer},
                           {"version", stats.contextVersion}};
    json["solver"] = stats.solver;
    json["scheme"] = stats.scheme;
    json["backend"] = stats.backend;
    json["size"] = Json::array({stats.width, stats.height});
    json["irradianceSize"] = stats.irradianceSize;
    if (stats.irradianceLevels == stats.splattingLevels) {
        json["levels"] = stats.irradianceLevels;
    } else {
        json["levels"] = Json::array({stats.irradianceLevels, stats.splattingLevels});
    }
    json["millimetresPerUnit"] = number(stats.millimetersPerUnit);
    json["frames"] = Json::array();
    for (const FrameStats& frame : stats.frames) {
        json["frames"].push_back(frameJson(frame));
    }
    // Driver strings are not always UTF-8: replaced rather than refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace celadon
