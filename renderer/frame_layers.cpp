#include "renderer/frame_layers.h"

#include <algorithm>

namespace celadon {

namespace {

const std::vector<std::string> kColorChannels = {"R", "G", "B", "A"};
const std::vector<std::string> kLayerChannels = {
    "exitance.R", "exitance.G", "exitance.B", "position.X", "position.Y", "position.Z", "normal.X",
    "normal.Y",   "normal.Z",   "uv.X",       "uv.Y",       "radius",     "level"};

/// The coarsest splatting level that surface with this R_P takes part in (DESIGN 3.3, eq. 13).
int coarsestLevel(const GpuMaterials& materials, int levels, float R_P, double pixelWidthMm) {
    int level = 0;
    while (level + 1 < levels &&
           materials.minimalRadius(R_P / static_cast<float>(pixelWidthMm * (2 << level))) < 1.0f) {
        ++level;
    }
    return level;
}

} // namespace

void readFrame(const SplattingBuffer& view, const gl::Texture& exitance, const gl::Texture& color,
               const CameraView& camera, const GpuMaterials& materials, bool layers,
               RenderedFrame& frame) {
    const glm::ivec2 size = view.size();
    FloatImage& image = frame.image;
    image.width = size.x;
    image.height = size.y;
    image.channels = kColorChannels;
    if (layers) {
        image.channels.insert(image.channels.end(), kLayerChannels.begin(), kLayerChannels.end());
    }
    const std::size_t channels = image.channels.size();
    image.pixels.assign(
        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * channels, 0.0f);
    const glm::ivec3 extent(size, 1);
    const std::vector<float> colors = color.readRegion(0, glm::ivec3(0), extent);
    const std::vector<float> positions = view.positions().readRegion(0, glm::ivec3(0), extent);
    const std::vector<float> surfaces = view.surfaces().readRegion(0, glm::ivec3(0), extent);
    std::vector<float> normals;
    std::vector<float> exitances;
    if (layers) {
        normals = view.normals().readRegion(0, glm::ivec3(0), extent);
        exitances = exitance.readRegion(0, glm::ivec3(0), extent);
    }
    EffectiveRadiusRange range;
    double sum = 0.0;
    double sumPixels = 0.0;
    std::size_t seen = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const std::size_t source =
                (static_cast<std::size_t>(size.y - 1 - y) * static_cast<std::size_t>(size.x) +
                 static_cast<std::size_t>(x)) *
                4;
            float* target = &image.at(x, y, 0);
            std::copy_n(&colors[source], 4, target);
            const float depth = positions[source + 3];
            if (depth <= 0.0f) {
                continue;
            }
            const bool scatters = surfaces[source + 2] >= 0.0f;
            const float R_P = surfaces[source + 3];
            const double pixel = camera.pixelWidth.atDepthMm(static_cast<double>(depth));
            if (scatters) {
                const double radius = static_cast<double>(R_P);
                range.minMm = seen == 0 ? radius : std::min(range.minMm, radius);
                range.maxMm = seen == 0 ? radius : std::max(range.maxMm, radius);
                sum += radius;
                sumPixels += radius / pixel;
                ++seen;
            }
            if (layers) {
                float* layer = target + 4;
                if (scatters) {
                    std::copy_n(&exitances[source], 3, layer);
                }
                std::copy_n(&positions[source], 3, layer + 3);
                std::copy_n(&normals[source], 3, layer + 6);
                std::copy_n(&surfaces[source], 2, layer + 9);
                layer[11] = R_P;
                layer[12] =
                    scatters
                        ? static_cast<float>(coarsestLevel(materials, view.levels(), R_P, pixel))
                        : 0.0f;
            }
        }
    }
    if (seen > 0) {
        range.meanMm = sum / static_cast<double>(seen);
        range.meanPixels = sumPixels / static_cast<double>(seen);
    }
    frame.stats.effectiveRadius = range;
    frame.seesScattering = seen > 0;
}

} // namespace celadon
