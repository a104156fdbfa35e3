#include "app/describe_material.h"
#include "app/material/material_commands.h"
#include "app/material/thumbnail.h"
#include "app/option_takers.h"
#include "renderer/output/image_io.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/map/material_file.h"
#include "subedit/map/shipped_materials.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace celadon::app {

namespace {

struct InfoOptions {
    std::string material;
    std::string thumbnail;
    bool json = false;
};

void runInfo(const InfoOptions& options) {
    if (options.material.empty()) {
        throw UsageError("material info", "no material is given",
                         "name a file or a shipped material");
    }
    if (!options.thumbnail.empty()) {
        if (imageFormat(options.thumbnail) == ImageFormat::Exr) {
            throw UsageError("--thumbnail", "is a picture to look at", "end it in .png");
        }
        checkWritable(options.thumbnail);
    }
    describeMaterial(options.material, options.json);
    if (!options.thumbnail.empty()) {
        writeDisplayImage(options.thumbnail, drawThumbnail(subedit::readMaterial(
                                                 subedit::findMaterial(options.material))));
    }
}

} // namespace

Command addMaterialInfo(CLI::App& material) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* info = material.add_subcommand("info", "Tells what a material holds");
    addPositional(*info, "MATERIAL", "A .subedit.exr file, or the name of a shipped material",
                  options->material);
    const char* group = "Result";
    addFlag(*info, "--json", group, "Prints one JSON object", options->json);
    addOption(*info, "--thumbnail",
              {group, "FILE",
               "Also draws the map: left its albedo, right how far it scatters (bright is far)"},
              takeText(options->thumbnail));
    return {info, [options] { runInfo(*options); }};
}

} // namespace celadon::app
