#include "app/material/map_argument.h"
#include "app/material/material_commands.h"
#include "app/option_takers.h"
#include "app/overwriting.h"
#include "app/profile/profile_output.h"
#include "subedit/errors.h"
#include "subedit/map/image_map.h"
#include "subedit/map/material_bake.h"
#include "subedit/map/material_file.h"
#include "subedit/map/medium_bake.h"
#include "subedit/recipes/recipes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr int kMaxSize = 4096;
constexpr float kSmallestMeanFreePathMm = 1e-4f;
constexpr float kLargestMeanFreePathMm = 1e4f;
constexpr float kLargestCoefficient = 1e4f; ///< 1/mm

enum class ColorSpace { Auto, Srgb, Linear };
constexpr std::array<std::string_view, 3> kColorSpaces{"auto", "srgb", "linear"};

struct BakeOptions {
    std::string recipe;
    bool list = false;
    std::string albedo;
    ColorSpace albedoSpace = ColorSpace::Auto;
    std::string meanFreePath;
    double meanFreePathScale = 1.0;
    std::string absorption;
    std::string reducedScattering;
    double coefficientScale = 1.0;
    std::string roughness;
    std::string specular;
    int size = 0;
    int segments = 0;
    double maxRadiusMm = 0.0;
    double eta = 1.4;
    std::string name;
    bool storeFloat = false;
    std::string output;
};

/// A map with the option that gave it.
struct NamedMap {
    std::string option;
    std::string text;
    ImageMap map;

    [[nodiscard]] bool isConstant() const { return map.values.size() == 1; }
};

/// Brings all maps to one size: the one that is asked for, else that of those which are no
/// constants, which must agree.
void unifySizes(std::vector<NamedMap*> maps, int size, int segments) {
    const NamedMap* largest = nullptr;
    for (const NamedMap* map : maps) {
        if (map->isConstant()) {
            continue;
        }
        if (largest != nullptr && size == 0 &&
            (map->map.width != largest->map.width || map->map.height != largest->map.height)) {
            throw InputError(fmt::format("{} '{}'", largest->option, largest->text),
                             fmt::format("is {} x {}, but {} '{}' is {} x {}", largest->map.width,
                                         largest->map.height, map->option, map->text,
                                         map->map.width, map->map.height),
                             "give --size to resample all");
        }
        largest = largest == nullptr ? map : largest;
    }
    const int width = size > 0 ? size : (largest != nullptr ? largest->map.width : 1);
    const int height = size > 0 ? size : (largest != nullptr ? largest->map.height : 1);
    checkMapMemory("material bake", static_cast<double>(width) * height, segments);
    for (NamedMap* map : maps) {
        if (map->map.width != width || map->map.height != height) {
            map->map = resizeImageMap(map->map, width, height);
        }
    }
}

NamedMap readNamed(const std::string& option, const std::string& text, ImageMeaning meaning,
                   float scale, float low, float high) {
    NamedMap named{option, text, readMap(text, meaning)};
    for (glm::vec3& value : named.map.values) {
        value *= scale;
    }
    checkRange(option, text, named.map, low, high);
    return named;
}

NamedMap readAlbedo(const BakeOptions& options) {
    const ImageMeaning meaning =
        options.albedoSpace == ColorSpace::Auto ? ImageMeaning::Color : ImageMeaning::Data;
    NamedMap albedo = readNamed("--albedo", options.albedo, meaning, 1.0f, 0.0f, 1.0f);
    if (options.albedoSpace == ColorSpace::Srgb) {
        decodeSrgb(albedo.map);
    }
    return albedo;
}

MaterialMap bakeMaps(const BakeOptions& options, const BakeSettings& settings) {
    const bool isByCoefficients = !options.absorption.empty();
    const auto coefficientScale = static_cast<float>(options.coefficientScale);
    NamedMap color = isByCoefficients
                         ? readNamed("--absorption", options.absorption, ImageMeaning::Data,
                                     coefficientScale, 0.0f, kLargestCoefficient)
                         : readAlbedo(options);
    NamedMap length =
        isByCoefficients
            ? readNamed("--reduced-scattering", options.reducedScattering, ImageMeaning::Data,
                        coefficientScale, 1e-6f, kLargestCoefficient)
            : readNamed("--mean-free-path", options.meanFreePath, ImageMeaning::Data,
                        static_cast<float>(options.meanFreePathScale), kSmallestMeanFreePathMm,
                        kLargestMeanFreePathMm);
    std::vector<NamedMap*> maps{&color, &length};
    NamedMap roughness;
    NamedMap specular;
    const auto addUnit = [&](const char* option, const std::string& text, NamedMap& map) {
        if (!text.empty()) {
            map = readNamed(option, text, ImageMeaning::Data, 1.0f, 0.0f, 1.0f);
            maps.push_back(&map);
        }
    };
    addUnit("--roughness", options.roughness, roughness);
    addUnit("--specular", options.specular, specular);
    unifySizes(maps, options.size, settings.segments);
    std::vector<float> roughnessValues;
    for (const glm::vec3& value : roughness.map.values) {
        roughnessValues.push_back(value.x);
    }
    const int width = color.map.width;
    const int height = color.map.height;
    const auto eta = static_cast<float>(options.eta);
    MaterialMap map;
    if (isByCoefficients) {
        map = bakeMedia({width, height, eta, color.map.values, length.map.values, roughnessValues},
                        settings);
    } else {
        AppearanceMap appearance{"", width, height, eta, color.map.values, {}, roughnessValues};
        for (std::size_t i = 0; i < color.map.values.size(); ++i) {
            appearance.effectiveRadius.push_back(
                effectiveRadiusFromMeanFreePath(color.map.values[i], length.map.values[i]));
        }
        map = bakeAppearance(appearance, settings);
    }
    for (const glm::vec3& value : specular.map.values) {
        map.specular.push_back(value.x);
    }
    return map;
}

