#include "app/bench/figures_suite.h"

#include "app/bench/table_suite.h"
#include "app/log.h"
#include "app/render_options.h"
#include "renderer/frame_quality.h"
#include "renderer/output/image_compare.h"
#include "subedit/map/material_bake.h"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace celadon::app {

namespace {

constexpr float kWhiteError = 0.2f;

/// A frame of a row, with what it is.
struct Panel {
    std::string name;
    FloatImage frame;
    double ms = kNotMeasured;
};

class Figures {
public:
    Figures(const gl::Context& context, const FiguresOptions& options)
        : mContext(context), mOptions(options) {
        mDocument.json = documentHead("figures", describeMachine(context));
        mDocument.json["size"] = {options.size.x, options.size.y};
        mDocument.json["backend"] = backendName(options.backend);
        mDocument.json["figures"] = BenchJson::array();
        mDocument.markdown = "| figure | panel | ms | relative RMSE | mean ratio | FLIP |\n"
                             "|---|---|---|---|---|---|\n";
    }

    void drawFigure4(const BenchScene& scene) {
        const World world = loadBenchWorld(scene).world;
        addRow("figure4_" + scene.name,
               {surfaceTruth(world), measured(world, "hierarchical", ours()),
                measured(world, "final", named("final")),
                measured(world, "paper", named("paper"))});
    }

    void drawFigure5(const BenchScene& scene) {
        const World world = loadBenchWorld(scene).world;
        FrameSettings noDiscontinuity = named("paper");
        noDiscontinuity.splatting.discontinuity = kNoLimit;
        FrameSettings noOrientation = named("paper");
        noOrientation.splatting.orientation = false;
        addRow("figure5_" + scene.name,
               {imageTruth(world), measured(world, "both terms", named("paper")),
                measured(world, "no discontinuity test", noDiscontinuity),
                measured(world, "no orientation term", noOrientation)});
    }

    /// Shah, Konttinen, Pattanaik 2009 as the paper extends it: every texel of a light view of one
    /// resolution is a sample, every sample splats to its range at full resolution. Two things
    /// favor it here: samples are patches, not points, and end where their own profile does.
    void drawFigure6(const BenchScene& scene) {
        const World world = loadBenchWorld(scene).world;
        Panel truth = imageTruth(world);
        const Panel ours = measured(world, "hierarchical", this->ours());
        const double wanted = exitanceError(ours.frame, truth.frame).relativeRmse;
        Panel equalTime{"equal time", {}, kNotMeasured};
        Panel equalQuality{"equal quality", {}, kNotMeasured};
        BenchJson rates = BenchJson::array();
        for (const int size : {24, 32, 48, 64, 96, 128, 192, 256, 384, 512}) {
            Panel panel = measured(world, fmt::format("one rate, {}^2", size), oneRate(size));
            const double error = exitanceError(panel.frame, truth.frame).relativeRmse;
            rates.push_back({{"size", size},
                             {"milliseconds", number(panel.ms)},
                             {"relativeRmse", number(error)}});
            log::info("{}: {} {:.0f} ms, {:.2f} %", scene.name, panel.name, panel.ms,
                      100.0 * error);
            if (panel.ms <= ours.ms || equalTime.frame.pixels.empty()) {
                equalTime = panel;
                equalTime.name = "equal time, " + panel.name;
            }
            if (error <= wanted || size == 512) {
                equalQuality = panel;
                equalQuality.name =
                    (error <= wanted ? "equal quality, " : "best quality, ") + panel.name;
                break;
            }
        }
        addRow("figure6_" + scene.name, {std::move(truth), ours, equalTime, equalQuality});
        mDocument.json["figures"].back()["rates"] = rates;
    }

    /// Half of a plate scatters far, half near. With one material a point's light is P of the
    /// viewed point alone, so a plate all of that material shows what such a model draws there.
    void drawSlab() {
        const MaterialPointer both = halves(true, true);
        const std::array<MaterialPointer, 2> alone{halves(true, false), halves(false, true)};
        const World world = plateWorld(both);
        Panel truth = imageTruth(world);
        const Panel ours = measured(world, "hierarchical, sqrt(P P)", this->ours());
        const BenchView view = benchView(world, mOptions.size);
        std::array<FloatImage, 2> parts;
        for (std::size_t i = 0; i < 2; ++i) {
            parts[i] =
                renderFrame(mContext, plateWorld(alone[i]),
                            referenceSettings(SolverKind::ImageReference), mOptions.size, view);
        }
        Panel viewedOnly{"viewed point's profile only", parts[0], kNotMeasured};
        const int u = parts[0].channelIndex("uv.X");
        for (int y = 0; y < parts[0].height; ++y) {
            for (int x = 0; x < parts[0].width; ++x) {
                const FloatImage& part = parts[parts[0].at(x, y, u) < 0.5f ? 0 : 1];
                for (int c = 0; c < static_cast<int>(part.channelCount()); ++c) {
                    viewedOnly.frame.at(x, y, c) = part.at(x, y, c);
                }
            }
        }
        addRow("slab", {std::move(truth), ours, viewedOnly});
    }

    [[nodiscard]] BenchDocument take() { return std::move(mDocument); }

private:
    static constexpr double kNoLimit = 1e6;
    const gl::Context& mContext;
    const FiguresOptions& mOptions;
    BenchDocument mDocument;

