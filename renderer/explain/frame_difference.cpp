#include "renderer/explain/frame_difference.h"

#include "renderer/output/image_compare.h"
#include "renderer/splatting/splatting_buffer.h"

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace celadon {

namespace {

struct Exitance {
    std::vector<float> texels; ///< RGBA, `stride` a row, rows from the bottom
    std::vector<float> positions, surfaces;
    int stride = 0;
    double timeMs = 0.0;
};

std::optional<Exitance> solveWith(const gl::Context& context,
                                  const std::shared_ptr<const GpuScene>& scene,
                                  const FrameSettings& settings, const Camera& camera,
                                  std::span<const Light> lights, const Environment& environment,
                                  const std::atomic<bool>& cancelled) {
    FrameRenderer renderer(context, scene, settings);
    renderer.setEnvironment(environment);
    const auto begin = std::chrono::steady_clock::now();
    if (renderer.draw(camera, lights, &cancelled) == nullptr || cancelled) {
        return std::nullopt;
    }
    Exitance result;
    result.texels = renderer.exitance().readLevel(0);
    result.positions = renderer.view().positions().readLevel(0);
    result.surfaces = renderer.view().surfaces().readLevel(0);
    result.stride = renderer.exitance().size2d().x;
    const auto end = std::chrono::steady_clock::now();
    result.timeMs = std::chrono::duration<double, std::milli>(end - begin).count();
    return result;
}

} // namespace

std::optional<FrameDifference>
compareWithTruth(const gl::Context& context, const std::shared_ptr<const GpuScene>& scene,
                 FrameSettings settings, const Camera& camera, std::span<const Light> lights,
                 const Environment& environment, const std::atomic<bool>& cancelled) {
    settings.coverageSamples = 1;
    settings.specular = false;
    const auto fast = solveWith(context, scene, settings, camera, lights, environment, cancelled);
    if (!fast) {
        return std::nullopt;
    }
    settings.solver = SolverKind::ImageReference;
    const auto truth = solveWith(context, scene, settings, camera, lights, environment, cancelled);
    if (!truth) {
        return std::nullopt;
    }
    const glm::ivec2 size = settings.size;
    FloatImage errors{size.x, size.y, {"error"}, {}};
    double squares = 0.0, truthSquares = 0.0, sum = 0.0, truthSum = 0.0;
    std::size_t values = 0;
    for (int row = 0; row < size.y; ++row) {
        const int y = size.y - 1 - row; // FloatImage has its top row first
        for (int x = 0; x < size.x; ++x) {
            // The two frames may be padded differently: the reference has one level only.
            const auto at = [&](const Exitance& e) {
                return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(e.stride) +
                            static_cast<std::size_t>(x));
            };
            const std::size_t i = at(*fast);
            const std::size_t j = at(*truth);
            float worst = 0.0f;
            if (fast->positions[i + 3] > 0.0f && fast->surfaces[i + 2] >= 0.0f) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const double b = static_cast<double>(fast->texels[i + c]);
                    const double t = static_cast<double>(truth->texels[j + c]);
                    squares += (b - t) * (b - t);
                    truthSquares += t * t;
                    sum += b;
                    truthSum += t;
                    worst = std::max(worst, static_cast<float>(std::abs(b - t)));
                    ++values;
                }
            }
            errors.pixels.push_back(worst);
        }
    }
    FrameDifference result;
    result.splattingMs = fast->timeMs;
    result.truthMs = truth->timeMs;
    result.relativeRmse = truthSquares > 0.0 ? std::sqrt(squares / truthSquares) : 0.0;
    result.meanRatio = truthSum > 0.0 ? sum / truthSum : 1.0;
    const double mean = values > 0 ? truthSum / static_cast<double>(values) : 0.0;
    const FloatImage heat =
        heatMap(errors, static_cast<float>(std::max(result.scale * mean, 1e-20)));
    result.heatMap.size = size;
    result.heatMap.rgba.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                               4);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            std::uint8_t* const pixel =
                result.heatMap.rgba.data() +
                4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                     static_cast<std::size_t>(x));
            for (int c = 0; c < 3; ++c) {
                const float value = glm::clamp(heat.at(x, size.y - 1 - y, c), 0.0f, 1.0f);
                pixel[c] = static_cast<std::uint8_t>(std::lround(255.0f * value));
            }
            pixel[3] = 255;
        }
    }
    return result;
}

} // namespace celadon