/// @return whether it is from maps, not from a recipe
bool checkSources(const BakeOptions& o) {
    const bool hasAlbedo = !o.albedo.empty() || !o.meanFreePath.empty();
    const bool hasCoefficients = !o.absorption.empty() || !o.reducedScattering.empty();
    const bool fromMaps = hasAlbedo || hasCoefficients;
    if (o.recipe.empty() == !fromMaps) {
        throw UsageError("material bake",
                         fromMaps ? "a recipe and maps are both given" : "nothing to bake is given",
                         "use --recipe NAME (--list shows them), --albedo with "
                         "--mean-free-path, or --absorption with --reduced-scattering");
    }
    if (hasAlbedo && hasCoefficients) {
        throw UsageError("material bake", "the medium is given in more than one way",
                         "use --albedo with --mean-free-path, or --absorption with "
                         "--reduced-scattering");
    }
    const auto requireBoth = [](const std::string& a, const char* nameA, const std::string& b,
                                const char* nameB) {
        if (a.empty() != b.empty()) {
            throw UsageError("material bake",
                             fmt::format("{} is missing", a.empty() ? nameA : nameB));
        }
    };
    requireBoth(o.albedo, "--albedo", o.meanFreePath, "--mean-free-path");
    requireBoth(o.absorption, "--absorption", o.reducedScattering, "--reduced-scattering");
    if (!fromMaps && (!o.roughness.empty() || !o.specular.empty())) {
        throw UsageError(o.roughness.empty() ? "--specular" : "--roughness",
                         "goes with maps, not with a recipe");
    }
    return fromMaps;
}

void runBake(const BakeOptions& options) {
    if (options.list) {
        for (const Recipe& recipe : recipes()) {
            fmt::print("{:18} {}\n", recipe.name, recipe.description);
        }
        return;
    }
    const bool fromMaps = checkSources(options);
    checkMaterialOutput("material bake", options.output);
    refuseOverwriting({{"--output", options.output}},
                      {{"--albedo", options.albedo},
                       {"--mean-free-path", options.meanFreePath},
                       {"--absorption", options.absorption},
                       {"--reduced-scattering", options.reducedScattering},
                       {"--roughness", options.roughness},
                       {"--specular", options.specular}});
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

void addMapOptions(CLI::App& bake, BakeOptions& o) {
    const char* group = "From maps";
    addOption(
        bake, "--albedo",
        {group, "FILE|R,G,B", "Surface albedo, 0 to 1; pictures of 8 or 16 bits are sRGB encoded"},
        takeText(o.albedo));
    addOption(bake, "--albedo-space",
              {group, "auto|srgb|linear",
               "Encoding of the albedo picture; default auto: what the file says or its kind "
               "implies. Primaries are Rec. 709"},
              takeChoice(o.albedoSpace, kColorSpaces));
    addOption(bake, "--mean-free-path", {group, "FILE|R,G,B", "1/sigma_t' in mm, linear"},
              takeText(o.meanFreePath));
    addOption(bake, "--mean-free-path-scale",
              {group, "MM", "What 1 in the mean free path picture stands for; default 1"},
              takeNumber(o.meanFreePathScale, {1e-6, 1e6, false}));
    addOption(bake, "--absorption",
              {group, "FILE|R,G,B",
               "Instead: sigma_a in 1/mm, linear; profiles are those of photon beam diffusion"},
              takeText(o.absorption));
    addOption(bake, "--reduced-scattering", {group, "FILE|R,G,B", "sigma_s' in 1/mm, linear"},
              takeText(o.reducedScattering));
    addOption(bake, "--coefficient-scale",
              {group, "S", "1/mm that 1 in the pictures of coefficients stands for; default 1"},
              takeNumber(o.coefficientScale, {1e-6, 1e6, false}));
    addOption(bake, "--roughness", {group, "FILE|X", "Of the surface, 0 to 1, linear"},
              takeText(o.roughness));
    addOption(bake, "--specular", {group, "FILE|X", "Of the surface, 0 to 1, linear"},
              takeText(o.specular));
    addOption(bake, "--eta",
              {group, "N", fmt::format("Relative index of refraction; default {}", o.eta)},
              takeNumber(o.eta, {0.5, 4.0, false}));
}

} // namespace

Command addMaterialBake(CLI::App& material) {
    const auto options = std::make_shared<BakeOptions>();
    BakeOptions& o = *options;
    CLI::App* bake = material.add_subcommand("bake", "Makes a material from a recipe or from maps");
    const char* group = "From a recipe";
    addOption(*bake, "--recipe", {group, "NAME", "A procedural or measured material, see --list"},
              takeText(o.recipe));
    addFlag(*bake, "--list", group, "Lists the recipes", o.list);
    addMapOptions(*bake, o);
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

} // namespace celadon::app
