#include "app/bench/turntable_suite.h"

#include "app/bench/table_suite.h"
#include "app/log.h"
#include "app/plot/chart.h"
#include "renderer/frame_quality.h"
#include "renderer/output/flicker.h"
#include "renderer/output/tone_map.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::app {

namespace {

/// What moves from one frame to the next.
enum class Mover { Light, Camera };

BenchView moved(BenchView view, Mover mover, double degrees) {
    if (mover == Mover::Light) {
        return withTurnedLight(std::move(view), degrees);
    }
    const double c = std::cos(glm::radians(degrees));
    const double s = std::sin(glm::radians(degrees));
    const glm::dvec3 d = view.camera.eye - view.camera.at;
    view.camera.eye = view.camera.at + glm::dvec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
    return view;
}

/// Two frames of one solver, the pixels that truth has.
struct Pair {
    FloatImage before, after;
};

struct Row {
    std::string method;
    Mover mover;
    double degrees;
    Flicker image, surface;
};

class Turntable {
public:
    Turntable(const gl::Context& context, const BenchScene& scene, const TurntableOptions& options)
        : mContext(context),
          mOptions(options),
          mWorld(loadBenchWorld(scene).world),
          mView(benchView(mWorld, options.size)) {}

    /// Draft, default and final at one place of the light.
    [[nodiscard]] std::vector<Row> rowsAt(double degrees, Mover mover) const {
        const BenchView before = withTurnedLight(mView, degrees);
        const BenchView after = moved(before, mover, mOptions.stepDegrees);
        const auto pairOf = [&](const FrameSettings& settings) {
            return Pair{pixelsOf(settings, before), pixelsOf(settings, after)};
        };
        const Pair image =
            pairOf(referenceSettings(SolverKind::ImageReference, mOptions.truthBlocks));
        Pair surface;
        if (mOptions.surfaceTruth) {
            surface = pairOf(referenceSettings(SolverKind::SurfaceReference, mOptions.truthBlocks));
        }
        std::vector<Row> rows;
        for (const BenchMethod& method : benchMethods()) {
            if (method.settings.splatting.scheme != Scheme::Hierarchical &&
                method.name != "paper") {
                continue;
            }
            const Pair judged = pairOf(method.settings);
            Row row{method.name,
                    mover,
                    degrees,
                    measureFlicker({judged.before, judged.after}, {image.before, image.after}),
                    {kNotMeasured, kNotMeasured}};
            if (mOptions.surfaceTruth) {
                row.surface =
                    measureFlicker({judged.before, judged.after}, {surface.before, surface.after});
            }
            rows.push_back(row);
        }
        return rows;
    }

    [[nodiscard]] FloatImage pictureAt(double degrees) const {
        DisplaySettings display;
        display.background = glm::vec3(0.0f);
        return toDisplay(renderFrame(mContext, mWorld, frameSettings(Quality::Default),
                                     mOptions.size, withTurnedLight(mView, degrees)),
                         display);
    }

private:
    const gl::Context& mContext;
    const TurntableOptions& mOptions;
    World mWorld;
    BenchView mView;

    [[nodiscard]] FloatImage pixelsOf(const FrameSettings& settings, const BenchView& view) const {
        return referencePixels(renderFrame(mContext, mWorld, settings, mOptions.size, view),
                               mOptions.truthBlocks);
    }
};

const char* moverName(Mover mover) {
    return mover == Mover::Light ? "light" : "camera";
}

BenchJson flickerJson(const Flicker& flicker) {
    return {{"trueChange", number(flicker.trueChange)},
            {"beyondTruth", number(flicker.beyondTruth)}};
}

std::string percent(double value) {
    return cell("{:.2f} %", 100.0 * value);
}

} // namespace

BenchDocument runTurntable(const gl::Context& context, const std::vector<BenchScene>& scenes,
                           const TurntableOptions& options) {
    BenchDocument document;
    document.json = documentHead("turntable", describeMachine(context));
    document.json["size"] = {options.size.x, options.size.y};
    document.json["stepDegrees"] = options.stepDegrees;
    document.json["scenes"] = BenchJson::array();
    document.markdown =
        fmt::format("Change beyond truth when the light or the camera turns by {:g} degrees:\n\n"
                    "| scene | moves | method | at | true change | beyond image-reference | "
                    "beyond surface-reference |\n|---|---|---|---|---|---|---|\n",
                    options.stepDegrees);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const Turntable turntable(context, scenes[i], options);
        BenchJson entry;
        entry["name"] = scenes[i].name;
        for (const Mover mover : {Mover::Light, Mover::Camera}) {
            for (int place = 0; place < options.places; ++place) {
                const double degrees = 360.0 * place / options.places;
                log::info("{}: {} at {:g} degrees", scenes[i].name, moverName(mover), degrees);
                for (const Row& row : turntable.rowsAt(degrees, mover)) {
                    entry["flicker"].push_back({{"moves", moverName(mover)},
                                                {"degrees", degrees},
                                                {"method", row.method},
                                                {"imageReference", flickerJson(row.image)},
                                                {"surfaceReference", flickerJson(row.surface)}});
                    document.markdown += fmt::format(
                        "| {} | {} | {} | {:g} | {} | {} | {} |\n", scenes[i].name,
                        moverName(mover), row.method, degrees, percent(row.image.trueChange),
                        percent(row.image.beyondTruth), percent(row.surface.beyondTruth));
                }
            }
        }
        document.json["scenes"].push_back(entry);
        for (int frame = 0; i == 0 && options.pictures && frame < options.frames; ++frame) {
            document.pictures.emplace_back(fmt::format("turntable_{:03}.png", frame),
                                           turntable.pictureAt(360.0 * frame / options.frames));
        }
    }
    return document;
}

} // namespace celadon::app
