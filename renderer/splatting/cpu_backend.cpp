#include "renderer/splatting/cpu_backend.h"

#include "renderer/splatting/splatting_buffer.h"

#include <algorithm>
#include <string>

namespace celadon {

namespace {

constexpr double kWattsPerUnit = 1e-6; ///< flux is kept in W/m^2 times mm^2

/// A level into memory that is kept from frame to frame.
void read(const gl::Texture& texture, int level, std::vector<float>& texels) {
    texels.resize(texture.texelCount(level) * static_cast<std::size_t>(texture.channels()));
    texture.readLevel(level, std::span(texels));
}

} // namespace

CpuBackend::CpuBackend(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> materials,
                       const SplattingBuffer& view, const SplattingSettings& settings)
    : mSettings(settings),
      mIrradiance(shaders, static_cast<int>(materials.size()), settings.irradianceSize, 1),
      mMaterials(materials),
      mExitance(gl::Texture::make2d("exitance", GL_RGBA32F, view.paddedSize(), view.levels())),
      mLight(IrradianceBuffer::kTargets),
      mView(static_cast<std::size_t>(view.levels())) {}

void CpuBackend::begin(const SolveInput& input) {
    for (int k = 0; k < input.view.levels(); ++k) {
        ViewLevel& level = mView[static_cast<std::size_t>(k)];
        read(input.view.positions(), k, level.positions);
        read(input.view.surfaces(), k, level.surfaces);
        level.exitance.assign(level.positions.size(), 0.0f);
    }
    mGather.hierarchical = mSettings.scheme == Scheme::Hierarchical;
    mGather.multiresolution = mSettings.multiresolution;
    mGather.fade = static_cast<float>(mSettings.fade);
    mGather.pixelAngle = static_cast<float>(mSettings.pixelAngle);
    mGather.view = input.camera.view;
    mGather.pixelScale = static_cast<float>(input.camera.pixelWidth.scale);
    mGather.pixelOffset = static_cast<float>(input.camera.pixelWidth.offset);
    mGather.minimalRadius = [&materials = input.materials](float pixelsPerRadius, int material) {
        return materials.minimalRadius(pixelsPerRadius, material);
    };
}

LightTexels CpuBackend::lightTexels() const {
    LightTexels texels;
    texels.size = mIrradiance.size();
    texels.stride = mIrradiance.positions().size2d().x;
    texels.positions = mLight[0].data();
    texels.normals = mLight[1].data();
    texels.fluxes = mLight[2].data();
    texels.surfaces = mLight[3].data();
    texels.covariances = mLight[4].data();
    texels.extents = mLight[5].data();
    texels.kepts = mLight[6].data();
    return texels;
}

void CpuBackend::buildTree(const blocks::LightBlock& light, const SolveInput& input) {
    for (int i = 0; i < IrradianceBuffer::kTargets; ++i) {
        read(mIrradiance.target(i), 0, mLight[static_cast<std::size_t>(i)]);
    }
    const LightTexels texels = lightTexels();
    TreeSettings tree;
    tree.hierarchical = mSettings.scheme == Scheme::Hierarchical;
    tree.levels = mSettings.adaptive ? mSettings.irradianceLevels : 1;
    tree.adaptive = mSettings.adaptive;
    tree.cutEnergy = mSettings.energy;
    tree.alpha = static_cast<float>(mSettings.alpha);
    tree.discontinuityMm =
        static_cast<float>(mSettings.discontinuity) * input.gpuWorld.readBounds().scattering.w;
    tree.orientation = mSettings.orientation;
    tree.texelScale = light.cone.z;
    tree.texelOffset = light.cone.w;
    tree.sampleAngle = static_cast<float>(mSettings.sampleAngle);
    tree.fade = static_cast<float>(mSettings.fade);
    tree.fineSpread = static_cast<float>(mSettings.fineSpread);
    mTree.build(texels, mMaterials, tree);
}

void CpuBackend::add(const SolveInput& input, const LightViews& lightViews, int view,
                     gl::StageTimer& timer) {
    const blocks::LightBlock light = lightViews.read(view);
    if (light.direction.w == 0.0f) {
        return; // not in use
    }
    {
        const auto scope = timer.measure("irradianceBuffer");
        mIrradiance.draw(input.gpuWorld);
    }
    {
        const auto scope = timer.measure("selection");
        buildTree(light, input);
    }
    const int levels = input.view.levels();
    for (int k = 0; k < levels && !input.isInterrupted(); ++k) {
        const auto scope = timer.measure("splatting " + std::to_string(k));
        ViewLevel& level = mView[static_cast<std::size_t>(k)];
        const ViewTexels texels{mExitance.size2d(k), level.positions.data(), level.surfaces.data(),
                                level.exitance.data()};
        gatherLevel(mTree, mMaterials, texels, k, levels, mGather);
    }
}

void CpuBackend::finish() {
    for (std::size_t k = 0; k < mView.size(); ++k) {
        mExitance.upload(static_cast<int>(k), std::span<const float>(mView[k].exitance));
    }
}

void CpuBackend::count(FrameStats& statistics) {
    const SampleTree::Counts counts = mTree.count();
    statistics.samples.candidates += counts.candidates;
    for (std::size_t k = 0; k < counts.selected.size(); ++k) {
        statistics.samples.selected[k] += counts.selected[k];
    }
    for (std::size_t c = 0; c < 3; ++c) {
        statistics.flux.lit[c] += counts.litFlux[c] * kWattsPerUnit;
        statistics.flux.selected[c] += counts.selectedFlux[c] * kWattsPerUnit;
    }
}

} // namespace celadon
