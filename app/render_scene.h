#pragma once

#include "app/render_options.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/world.h"
#include "subedit/map/material_fade.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// From options to a world: the model, its materials and its lights, read and resolved.
namespace celadon::app {

/// A model file or builtin:NAME. @throws InputError, UsageError
[[nodiscard]] Scene readModel(const std::string& model);

/// A SubEdit file or the name of a shipped one; what is worth knowing about it is logged as
/// warnings.
[[nodiscard]] MaterialPointer readMaterialArgument(const std::string& nameOrPath);

/// One texel: the profile of a homogeneous medium, by photon beam diffusion and with the albedo of
/// the half space (subedit/map/medium_bake.h).
[[nodiscard]] MaterialPointer bakeMedium(const subedit::Medium& medium);

/// Material files, by canonical path, and the files that are read in their place.
using ReadInstead = std::map<std::filesystem::path, std::filesystem::path>;

/// The model's file, or builtin:NAME, and the text of --material, in a frame: patterns are filled
/// in.
[[nodiscard]] std::string modelOfFrame(const RenderOptions& options, int frame);
[[nodiscard]] std::string materialOfFrame(const RenderOptions& options, int frame);

/// Everything that frame `frame` shows: patterns in model and material are filled in.
[[nodiscard]] World readWorld(const RenderOptions& options, int frame,
                              const ReadInstead& readInstead = {});

/// A --material that is another in each frame: a numbered sequence of files, or a fade.
class MaterialOverTime {
public:
    /// @param options outlive it
    explicit MaterialOverTime(const RenderOptions& options) : mOptions(options) {}

    [[nodiscard]] bool changes() const;
    /// Of frame `frame`; of one that changes, null otherwise: what the world has stays.
    [[nodiscard]] MaterialPointer at(int frame);

private:
    const RenderOptions& mOptions;
    std::optional<subedit::MaterialFade> mFade; ///< read when it is needed first
};

/// Camera in mm for the picture's aspect.
[[nodiscard]] Camera cameraOf(const RenderOptions& options, const World& world);

/// The map of --environment; none without it.
[[nodiscard]] Environment environmentOf(const RenderOptions& options);

/// Lights in mm: those asked for, else the file's, else, without an environment, one that flatters.
[[nodiscard]] std::vector<Light> lightsOf(const RenderOptions& options, const World& world,
                                          const Camera& camera);

} // namespace celadon::app
