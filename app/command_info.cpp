#include "app/command_info.h"

#include "renderer/output/atomic_file.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace celadon::app {
namespace {

void checkInfoOptions(const InfoOptions& options) {
    if (options.system && !options.file.empty()) {
        throw UsageError("--system", "does not go with a file", "leave one of them out");
    }
    if (!options.system && options.file.empty()) {
        throw UsageError("info", "no file is given", "name a model or a material, or --system");
    }
    if (options.writeAtlas) {
        if (options.system) {
            throw UsageError("--write-atlas", "needs a model");
        }
        if (options.writeAtlas->extension() != ".obj") {
            throw UsageError(fmt::format("'{}'", options.writeAtlas->string()),
                             "only OBJ files are written", "choose .obj");
        }
        checkWritable(*options.writeAtlas);
    }
}

} // namespace

Command addInfoCommand(CLI::App& root) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        root.add_subcommand("info", "Tells what a model, a material or the machine's OpenGL holds");
    addPositional(*command, "FILE", "A model, a .subedit.exr material, or builtin:NAME",
                  options->file);
    const char* group = "What to tell";
    addFlag(*command, "--system", group, "Every OpenGL context of this machine, with its limits",
            options->system);
    addOption(*command, "--write-atlas",
              {group, "OUT.obj", "Writes the model with the texture coordinates used (v up)"},
              [options](const Argument& a) { options->writeAtlas = parsePath(a); });
    return {command, [options] {
                checkInfoOptions(*options);
                options->system ? describeSystem() : describeFile(*options);
            }};
}

} // namespace celadon::app