    [[nodiscard]] static FrameSettings named(const std::string& name) {
        for (const BenchMethod& method : benchMethods()) {
            if (method.name == name) {
                return method.settings;
            }
        }
        return {};
    }
    [[nodiscard]] static FrameSettings ours() { return frameSettings(Quality::Default); }

    [[nodiscard]] static FrameSettings oneRate(int size) {
        FrameSettings settings = named("none");
        settings.splatting.fixIrradianceSize(size);
        settings.splatting.energy = 1.0; // to r_s, or no rate would reach our error
        return settings;
    }

    [[nodiscard]] Panel reference(const World& world, SolverKind solver, const char* name) const {
        log::info("{}", name);
        return {name, renderFrame(mContext, world, referenceSettings(solver), mOptions.size,
                                  benchView(world, mOptions.size))};
    }
    [[nodiscard]] Panel imageTruth(const World& world) const {
        return reference(world, SolverKind::ImageReference, "image-reference");
    }
    [[nodiscard]] Panel surfaceTruth(const World& world) const {
        return reference(world, SolverKind::SurfaceReference, "surface-reference");
    }

    [[nodiscard]] Panel measured(const World& world, const std::string& name,
                                 FrameSettings settings) const {
        settings.splatting.backend = mOptions.backend;
        MeasuredFrame frame = measureFrames(mContext, world, settings, mOptions.size,
                                            benchView(world, mOptions.size), mOptions.budget);
        return {name, std::move(frame.image), frame.time.medianMs};
    }

    /// The first panel is truth.
    void addRow(const std::string& name, const std::vector<Panel>& panels) {
        BenchJson figure{{"name", name}, {"picture", name + ".png"}};
        std::vector<const FloatImage*> frames;
        const FloatImage& truth = panels.front().frame;
        for (const Panel& panel : panels) {
            frames.push_back(&panel.frame);
            const BenchError error = exitanceError(panel.frame, truth);
            const double flip = flipOf(panel.frame, truth);
            figure["panels"].push_back({{"name", panel.name},
                                        {"milliseconds", number(panel.ms)},
                                        {"relativeRmse", number(error.relativeRmse)},
                                        {"meanRatio", number(error.meanRatio)},
                                        {"flip", number(flip)}});
            mDocument.markdown +=
                fmt::format("| {} | {} | {} | {} | {} | {} |\n", name, panel.name,
                            cell("{:.0f}", panel.ms), cell("{:.2f} %", 100.0 * error.relativeRmse),
                            cell("{:.4f}", error.meanRatio), cell("{:.4f}", flip));
        }
        mDocument.json["figures"].push_back(figure);
        mDocument.pictures.emplace_back(name + ".png", pictureRow(frames, kWhiteError));
    }

    /// A map whose halves are the far (pale) and the near (dark) material, or all one of them.
    [[nodiscard]] static MaterialPointer halves(bool hasFar, bool hasNear) {
        subedit::AppearanceMap map;
        map.name = "two materials";
        map.width = 256; // the step between the halves is a 256th of the plate
        map.height = 1;
        map.eta = static_cast<float>(kBenchEta);
        for (int x = 0; x < map.width; ++x) {
            const bool isFar = hasFar && (x < map.width / 2 || !hasNear);
            map.albedo.push_back(isFar ? glm::vec3(0.9f, 0.85f, 0.75f)
                                       : glm::vec3(0.5f, 0.3f, 0.2f));
            map.effectiveRadius.push_back(isFar ? glm::vec3(12.0f, 10.0f, 8.0f)
                                                : glm::vec3(3.0f, 2.5f, 2.0f));
        }
        // One r_s for all, or the maps would store the same profile differently.
        constexpr double kReachMm = 40.0;
        return std::make_shared<subedit::MaterialMap>(bakeAppearance(map, {64, kReachMm, 0.999}));
    }

    [[nodiscard]] static World plateWorld(const MaterialPointer& material) {
        constexpr int kCells = 16;
        constexpr glm::vec2 kSizeMm(60.0f, 45.0f);
        Scene scene;
        scene.materials.emplace_back();
        Mesh& mesh = scene.meshes.emplace_back();
        for (int j = 0; j <= kCells; ++j) {
            for (int i = 0; i <= kCells; ++i) {
                const glm::vec2 uv(float(i) / kCells, float(j) / kCells);
                const glm::vec2 p = kSizeMm * (uv - 0.5f);
                mesh.positions.emplace_back(p.x, -p.y, 0.0f); // v goes down
                mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
                mesh.uvs.push_back(uv);
            }
        }
        for (std::uint32_t j = 0; j < kCells; ++j) {
            for (std::uint32_t i = 0; i < kCells; ++i) {
                const std::uint32_t a = j * (kCells + 1) + i;
                const std::uint32_t below = a + kCells + 1;
                mesh.indices.insert(mesh.indices.end(), {a, below, below + 1, a, below + 1, a + 1});
            }
        }
        WorldScale scale;
        scale.millimetersPerUnit = 1.0;
        return buildWorld(std::move(scene), material, {nullptr}, nullptr, scale);
    }
};

} // namespace

BenchDocument runFigures(const gl::Context& context, const std::vector<BenchScene>& scenes,
                         const FiguresOptions& options) {
    Figures figures(context, options);
    for (const BenchScene& scene : scenes) {
        figures.drawFigure4(scene);
    }
    figures.drawFigure5(scenes.size() > 1 ? scenes[1] : scenes[0]);
    figures.drawFigure6(scenes[0]);
    figures.drawSlab();
    return figures.take();
}

} // namespace celadon::app
