#pragma once

#include "app/render_options.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/world.h"

#include <string>
#include <vector>

/// From options to a world: the model, its materials and its lights, read and resolved.
namespace celadon::app {

/// A model file or builtin:NAME. @throws InputError, UsageError
[[nodiscard]] Scene readModel(const std::string& model);

/// A SubEdit file or the name of a shipped one; what is worth knowing about it is logged as
/// warnings.
[[nodiscard]] MaterialPointer readMaterialArgument(const std::string& nameOrPath);

/// Everything that frame `frame` shows: patterns in model and material are filled in.
[[nodiscard]] World readWorld(const RenderOptions& options, int frame);

/// Camera in mm for the picture's aspect.
[[nodiscard]] Camera cameraOf(const RenderOptions& options, const World& world);

/// The map of --environment; none without it.
[[nodiscard]] Environment environmentOf(const RenderOptions& options);

/// Lights in mm: those asked for, else the file's, else, without an environment, one that flatters.
[[nodiscard]] std::vector<Light> lightsOf(const RenderOptions& options, const World& world,
                                          const Camera& camera);

} // namespace celadon::app
