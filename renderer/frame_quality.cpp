#include "renderer/frame_quality.h"

namespace celadon {

namespace {

/// As kLatticeTexels: below, silhouettes and shadows of the light view err by more than 1 % of what
/// is seen.
constexpr double kSilhouetteTexels = 15.0;

} // namespace

FrameSettings frameSettings(Quality quality) {
    FrameSettings settings;
    SplattingSettings& splatting = settings.splatting;
    splatting.scheme = Scheme::Hierarchical;
    splatting.energy = 1.0; // far samples are cheap: nothing is cut
    switch (quality) {
    case Quality::Sketch:
        splatting.irradianceSize = 128;
        splatting.finerBelowTexels = 1.0; // whose light would get lost between texels
        splatting.patchVariance = 3.0;
        splatting.alpha = 8.0;
        splatting.sampleAngle = 4.0;
        splatting.pixelAngle = 0.3;
        splatting.fade = 0.3;
        settings.coverageSamples = 1;
        settings.leastCosine = 0.25; // `slanting` of coverage.glsl
        settings.shadowSize = 16;
        settings.shadows = false;
        break;
    case Quality::Draft:
        splatting.irradianceSize = 256;
        splatting.finerBelowTexels = kLatticeTexels;
        splatting.patchVariance = 2.0;
        splatting.alpha = 8.0;
        splatting.sampleAngle = 3.0;
        splatting.fade = 0.3;
        settings.shadowSize = 512;
        break;
    case Quality::Default:
        splatting.fineBelowTexels = kSilhouetteTexels;
        splatting.finerBelowTexels = kLatticeTexels;
        break;
    case Quality::Final:
        splatting.irradianceSize = 1024;
        splatting.fineBelowTexels = kSilhouetteTexels;
        splatting.finerBelowTexels = kLatticeTexels;
        splatting.sampleAngle = 1.4;
        splatting.pixelAngle = 0.16;
        settings.shadowSize = 2048;
        break;
    }
    return settings;
}

} // namespace celadon
