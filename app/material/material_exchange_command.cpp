#include "app/log.h"
#include "app/material/exchange_json.h"
#include "app/material/material_commands.h"
#include "app/material/response_table.h"
#include "app/option_takers.h"
#include "app/overwriting.h"
#include "app/profile/profile_output.h"
#include "renderer/scene/merge_gltf_material.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;
using nlohmann::json;
namespace fs = std::filesystem;

/// In the order of Convention.
constexpr std::array<std::string_view, 3> kConventions{"openpbr", "principled", "gltf"};

struct ImportOptions {
    std::string input;
    Convention convention = Convention::OpenPbr;
    double unitMm = 1000.0;
    int segments = 32;
    std::string name;
    std::string output;
};

struct ExportOptions {
    std::string material;
    Convention convention = Convention::OpenPbr;
    double unitMm = 1000.0;
    std::string into;
    std::string gltfMaterial;
    std::string output;
};

json readJson(const std::string& file) {
    json parsed = json::parse(readTextFile(file), nullptr, false);
    if (parsed.is_discarded()) {
        throw InputError(fmt::format("'{}'", file), "is no JSON");
    }
    return parsed;
}

void runImport(const ImportOptions& options) {
    if (options.input.empty()) {
        throw UsageError("material import", "no parameters are given", "name a JSON file");
    }
    if (options.convention == Convention::Gltf) {
        throw UsageError("--convention gltf", "has no parameters of subsurface scattering",
                         "choose openpbr or principled");
    }
    checkMaterialOutput("material import", options.output);
    std::vector<std::string> notes;
    const SubsurfaceParameters parameters = parametersFromJson(
        readJson(options.input), options.input, options.convention, options.unitMm, notes);
    MaterialMap map = materialFromParameters(parameters, options.segments);
    map.name =
        options.name.empty() ? fs::path(options.output).stem().stem().string() : options.name;
    writeMaterial(map, options.output, StoredPrecision::Float);
    for (const std::string& note : notes) {
        log::warning("'{}': {}", options.input, note);
    }
}

/// The material's path as the glTF is to name it: relative to the folder of what is written.
std::string referenceFor(const fs::path& material, const std::string& output) {
    const fs::path folder =
        output.empty() ? fs::current_path() : fs::absolute(output).parent_path();
    return fs::absolute(material).lexically_relative(folder).generic_string();
}

json exportGltf(const ExportOptions& options, const NearestParameters& nearest,
                const std::string& name, const fs::path& file) {
    const json made = gltfMaterial(nearest, name, referenceFor(file, options.output));
    if (options.into.empty()) {
        return made;
    }
    if (!options.output.empty() &&
        fs::absolute(options.into).parent_path().lexically_normal() !=
            fs::absolute(options.output).parent_path().lexically_normal()) {
        throw UsageError(fmt::format("-o '{}'", options.output),
                         "is in another folder than the glTF, whose buffers and textures would not "
                         "be found",
                         "write it beside the other");
    }
    json document = readJson(options.into);
    loaders::mergeGltfMaterial(document, options.into, options.gltfMaterial, made);
    return document;
}

void runExport(const ExportOptions& options) {
    if (options.material.empty()) {
        throw UsageError("material export", "no material is given",
                         "name a file or a shipped material");
    }
    if ((!options.into.empty() || !options.gltfMaterial.empty()) &&
        options.convention != Convention::Gltf) {
        throw UsageError(options.into.empty() ? "--gltf-material" : "--into",
                         "goes with --convention gltf");
    }
    if (!options.output.empty()) {
        checkWritable(options.output);
    }
    const fs::path file = findMaterial(options.material);
    refuseOverwriting({{"--output", options.output}},
                      {{"the material", file}, {"--into", options.into}});
    const MaterialMap map = readMaterial(file);
    const NearestParameters nearest = nearestParameters(map);
    const json out = options.convention == Convention::Gltf
                         ? exportGltf(options, nearest, map.name, file)
                         : parametersToJson(nearest, options.convention, options.unitMm);
    emit(options.output, out.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
    for (const std::string& lost : whatIsLost(nearest, options.convention)) {
        log::warning("lost: {}", lost);
    }
}

OptionText conventionText() {
    return {"Convention", "NAME",
            "openpbr (subsurface_color, subsurface_radius, subsurface_radius_scale, specular_ior, "
            "...) or principled (base_color, subsurface_radius, subsurface_scale, ior, ...): the "
            "color is the surface albedo, radius times scale the mean free path; default openpbr"};
}

} // namespace

Command addMaterialImport(CLI::App& material) {
    const auto options = std::make_shared<ImportOptions>();
    ImportOptions& o = *options;
    CLI::App* import = material.add_subcommand(
        "import", "Makes a material from the subsurface parameters of another program");
    addPositional(*import, "JSON", "One object of parameters", o.input);
    addOption(*import, "--convention", conventionText(), takeChoice(o.convention, kConventions));
    addOption(*import, "--unit",
              {"Convention", "MM", "Millimeters in a unit of the radius; default 1000 (meters)"},
              takeNumber(o.unitMm, {1e-6, 1e9, false}));
    const char* group = "Result";
    addOption(*import, "-o,--output", {group, "FILE", "The material, NAME.subedit.exr"},
              takeText(o.output));
    addOption(*import, "--segments",
              {group, "N", fmt::format("Of the stored profile; default {}", o.segments)},
              takeInteger(o.segments, 1, kMaxSegments));
    addOption(*import, "--name", {group, "NAME", "Of the material; default: the file's"},
              takeText(o.name));
    return {import, [options] { runImport(*options); }};
}

Command addMaterialExport(CLI::App& material) {
    const auto options = std::make_shared<ExportOptions>();
    ExportOptions& o = *options;
    CLI::App* exporter = material.add_subcommand(
        "export", "Writes what other programs can have of a material, and says what is lost");
    addPositional(*exporter, "MATERIAL", "A .subedit.exr file, or the name of a shipped material",
                  o.material);
    OptionText text = conventionText();
    text.help += "; or gltf: KHR_materials_ior, _volume and _diffuse_transmission, and "
                 "extras.subedit";
    addOption(*exporter, "--convention", text, takeChoice(o.convention, kConventions));
    addOption(*exporter, "--unit",
              {"Convention", "MM", "Millimeters in a unit of the radius; default 1000 (meters)"},
              takeNumber(o.unitMm, {1e-6, 1e9, false}));
    addOption(*exporter, "--into",
              {"glTF", "FILE", "A .gltf whose material is replaced; -o is then a .gltf beside it"},
              takeText(o.into));
    addOption(*exporter, "--gltf-material",
              {"glTF", "NAME|N", "Which of its materials; default: all"}, takeText(o.gltfMaterial));
    addOption(*exporter, "-o,--output", {"Result", "FILE", "JSON; default: stdout"},
              takeText(o.output));
    return {exporter, [options] { runExport(*options); }};
}

} // namespace celadon::app
