#pragma once

#include "renderer/output/image.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"

/// The environment behind a picture.
namespace celadon {

/// Places a premultiplied picture in front of what each pixel's center sees of the environment; the
/// result is opaque (A = 1), of linear radiance. Channels beyond R,G,B,A are kept.
/// @param image R,G,B,A, top row first, of the camera's size in pixels
[[nodiscard]] FloatImage compositeOverEnvironment(FloatImage image, const Environment& environment,
                                                  const Camera& camera);

} // namespace celadon
