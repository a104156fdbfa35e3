#pragma once

#include "renderer/explain/light_samples.h"
#include "renderer/gather/sample_tree.h"
#include "renderer/scene/camera.h"
#include "subedit/map/material_map.h"
#include "subedit/paint/surface.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

/// Pictures for the editor's views that explain, as display pixels: RGBA, 8 bits, sRGB encoded,
/// rows from the bottom. No GL here.
namespace celadon {

struct DisplayPixels {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgba; ///< [height][width][4], opaque
};

/// Color of a level of the irradiance buffer, sRGB; finest first, repeats after 8.
[[nodiscard]] glm::vec3 levelColor(int level);

/// What a light sees: mean flux per texel of one mip level, the brightest texel white; a square in
/// the middle of the picture.
/// @param level 0 is the finest; clamped to what the buffer has
[[nodiscard]] DisplayPixels irradiancePicture(const LightTexels& texels, int level,
                                              glm::ivec2 size);

/// Dots at the samples, colored by level and as large as their footprint, over the picture; those
/// that the surface hides are smaller and fainter.
/// @param positions of the splatting buffer's level 0: RGBA, mm and view depth (0: background),
///                  rows from the bottom, `stride` texels a row
void drawSamples(std::span<const ShownSample> samples, const CameraView& camera,
                 const float* positions, int stride, DisplayPixels& picture);

/// A material's map on its atlas: albedo, the borders of charts as lines, background dark.
/// @param surface of the map's size
[[nodiscard]] DisplayPixels atlasPicture(const subedit::MaterialMap& map,
                                         const subedit::Surface& surface, glm::ivec2 size);

} // namespace celadon
