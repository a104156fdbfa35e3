#include "app/command_material.h"

#include "app/command_material_edit.h"
#include "app/describe_material.h"
#include "app/option_takers.h"
#include "app/rgb_argument.h"
#include "renderer/output/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/map/image_map.h"
#include "subedit/map/material_bake.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/medium.h"
#include "subedit/recipes/recipes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr int kMaxSize = 4096;
constexpr float kSmallestMeanFreePathMm = 1e-4f;
constexpr float kLargestMeanFreePathMm = 1e4f;

struct BakeOptions {
    std::string recipe;
    bool list = false;
    std::string albedo;
    std::string meanFreePath;
    double meanFreePathScale = 1.0;
    int size = 0;
    int segments = 0;
    double maxRadiusMm = 0.0;
    double eta = 1.4;
    std::string name;
    bool storeFloat = false;
    std::string output;
};

struct MaterialInfoOptions {
    std::string material;
    bool json = false;
};

/// An image or, if the text is numbers, one texel of them.
ImageMap readMap(const std::string& text, ImageMeaning meaning) {
    if (const std::optional<glm::dvec3> constant = parseRgb(text)) {
        return {1, 1, {glm::vec3(*constant)}};
    }
    return readImageMap(text, meaning);
}

/// Refuses a map with a value outside [low, high].
void checkRange(const std::string& option, const std::string& text, const ImageMap& map, float low,
                float high) {
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const float value = map.values[i][channel];
            if (!(value >= low && value <= high)) {
                const auto width = static_cast<std::size_t>(map.width);
                throw InputError(fmt::format("{} '{}'", option, text),
                                 fmt::format("{} is {} at pixel ({}, {}), not in [{}, {}]",
                                             channelName(channel), value, i % width, i / width, low,
                                             high));
            }
        }
    }
}

MaterialMap bakeMaps(const BakeOptions& options, const BakeSettings& settings) {
    ImageMap albedo = readMap(options.albedo, ImageMeaning::Color);
    ImageMap path = readMap(options.meanFreePath, ImageMeaning::Data);
    checkRange("--albedo", options.albedo, albedo, 0.0f, 1.0f);
    for (glm::vec3& value : path.values) {
        value *= static_cast<float>(options.meanFreePathScale);
    }
    checkRange("--mean-free-path", options.meanFreePath, path, kSmallestMeanFreePathMm,
               kLargestMeanFreePathMm);

    const bool isAlbedoConstant = albedo.values.size() == 1;
    const bool isPathConstant = path.values.size() == 1;
    if (!isAlbedoConstant && !isPathConstant && options.size == 0 &&
        (albedo.width != path.width || albedo.height != path.height)) {
        throw InputError(fmt::format("--albedo '{}'", options.albedo),
                         fmt::format("is {} x {}, but --mean-free-path '{}' is {} x {}",
                                     albedo.width, albedo.height, options.meanFreePath, path.width,
                                     path.height),
                         "give --size to resample both");
    }
    const int width = options.size > 0 ? options.size : std::max(albedo.width, path.width);
    const int height = options.size > 0 ? options.size : std::max(albedo.height, path.height);
    const double values = static_cast<double>(width) * height * (settings.segments + 1) * 3;
    if (values * sizeof(float) > 4e9) {
        throw UsageError("material bake",
                         fmt::format("{} x {} texels of {} segments are {:.1f} GB", width, height,
                                     settings.segments, values * sizeof(float) / 1e9),
                         "give a smaller --size");
    }
    if (albedo.width != width || albedo.height != height) {
        albedo = resizeImageMap(albedo, width, height);
    }
    if (path.width != width || path.height != height) {
        path = resizeImageMap(path, width, height);
    }
    AppearanceMap appearance;
    appearance.width = width;
    appearance.height = height;
    appearance.eta = static_cast<float>(options.eta);
    appearance.albedo = albedo.values;
    for (std::size_t i = 0; i < albedo.values.size(); ++i) {
        appearance.effectiveRadius.push_back(
            effectiveRadiusFromMeanFreePath(albedo.values[i], path.values[i]));
    }
    return bakeAppearance(appearance, settings);
}

