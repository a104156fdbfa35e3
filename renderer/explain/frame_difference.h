#pragma once

#include "renderer/explain/explain_pictures.h"
#include "renderer/frame_renderer.h"

#include <atomic>
#include <memory>
#include <optional>
#include <span>

/// How far a frame is from the truth (DESIGN section 4): the exitance of the splatting solver
/// against that of image-reference, at the same pixels under the same lights.
namespace celadon {

struct FrameDifference {
    DisplayPixels heatMap;     ///< |B - B_truth| of the worst channel, over `scale`; ground behind
    double scale = 0.1;        ///< relative to the mean of the truth, where the heat map ends
    double relativeRmse = 0.0; ///< over all pixels that see scattering surface, and channels
    double meanRatio = 1.0;    ///< mean of B over mean of the truth
    double splattingMs = 0.0;
    double truthMs = 0.0;
};

/// @param settings of the splatting; its size is that of the comparison
/// @param cancelled given up between the two solvers; nothing is returned then
[[nodiscard]] std::optional<FrameDifference>
compareWithTruth(const gl::Context& context, const std::shared_ptr<const GpuScene>& scene,
                 FrameSettings settings, const Camera& camera, std::span<const Light> lights,
                 const Environment& environment, const std::atomic<bool>& cancelled);

} // namespace celadon
