#include "app/log.h"
#include "app/material/map_argument.h"
#include "app/material/material_commands.h"
#include "app/option_takers.h"
#include "app/profile/profile_output.h"
#include "subedit/errors.h"
#include "subedit/map/material_convert.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/radius_map.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr int kMaxSide = 8192;
constexpr long long kMaxTexels = 1 << 26;

struct ConvertOptions {
    std::string material;
    ConvertSettings settings;
    bool storeFloat = false;
    bool storeHalf = false;
    std::string name;
    std::string output;
};

double meanAlbedo(const MaterialMap& map) {
    double sum = 0.0;
    const std::vector<float> albedo = albedoMap(map);
    for (const float value : albedo) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(albedo.size());
}

/// The largest R_P of the map, mm.
float largestRadiusMm(const MaterialMap& map) {
    const std::vector<float> radii = effectiveRadiusMap(map);
    return *std::ranges::max_element(radii);
}

/// What a shorter r_s did to the radii: their energy is kept, their reach is not.
void warnOfCut(const MaterialMap& before, const MaterialMap& after) {
    if (after.maxRadiusMm >= before.maxRadiusMm) {
        return;
    }
    const float from = largestRadiusMm(before);
    const float to = largestRadiusMm(after);
    if (to < 0.99f * from) {
        log::warning("r_s = {:.4g} mm cuts the profiles: the largest R_P falls from {:.4g} to "
                     "{:.4g} mm",
                     after.maxRadiusMm, from, to);
    }
}

void runConvert(const ConvertOptions& options) {
    if (options.material.empty()) {
        throw UsageError("material convert", "no material is given",
                         "name a file or a shipped material");
    }
    if (options.storeFloat && options.storeHalf) {
        throw UsageError("--half", "does not go with --float", "leave one of them out");
    }
    checkMaterialOutput("material convert", options.output);
    const MaterialMap map = readMaterial(findMaterial(options.material));
    const ConvertSettings& wanted = options.settings;
    const double texels = static_cast<double>(wanted.width > 0 ? wanted.width : map.width) *
                          (wanted.height > 0 ? wanted.height : map.height);
    const int segments = wanted.segments > 0 ? wanted.segments : map.segments;
    checkMapMemory("material convert", texels, segments);
    MaterialMap out = convertMaterial(map, wanted);
    warnOfCut(map, out);
    if (!options.name.empty()) {
        out.name = options.name;
    }
    writeMaterial(out, options.output,
                  options.storeFloat ? StoredPrecision::Float : StoredPrecision::Half);
    log::info("{} x {} texels, {} segments to r_s = {:.4g} mm, mean albedo {:.5f} (was {:.5f})",
              out.width, out.height, out.segments, out.maxRadiusMm, meanAlbedo(out),
              meanAlbedo(map));
}

/// "N" or "WxH".
void takeSize(const Argument& argument, ConvertSettings& settings) {
    if (argument.text.find('x') == std::string::npos) {
        settings.width = settings.height = parseInteger(argument, 1, kMaxSide);
        return;
    }
    const glm::ivec2 size = parseSize(argument, kMaxSide, kMaxTexels);
    settings.width = size.x;
    settings.height = size.y;
}

} // namespace

Command addMaterialConvert(CLI::App& material) {
    const auto options = std::make_shared<ConvertOptions>();
    ConvertOptions& o = *options;
    CLI::App* convert = material.add_subcommand(
        "convert", "Resizes a material or its profiles, and keeps its energy");
    addPositional(*convert, "MATERIAL", "A .subedit.exr file, or the name of a shipped material",
                  o.material);
    const char* group = "Result";
    addOption(*convert, "-o,--output", {group, "FILE", "The material, NAME.subedit.exr"},
              takeText(o.output));
    addOption(*convert, "--size", {group, "N|WxH", "Texels; default: as it is"},
              [&o](const Argument& argument) { takeSize(argument, o.settings); });
    addOption(
        *convert, "--segments",
        {group, "N", fmt::format("Of the profiles, 1 to {}; default: as it is", kMaxSegments)},
        takeInteger(o.settings.segments, 1, kMaxSegments));
    addOption(*convert, "--max-radius",
              {group, "MM", "r_s; energy beyond it is given back within; default: as it is"},
              takeNumber(o.settings.maxRadiusMm, {1e-6, 1e6, false}));
    addFlag(*convert, "--half", group, "Stores half precision (the default)", o.storeHalf);
    addFlag(*convert, "--float", group, "Stores single precision", o.storeFloat);
    addOption(*convert, "--name", {group, "NAME", "Of the material; default: as it is"},
              takeText(o.name));
    return {convert, [options] { runConvert(*options); }};
}

} // namespace celadon::app
