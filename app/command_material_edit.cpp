#include "app/command_material_edit.h"

#include "app/log.h"
#include "app/option_takers.h"
#include "app/profile/profile_output.h"
#include "app/progress.h"
#include "app/render_scene.h"
#include "renderer/scene/surface_atlas_of_world.h"
#include "subedit/document/document.h"
#include "subedit/document/stroke_file.h"
#include "subedit/errors.h"
#include "subedit/map/material_convert.h"
#include "subedit/map/material_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace celadon::app {

namespace {

using namespace subedit;

struct EditOptions {
    std::string material;
    std::string strokes;
    std::string model;
    std::optional<double> millimetersPerUnit;
    std::optional<double> diameterMm;
    int size = 0;
    bool storeFloat = false;
    bool json = false;
    std::string output;
};

/// The texel of a material at a texture coordinate, as a profile of its own.
StoredProfile lookUpProfile(const std::string& nameOrPath, glm::vec2 uv) {
    const MaterialPointer map = readMaterialArgument(nameOrPath);
    StoredProfile profile{map->segments, map->maxRadiusMm,
                          std::vector<float>(static_cast<std::size_t>(map->knots()) * 3)};
    map->sampleLogProfile(uv, profile.logProfile.data());
    return profile;
}

/// The model's surface, with the scale that a rendering of it would have, or a flat one.
SurfaceAtlas surfaceFor(const EditOptions& options, const StrokeSurface& recorded,
                        const MaterialPointer& material) {
    if (options.model.empty()) {
        if (recorded.model) {
            throw UsageError(fmt::format("'{}'", options.strokes),
                             fmt::format("was painted on the model '{}'", *recorded.model),
                             "name it with --model");
        }
        return makeFlatSurface(material->width, material->height, recorded.flatWidthMm);
    }
    Scene scene = readModel(options.model);
    const std::vector<MaterialPointer> named(scene.materials.size());
    const World world = buildWorld(std::move(scene), material, named, nullptr,
                                   {options.millimetersPerUnit, options.diameterMm});
    for (const std::string& warning : world.warnings) {
        log::warning("{}", warning);
    }
    SurfaceAtlas atlas = makeSurfaceAtlas(world, 0, material->width, material->height);
    if (atlas.overlaps > 0) {
        log::warning("'{}': {} texels are worn by more than one place of the surface; an edit of "
                     "one shows at all of them",
                     options.model, atlas.overlaps);
    }
    return atlas;
}

/// The material at the size that was painted on, or that is asked for.
MaterialPointer sized(const MaterialPointer& material, const EditOptions& options,
                      const StrokeFile& strokes) {
    glm::ivec2 texels = strokes.surface.texels.value_or(glm::ivec2(0));
    if (options.size > 0) {
        texels = glm::ivec2(options.size);
    }
    if (texels.x <= 0 || (texels.x == material->width && texels.y == material->height)) {
        return material;
    }
    return std::make_shared<MaterialMap>(
        convertMaterial(*material, {.width = texels.x, .height = texels.y}));
}

/// What the commands ran into, on stderr; nothing is clamped silently.
void warnOfClamping(std::size_t command, const std::string& title, const EditReport& report) {
    if (report.texels == 0) {
        log::warning("/commands/{} ({}) changed no texel", command, title);
    }
    if (report.energyClamped > 0) {
        log::warning("/commands/{} ({}): {} of {} texels would have an albedo above 1 and got 1",
                     command, title, report.energyClamped, report.texels);
    }
    if (report.rangeClamped > 0) {
        log::warning("/commands/{} ({}): {} of {} texels would scatter beyond the largest r_s "
                     "that an edit may grow to ({:g} times the file's) and were held there",
                     command, title, report.rangeClamped, report.texels, kLargestGrowth);
    }
}

nlohmann::json reportJson(const std::string& title, const EditReport& report, double milliseconds) {
    nlohmann::json out{{"command", title},
                       {"texels", report.texels},
                       {"energyClamped", report.energyClamped},
                       {"rangeClamped", report.rangeClamped},
                       {"milliseconds", std::round(milliseconds * 1e3) * 1e-3}};
    if (report.grownRadiusMm) {
        out["grownRadiusMm"] = *report.grownRadiusMm;
    }
    return out;
}

void runEdit(const EditOptions& options) {
    if (options.material.empty()) {
        throw UsageError("material edit", "no material is given",
                         "name a file or a shipped material");
    }
    if (options.strokes.empty()) {
        throw UsageError("material edit", "--strokes is missing",
                         "name the file of commands to replay");
    }
    if (options.model.empty() && (options.millimetersPerUnit || options.diameterMm)) {
        throw UsageError("material edit",
                         "--scale and --diameter are of a model, and none is given",
                         "name it with --model");
    }
    checkMaterialOutput("material edit", options.output);
    const StrokeFile strokes = readStrokeFile(options.strokes, lookUpProfile);
    const MaterialPointer material =
        sized(readMaterialArgument(options.material), options, strokes);
    Document document(*material,
                      std::make_shared<Surface>(surfaceFor(options, strokes.surface, material)));

    Progress progress("commands", strokes.commands.size());
    nlohmann::json reports = nlohmann::json::array();
    for (std::size_t i = 0; i < strokes.commands.size(); ++i) {
        const EditCommand& command = strokes.commands[i];
        const auto start = std::chrono::steady_clock::now();
        EditReport report;
        try {
            report = document.execute(command);
        } catch (const InputError& error) {
            throw InputError(fmt::format("'{}', /commands/{}", options.strokes, i), error.what());
        }
        const std::chrono::duration<double, std::milli> elapsed =
            std::chrono::steady_clock::now() - start;
        const std::string title = commandTitle(command);
        if (operatorOf(command) != nullptr) {
            warnOfClamping(i, title, report);
        }
        reports.push_back(reportJson(title, report, elapsed.count()));
        progress.update(i + 1);
    }
    writeMaterial(document.material(), options.output,
                  options.storeFloat ? StoredPrecision::Float : StoredPrecision::Half);
    if (options.json) {
        fmt::print("{}\n", nlohmann::json{{"commands", reports}}.dump(2));
    }
}

} // namespace

