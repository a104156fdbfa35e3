#pragma once

#include "renderer/gl/program.h"
#include "renderer/gl/shader_library.h"
#include "renderer/gl/texture.h"
#include "renderer/splatting/splatting_buffer.h"

/// Views that explain a frame, in place of its picture. The numbers are those of view_mode.comp.
namespace celadon {

enum class ViewMode {
    Picture = 0,
    Exitance = 1,        ///< B
    ExitanceLevel = 2,   ///< the accumulated B of one level of the splatting buffer
    EffectiveRadius = 3, ///< heat map over ln R_P
    Albedo = 4,
    Normals = 5,
    TextureCoordinates = 6,
    // Pictures of their own (renderer/explain/), not made by this pass.
    Irradiance = 7, ///< what a light sees, and its mips
    Samples = 8,    ///< the samples that are taken of it, colored by level
    Atlas = 9,      ///< the material's map with the charts of the surface
    Difference = 10 ///< error against the truth, worked out in the background
};

/// Whether ViewModePass makes it.
[[nodiscard]] constexpr bool isPerPixel(ViewMode mode) {
    return mode != ViewMode::Picture && mode < ViewMode::Irradiance;
}

struct ViewModeSettings {
    ViewMode mode = ViewMode::Picture;
    int level = 0;              ///< of ExitanceLevel, and the mip of Irradiance
    int light = 0;              ///< of Irradiance and Samples, among those that are on
    float distanceMm = 0.0f;    ///< of Samples: at which they are used
    float exposureEv = 0.0f;    ///< of both exitances
    float leastRadiusMm = 0.1f; ///< ends of the heat map
    float greatestRadiusMm = 10.0f;
};

class ViewModePass {
public:
    ViewModePass(const gl::ShaderLibrary& shaders, int materialCount);

    /// The frame and material blocks are bound. @param settings isPerPixel(mode)
    /// @return RGBA32F: linear display color, alpha 1 where a surface is seen; until the next call
    const gl::Texture& apply(const SplattingBuffer& view, const gl::Texture& exitance,
                             const ViewModeSettings& settings);

private:
    gl::Texture mResult;
    gl::Program mProgram;
};

} // namespace celadon
