#pragma once

#include "renderer/frame_renderer.h"
#include "renderer/splatting/splatting_buffer.h"

/// Reading a finished frame back into a picture with its layers.
namespace celadon {

/// Fills frame.image, frame.stats.effectiveRadius and frame.seesScattering. Waits for the GPU.
void readFrame(const SplattingBuffer& view, const gl::Texture& exitance, const gl::Texture& color,
               const CameraView& camera, const GpuMaterials& materials, bool layers,
               RenderedFrame& frame);

} // namespace celadon