Command addMaterialEdit(CLI::App& material) {
    const auto options = std::make_shared<EditOptions>();
    EditOptions& o = *options;
    CLI::App* edit =
        material.add_subcommand("edit", "Replays a file of strokes and other edits on a material");
    addPositional(*edit, "MATERIAL", "A .subedit.exr file, or the name of a shipped material",
                  o.material);
    const char* group = "Edits";
    addOption(*edit, "--strokes",
              {group, "FILE", "Commands as JSON, as the editor records them (subedit/document)"},
              takeText(o.strokes));
    addOption(*edit, "--model",
              {group, "MODEL",
               "What they were painted on: a model file or builtin:NAME; default: a flat surface"},
              takeText(o.model));
    addOption(*edit, "--scale", {group, "MM", "Millimeters per model unit"},
              takeNumber(o.millimetersPerUnit, kPositive));
    addOption(*edit, "--diameter", {group, "MM", "Of the model's bounding sphere"},
              takeNumber(o.diameterMm, kPositive));
    addOption(
        *edit, "--size",
        {group, "N", "Texels a side to edit at; default: as it was painted, or the material's"},
        takeInteger(o.size, 1, 4096));
    group = "Result";
    addOption(*edit, "-o,--output", {group, "FILE", "The edited material, NAME.subedit.exr"},
              takeText(o.output));
    addFlag(*edit, "--float", group, "Stores single instead of half precision", o.storeFloat);
    addFlag(*edit, "--json", group, "Prints what each command did as a JSON object", o.json);
    return {edit, [options] { runEdit(*options); }};
}

} // namespace celadon::app
