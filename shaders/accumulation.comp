// Accumulation, coarse to fine (Chen et al. 2012, section 4, eq. 17; DESIGN 3.4): B^k += upsampled B^(k+1).
// Departures from eq. 17, each measured. A far ring depends on the pixel's own material through sqrt(P_xo): that factor, the
// far energy, is divided out before interpolation and multiplied in after. On a smooth surface weights are bilinear and
// nothing else, so that what changes linearly is reproduced; interpolation is cubic where far_light_sharpening.comp came
// before. Other pixels are listed for accumulation_rough.comp.
// The cpu backend has the same in renderer/gather/level_accumulation.cpp.
#include "include/upsampling.glsl"
#include "include/covered_group.glsl"

void main() {
    ivec2 pixel = coveredPixel();
    if (any(greaterThanEqual(pixel, imageSize(fine)))) {
        return;
    }
    Point o = pointAt(pixel);
    if (o.material < 0) {
        return;
    }
    if (roughness(o, pixel) == 0.0) {
        addFarLight(o, pixel, interpolate(o, pixel));
        return;
    }
    listPixel(pixel);
}
