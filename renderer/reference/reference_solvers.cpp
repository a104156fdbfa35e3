#include "renderer/reference/reference_solvers.h"

#include "renderer/reference/patch_gather.h"
#include "renderer/reference/random.h"
#include "renderer/splatting/splatting_buffer.h"

namespace celadon {

namespace {

constexpr double kWattsPerUnit = 1e-6; ///< the irradiance buffer has W/m^2 times mm^2

/// Lit texels of level 0.
void appendPatches(const IrradianceBuffer& buffer, std::vector<Patch>& patches) {
    const std::vector<float> positions = buffer.positions().readLevel(0);
    const std::vector<float> normals = buffer.normals().readLevel(0);
    const std::vector<float> fluxes = buffer.fluxes().readLevel(0);
    const std::vector<float> surfaces = buffer.surfaces().readLevel(0);
    const std::vector<float> covariances = buffer.covariances().readLevel(0);
    const std::vector<float> extents = buffer.extents().readLevel(0);
    for (std::size_t i = 0; i < positions.size(); i += 4) {
        if (surfaces[i + 3] <= 0.0f) {
            continue;
        }
        Patch patch;
        patch.positionMm = {positions[i], positions[i + 1], positions[i + 2]};
        patch.normal = {normals[i], normals[i + 1], normals[i + 2]};
        patch.flux = glm::vec3(fluxes[i], fluxes[i + 1], fluxes[i + 2]) * float(kWattsPerUnit);
        patch.covariance = {covariances[i],     covariances[i + 1], covariances[i + 2],
                            covariances[i + 3], extents[i],         extents[i + 1]};
        patch.uv = {surfaces[i], surfaces[i + 1]};
        patch.material = static_cast<int>(surfaces[i + 2]);
        patches.push_back(patch);
    }
}

/// References leave out nothing of what is lit.
void setFlux(const glm::dvec3& lit, FrameStats& statistics) {
    statistics.flux.lit = {lit.x, lit.y, lit.z};
    statistics.flux.selected = statistics.flux.lit;
}

} // namespace

std::vector<ExitPoint> readExitPoints(const SplattingBuffer& view) {
    const std::vector<float> positions = view.positions().readLevel(0);
    const std::vector<float> surfaces = view.surfaces().readLevel(0);
    std::vector<ExitPoint> points(positions.size() / 4);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].positionMm = {positions[4 * i], positions[4 * i + 1], positions[4 * i + 2]};
        points[i].uv = {surfaces[4 * i], surfaces[4 * i + 1]};
        points[i].material =
            positions[4 * i + 3] > 0.0f ? static_cast<int>(surfaces[4 * i + 2]) : -1;
    }
    return points;
}

bool isReferencePixel(int x, int y, int blocks) {
    constexpr int kSide = 8;
    Random random(static_cast<std::uint64_t>(x / kSide), static_cast<std::uint64_t>(y / kSide));
    return blocks * random.uniform() < 1.0;
}

const gl::Texture& ReferenceSolver::solve(const SolveInput& input, gl::StageTimer& timer) {
    const auto scope = timer.measure("splatting 0");
    mStatistics = {};
    std::vector<ExitPoint> exitPoints = readExitPoints(input.view);
    const int stride = input.view.paddedSize().x;
    for (std::size_t i = 0; i < exitPoints.size(); ++i) {
        const int pixel = static_cast<int>(i);
        if (!isReferencePixel(pixel % stride, pixel / stride, mBlocks)) {
            exitPoints[i].material = -1;
        }
    }
    const std::vector<glm::vec3> exitance = gather(input, exitPoints, mStatistics);
    std::vector<float> texels(exitance.size() * 4, 0.0f);
    for (std::size_t i = 0; i < exitance.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            texels[4 * i + static_cast<std::size_t>(c)] = exitance[i][c];
        }
    }
    if (!mExitance) {
        mExitance = gl::Texture::make2d("reference exitance", GL_RGBA32F, input.view.paddedSize());
    }
    mExitance.upload(0, texels);
    return mExitance;
}

void ReferenceSolver::report(FrameStats& stats) {
    stats.samples = mStatistics.samples;
    stats.flux = mStatistics.flux;
    stats.reference = mStatistics.reference;
}

ImageReferenceSolver::ImageReferenceSolver(const gl::ShaderLibrary& shaders, int materialCount,
                                           int irradianceSize, bool pointSamples, int blocks)
    : ReferenceSolver(blocks),
      mLightViews(shaders, LightViews::Target::Scattering, irradianceSize),
      mIrradiance(shaders, materialCount, irradianceSize, 1),
      mPointSamples(pointSamples) {}

std::vector<glm::vec3> ImageReferenceSolver::gather(const SolveInput& input,
                                                    std::span<const ExitPoint> exitPoints,
                                                    FrameStats& statistics) {
    std::vector<Patch> patches;
    mLightViews.update(input.lights, input.gpuWorld);
    for (int view = 0; view < mLightViews.count(); ++view) {
        if (mLightViews.isUsed(view)) {
            mLightViews.bind(view);
            mIrradiance.draw(input.gpuWorld);
            appendPatches(mIrradiance, patches);
        }
    }
    statistics.samples.candidates = patches.size();
    statistics.samples.selected = {patches.size()};
    setFlux(totalFlux(patches), statistics);
    GatherOptions options;
    options.pointSamples = mPointSamples;
    options.cancel = input.interrupt;
    GatherResult result = gatherExitance(exitPoints, patches, input.world.materials, options);
    statistics.samples.pairs = result.pairs;
    return std::move(result.exitance);
}

std::vector<glm::vec3> SurfaceReferenceSolver::gather(const SolveInput& input,
                                                      std::span<const ExitPoint> exitPoints,
                                                      FrameStats& statistics) {
    SurfaceReferenceResult result = mReference.solve(exitPoints, input.lights);
    statistics.samples.pairs = result.pairs;
    statistics.reference.relativeError = result.relativeError;
    setFlux(result.litFlux, statistics);
    return std::move(result.exitance);
}

std::vector<glm::vec3> PathTracedSolver::gather(const SolveInput& input,
                                                std::span<const ExitPoint> exitPoints,
                                                FrameStats& statistics) {
    const glm::ivec2 size = input.view.size();
    const PathTracedResult result =
        mPathTraced.solve(input.camera, size, input.lights, input.interrupt);
    const auto sum = [](const glm::dvec3& v) { return v.x + v.y + v.z; };
    statistics.reference = {
        result.relativeError, result.paths,
        sum(result.flux.entered) > 0.0 ? sum(result.flux.lost) / sum(result.flux.entered) : 0.0};
    setFlux(result.flux.entered, statistics);
    // Buffers of a view are padded at the right and at the top.
    std::vector<glm::vec3> exitance(exitPoints.size(), glm::vec3(0.0f));
    const auto stride = static_cast<std::size_t>(input.view.paddedSize().x);
    const auto width = static_cast<std::size_t>(size.x);
    for (std::size_t i = 0; i < result.exitance.size(); ++i) {
        const std::size_t target = i / width * stride + i % width;
        if (exitPoints[target].material >= 0) {
            exitance[target] = result.exitance[i];
        }
    }
    return exitance;
}

} // namespace celadon
