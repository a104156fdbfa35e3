#pragma once

#include "app/command.h"
#include "app/render_motion.h"

#include <filesystem>
#include <optional>
#include <string>

namespace celadon::app {

struct InfoOptions {
    std::string file; ///< a model, a material, or builtin:NAME
    bool system = false;
    std::optional<std::filesystem::path> writeAtlas; ///< the model with its coordinates, as OBJ
    std::optional<std::filesystem::path> writeMesh;  ///< the posed model, as OBJ
    std::optional<std::filesystem::path> writeGltf;  ///< the glTF, with the deformers in it
    MotionRequest motion;                            ///< of --write-mesh and --write-gltf
    WorldScale scale;
};

/// `celadon info MODEL|MATERIAL|--system`
[[nodiscard]] Command addInfoCommand(CLI::App& root);

/// What a model or material file holds, on stdout. @throws celadon::Error
void describeFile(const InfoOptions& options);

/// Every way to an OpenGL context on this machine, on stdout.
void describeSystem();

} // namespace celadon::app
