#include "app/command_info.h"

#include "app/option_takers.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace celadon::app {
namespace {

void checkMeshOutput(const char* option, const std::optional<std::filesystem::path>& file,
                     bool isSystem) {
    if (!file) {
        return;
    }
    if (isSystem) {
        throw UsageError(option, "needs a model");
    }
    if (file->extension() != ".obj") {
        throw UsageError(fmt::format("'{}'", file->string()), "only OBJ files are written",
                         "choose .obj");
    }
    checkWritable(*file);
}

void checkInfoOptions(const InfoOptions& options) {
    if (options.system && !options.file.empty()) {
        throw UsageError("--system", "does not go with a file", "leave one of them out");
    }
    if (!options.system && options.file.empty()) {
        throw UsageError("info", "no file is given", "name a model or a material, or --system");
    }
    if (options.writeAtlas && options.writeMesh) {
        throw UsageError("--write-atlas", "does not go with --write-mesh", "leave one of them out");
    }
    checkMeshOutput("--write-atlas", options.writeAtlas, options.system);
    checkMeshOutput("--write-mesh", options.writeMesh, options.system);
    if (options.writeGltf) {
        if (options.system || options.writeMesh || options.writeAtlas) {
            throw UsageError("--write-gltf", "is an output of its own",
                             "leave out --write-mesh, --write-atlas and --system");
        }
        if (options.motion.deformations.empty() || options.motion.animation ||
            options.motion.timeSeconds) {
            throw UsageError("--write-gltf", "stores deformers, and no pose",
                             "give them by --deform, and leave out --animation and --time");
        }
        checkWritable(*options.writeGltf);
    }
    const MotionRequest& motion = options.motion;
    if ((motion.animation || motion.timeSeconds || !motion.deformations.empty() ||
         options.scale.millimetersPerUnit || options.scale.diameterMm) &&
        !options.writeMesh && !options.writeGltf) {
        throw UsageError("info", "a pose or a size is only for the mesh that is written",
                         "add --write-mesh OUT.obj");
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
    const char* pose = "The posed mesh";
    addOption(
        *command, "--write-mesh",
        {pose, "OUT.obj",
         "Writes the model as posed, in model units, with the texture coordinates and normals "
         "used"},
        [options](const Argument& a) { options->writeMesh = parsePath(a); });
    addOption(*command, "--write-gltf",
              {pose, "OUT.glb|gltf",
               "Writes the .glb or .gltf as it is, with the deformers of --deform stored in it"},
              [options](const Argument& a) { options->writeGltf = parsePath(a); });
    addOption(*command, "--animation",
              {pose, "NAME|N", "Which of the glTF's animations, by name or number from 0"},
              takeText(options->motion.animation));
    addOption(*command, "--time", {pose, "S", "The moment of the animation, seconds; default 0"},
              takeNumber(options->motion.timeSeconds, kNotNegative));
    addRepeatable(
        *command, "--deform",
        {pose, "DEFORM",
         "As for render, after the animation; repeatable, in order; default: what it stores"},
        [options](const Argument& a) { options->motion.deformations.push_back(parseText(a)); });
    addOption(*command, "--scale", {pose, "MM", "Millimeters per model unit, as for render"},
              takeNumber(options->scale.millimetersPerUnit, kPositive));
    addOption(*command, "--diameter",
              {pose, "MM", "Millimeters of the bounding sphere's diameter, instead of --scale"},
              takeNumber(options->scale.diameterMm, kPositive));
    return {command, [options] {
                checkInfoOptions(*options);
                options->system ? describeSystem() : describeFile(*options);
            }};
}

} // namespace celadon::app