void runBake(const BakeOptions& options) {
    if (options.list) {
        for (const Recipe& recipe : recipes()) {
            fmt::print("{:18} {}\n", recipe.name, recipe.description);
        }
        return;
    }
    const bool fromMaps = !options.albedo.empty() || !options.meanFreePath.empty();
    if (options.recipe.empty() == !fromMaps) {
        throw UsageError("material bake",
                         fromMaps ? "a recipe and maps are both given" : "nothing to bake is given",
                         "use --recipe NAME (--list shows them), or --albedo with "
                         "--mean-free-path");
    }
    if (fromMaps && (options.albedo.empty() || options.meanFreePath.empty())) {
        throw UsageError("material bake", options.albedo.empty() ? "--albedo is missing"
                                                                 : "--mean-free-path is missing");
    }
    if (options.output.empty()) {
        throw UsageError("material bake", "-o is missing", "name the file to write");
    }
    checkWritable(options.output);
    BakeSettings settings;
    settings.maxRadiusMm = options.maxRadiusMm;
    MaterialMap map;
    if (fromMaps) {
        settings.segments = options.segments > 0 ? options.segments : settings.segments;
        map = bakeMaps(options, settings);
        map.name = std::filesystem::path(options.output).stem().stem().string();
    } else {
        const Recipe& recipe = findRecipe(options.recipe);
        settings.segments = options.segments > 0 ? options.segments : recipe.segments;
        map = recipe.bake(options.size > 0 ? options.size : recipe.size, settings);
    }
    if (!options.name.empty()) {
        map.name = options.name;
    }
    writeMaterial(map, options.output,
                  options.storeFloat ? StoredPrecision::Float : StoredPrecision::Half);
}

Command addBake(CLI::App& material) {
    const auto options = std::make_shared<BakeOptions>();
    BakeOptions& o = *options;
    CLI::App* bake = material.add_subcommand("bake", "Makes a material from a recipe or from maps");
    const char* group = "From a recipe";
    addOption(*bake, "--recipe", {group, "NAME", "A procedural or measured material, see --list"},
              takeText(o.recipe));
    addFlag(*bake, "--list", group, "Lists the recipes", o.list);
    group = "From maps";
    addOption(
        *bake, "--albedo",
        {group, "FILE|R,G,B", "Surface albedo, 0 to 1; pictures of 8 or 16 bits are sRGB encoded"},
        takeText(o.albedo));
    addOption(*bake, "--mean-free-path", {group, "FILE|R,G,B", "1/sigma_t' in mm, linear"},
              takeText(o.meanFreePath));
    addOption(*bake, "--mean-free-path-scale",
              {group, "MM", "What 1 in the mean free path picture stands for; default 1"},
              takeNumber(o.meanFreePathScale, {1e-6, 1e6, false}));
    addOption(*bake, "--eta",
              {group, "N", fmt::format("Relative index of refraction; default {}", o.eta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
    group = "Result";
    addOption(*bake, "-o,--output", {group, "FILE", "The material, NAME.subedit.exr"},
              takeText(o.output));
    addOption(*bake, "--size", {group, "N", "Texels a side; default: the recipe's or the maps'"},
              takeInteger(o.size, 1, kMaxSize));
    addOption(*bake, "--segments",
              {group, "N",
               fmt::format("Segments of the stored profiles, 1 to {}; default: the recipe's, or {}",
                           kMaxSegments, BakeSettings{}.segments)},
              takeInteger(o.segments, 1, kMaxSegments));
    addOption(*bake, "--max-radius",
              {group, "MM", "r_s; default: holds 99.9 % of the longest profile"},
              takeNumber(o.maxRadiusMm, {1e-6, 1e6, false}));
    addOption(*bake, "--name", {group, "NAME", "Of the material; default: the file's or recipe's"},
              takeText(o.name));
    addFlag(*bake, "--float", group, "Stores single instead of half precision", o.storeFloat);
    return {bake, [options] { runBake(*options); }};
}

Command addInfo(CLI::App& material) {
    const auto options = std::make_shared<MaterialInfoOptions>();
    CLI::App* info = material.add_subcommand("info", "Tells what a material holds");
    addPositional(*info, "MATERIAL", "A .subedit.exr file, or the name of a shipped material",
                  options->material);
    addFlag(*info, "--json", "Result", "Prints one JSON object", options->json);
    return {info, [options] {
                if (options->material.empty()) {
                    throw UsageError("material info", "no material is given",
                                     "name a file or a shipped material");
                }
                describeMaterial(options->material, options->json);
            }};
}

} // namespace

Command addMaterialCommand(CLI::App& root) {
    CLI::App* material =
        root.add_subcommand("material", "Makes, edits and describes SubEdit materials");
    return {material, {}, {addBake(*material), addInfo(*material), addMaterialEdit(*material)}};
}

} // namespace celadon::app
