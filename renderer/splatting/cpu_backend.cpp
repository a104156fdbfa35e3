#include "renderer/splatting/cpu_backend.h"

#include "renderer/splatting/splatting_buffer.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace celadon {

namespace {

constexpr double kWattsPerUnit = 1e-6; ///< flux is kept in W/m^2 times mm^2

/// Light views whose state is worth its memory: some 100 MB at 512 x 512 texels.
std::size_t keptLights(int irradianceSize) {
    return irradianceSize <= 128 ? 16 : irradianceSize <= 256 ? 8 : irradianceSize <= 512 ? 2 : 1;
}

/// Level 0 into memory that is kept from frame to frame.
void read(const gl::Texture& texture, std::vector<float>& texels) {
    texels.resize(texture.texelCount(0) * static_cast<std::size_t>(texture.channels()));
    texture.readLevel(0, std::span(texels));
}

/// The same of a part of it: x, y, width, height.
void read(const gl::Texture& texture, glm::ivec4 part, std::vector<float>& texels) {
    const glm::ivec3 extent(part.z, part.w, 1);
    texels.resize(static_cast<std::size_t>(extent.x * extent.y * texture.channels()));
    texture.readRegion(0, glm::ivec3(part.x, part.y, 0), extent, std::span(texels));
}

/// x, y, width, height of what both cover, and of what lies between.
glm::ivec4 unite(const glm::ivec4& a, const glm::ivec4& b) {
    if (a.z == 0 || b.z == 0) {
        return a.z == 0 ? b : a;
    }
    const glm::ivec2 low = glm::min(glm::ivec2(a), glm::ivec2(b));
    const glm::ivec2 high =
        glm::max(glm::ivec2(a.x + a.z, a.y + a.w), glm::ivec2(b.x + b.z, b.y + b.w));
    return glm::ivec4(low, high - low);
}

/// Whole squares of a level that have something of a part of level 0, as far as there are pixels.
glm::ivec4 partOfLevel(const glm::ivec4& part, int level, glm::ivec2 size) {
    const int square = PixelTiles::kSquare << level;
    const glm::ivec2 low = glm::ivec2(part.x, part.y) / square * PixelTiles::kSquare;
    const glm::ivec2 end = (glm::ivec2(part.x + part.z, part.y + part.w) + square - 1) / square;
    return glm::ivec4(low, glm::max(glm::min(end * PixelTiles::kSquare, size) - low, 0));
}

/// Adds light views up; the first one alone is there to begin with.
void addTo(std::vector<float>& sum, const std::vector<float>& part) {
    if (sum.empty()) {
        sum = part;
        return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sum.size(), 1 << 16),
                      [&](const auto& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              sum[i] += part[i];
                          }
                      });
}

} // namespace

CpuBackend::CpuBackend(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> materials,
                       const SplattingBuffer& view, const SplattingSettings& settings)
    : mSettings(settings),
      mIrradiance(shaders, static_cast<int>(materials.size()), settings.irradianceSize, 1,
                  settings.patchVariance),
      mMaterials(materials),
      mExitance(gl::Texture::make2d("exitance", GL_RGBA32F, view.paddedSize(), view.levels())),
      mView(static_cast<std::size_t>(view.levels())),
      mTiles(mView.size()),
      mLitPart(0, 0, view.paddedSize()),
      mLights(keptLights(settings.irradianceSize)) {}

void CpuBackend::materialChanged(const MaterialChange& change) {
    mHasNewRadii = true;
    const bool hasNewCodes = mMaterials.admit(change.largestLogP);
    for (LightState& state : mLights) {
        addChange(state.changes, {change.material, change.rect});
        if (hasNewCodes) {
            state.isCurrent.clear();
            state.hasTree = false;
        }
    }
}

void CpuBackend::begin(const SolveInput& input) {
    mGatheredPairs = 0;
    mObject = input.gpuWorld.readBounds().scattering;
    for (ViewLevel& level : mView) {
        level.exitance.clear();
    }
    if (mViewDrawn != input.view.drawn()) {
        mViewDrawn = input.view.drawn();
        readView(input.view);
        for (LightState& state : mLights) {
            state.isCurrent.clear();
        }
    } else if (mHasNewRadii) {
        read(input.view.surfaces(), mView[0].part, mView[0].surfaces);
        copyRadiiUp(mView);
    }
    mHasNewRadii = false;
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

void CpuBackend::readView(const SplattingBuffer& view) {
    mViewPart = view.bounds();
    for (std::size_t k = 0; k < mView.size(); ++k) {
        const auto level = static_cast<int>(k);
        mView[k].part = partOfLevel(unite(mLitPart, mViewPart), level, mExitance.size2d(level));
    }
    read(view.positions(), mView[0].part, mView[0].positions);
    read(view.normals(), mView[0].part, mView[0].normals);
    read(view.surfaces(), mView[0].part, mView[0].surfaces);
    makeCoarserLevels(mView, float(SplattingBuffer::kClusterDepth) * 2.0f * mObject.w);
    for (std::size_t k = 0; k < mView.size(); ++k) {
        mTiles[k] = PixelTiles(mView[k].texels(nullptr), static_cast<int>(k));
    }
}

LightTexels CpuBackend::lightTexels(const LightState& state) const {
    LightTexels texels;
    texels.size = mIrradiance.size();
    texels.stride = mIrradiance.paddedSize();
    texels.positions = state.texels[0].data();
    texels.normals = state.texels[1].data();
    texels.fluxes = state.texels[2].data();
    texels.surfaces = state.texels[3].data();
    texels.covariances = state.texels[4].data();
    texels.extents = state.texels[5].data();
    texels.kepts = state.texels[6].data();
    return texels;
}

bool CpuBackend::drawLight(const blocks::LightBlock& light, const SolveInput& input,
                           LightState& state) {
    state.texels.resize(IrradianceBuffer::kTargets);
    const bool isDrawn = state.drawnFor && state.geometry == input.geometry &&
                         std::memcmp(&*state.drawnFor, &light, sizeof(light)) == 0;
    if (isDrawn && state.hasTree && state.changes.empty()) {
        return true;
    }
    if (isDrawn) {
        mIrradiance.refreshRadii(state.surfaces);
        read(mIrradiance.extents(), mRadii);
        std::vector<float>& extents = state.texels[5];
        for (std::size_t i = 0; i < extents.size(); i += 4) {
            extents[i + 2] = mRadii[i + 2];
            extents[i + 3] = mRadii[i + 3];
        }
        read(mIrradiance.kepts(), state.texels[6]);
        return true;
    }
    mIrradiance.draw(input.gpuWorld);
    for (int i = 0; i < IrradianceBuffer::kTargets; ++i) {
        read(mIrradiance.target(i), state.texels[static_cast<std::size_t>(i)]);
    }
    const glm::ivec2 size = mIrradiance.surfaces().size2d();
    if (state.surfaces.id() == 0) {
        state.surfaces = gl::Texture::make2d("light view: surface points", GL_RGBA32F, size);
    }
    glCopyImageSubData(mIrradiance.surfaces().id(), GL_TEXTURE_2D, 0, 0, 0, 0, state.surfaces.id(),
                       GL_TEXTURE_2D, 0, 0, 0, 0, size.x, size.y, 1);
    state.drawnFor = light;
    state.geometry = input.geometry;
    return false;
}

void CpuBackend::buildTree(const blocks::LightBlock& light, LightState& state,
                           const SampleTree* before, const ChangedTexels& changed) {
    TreeSettings settings;
    settings.hierarchical = mSettings.scheme == Scheme::Hierarchical;
    settings.levels = mSettings.adaptive ? mSettings.irradianceLevels : 1;
    settings.adaptive = mSettings.adaptive;
    settings.cutEnergy = mSettings.energy;
    settings.alpha = static_cast<float>(mSettings.alpha);
    settings.discontinuityMm = static_cast<float>(mSettings.discontinuity) * mObject.w;
    settings.orientation = mSettings.orientation;
    settings.texelScale = light.cone.z;
    settings.texelOffset = light.cone.w;
    settings.sampleAngle = static_cast<float>(mSettings.sampleAngle);
    settings.fade = static_cast<float>(mSettings.fade);
    settings.fineSpread = static_cast<float>(mSettings.fineSpread);
    state.tree.build(lightTexels(state), mMaterials, settings, before, changed);
    state.hasTree = true;
}

void CpuBackend::add(const SolveInput& input, const LightViews& lightViews, int view,
                     gl::StageTimer& timer) {
    const blocks::LightBlock light = lightViews.read(view);
    if (light.direction.w == 0.0f) {
        return; // not in use
    }
    mLastLight = static_cast<std::size_t>(view) % mLights.size();
    LightState& state = mLights[mLastLight];
    bool isDrawn = false;
    {
        const auto scope = timer.measure("irradianceBuffer");
        isDrawn = drawLight(light, input, state);
    }
    const bool isKept = isDrawn && state.hasTree;
    const bool hasSums = !state.isCurrent.empty();
    const std::vector<TexelChange> changes = std::exchange(state.changes, {});
    const ChangedTexels changed(mMaterials, changes);
    if (isKept && changes.empty()) {
        if (hasSums && state.before.levels().empty()) {
            state.before = state.tree.withoutWorkspace(); // memory, while nothing is in a hurry
        }
        gather(state, {state.tree, changed}, input, timer);
        return;
    }
    {
        const auto scope = timer.measure("selection");
        if (hasSums) {
            std::swap(state.tree, state.before);
            state.tree.takeWorkspace(state.before);
        }
        buildTree(light, state, hasSums && isKept ? &state.before : nullptr, changed);
    }
    gather(state, {state.before, changed}, input, timer);
}

void CpuBackend::gather(LightState& state, const Since& since, const SolveInput& input,
                        gl::StageTimer& timer) {
    const auto levels = mView.size();
    std::optional<TreeChange> treeChange;
    std::vector<bool> wasCurrent = std::exchange(state.isCurrent, std::vector<bool>(levels, false));
    wasCurrent.resize(levels, false);
    if (mGather.hierarchical && std::ranges::count(wasCurrent, true) > 0) {
        treeChange.emplace(since.before, state.tree);
    }
    state.exitances.resize(levels);
    for (std::size_t k = 0; k < levels && !input.isInterrupted(); ++k) {
        const auto scope = timer.measure("splatting " + std::to_string(k));
        ViewLevel& level = mView[k];
        std::vector<float>& exitance = state.exitances[k];
        const bool keeps = treeChange && !treeChange->isEverything() && wasCurrent[k];
        if (!keeps) {
            exitance.assign(level.positions.size(), 0.0f);
        }
        const int number = static_cast<int>(k);
        const ViewTexels texels = level.texels(exitance.data());
        std::optional<GatherChange> change;
        if (keeps) {
            change.emplace(GatherChange{*treeChange, since.changed});
        }
        mGatheredPairs +=
            gatherLevel(state.tree, mMaterials, texels, mTiles[k], number, static_cast<int>(levels),
                        mGather, change ? &*change : nullptr);
        state.isCurrent[k] = true;
        addTo(level.exitance, exitance);
    }
}

void CpuBackend::accumulate(const SolveInput& input) {
    const PixelWidth& width = input.camera.pixelWidth;
    // Rings of the mean material at mean depth, as far_ring.glsl has them.
    const CameraFrame& frame = input.camera.frame;
    const double depth =
        std::max(glm::dot(glm::dvec3(mObject) - input.camera.eye, frame.forward), 1e-3);
    std::vector<float> starts(1, 0.0f);
    for (std::size_t k = 1; k < mView.size(); ++k) {
        const auto pixel = float((depth * width.scale + width.offset) * double(1 << k));
        const float R_P = input.materials.meanRadiusMm();
        starts.push_back(mGather.hierarchical ? pixel / mGather.pixelAngle
                                              : R_P * input.materials.minimalRadius(R_P / pixel));
    }
    AccumulationSettings settings;
    settings.sharpens = mGather.hierarchical;
    settings.pixelScale = mGather.pixelScale;
    settings.pixelOffset = mGather.pixelOffset;
    settings.objectRadius = mObject.w;
    mAccumulation.accumulate(mView, input.materials.selectFarEnergies(starts), settings);
}

void CpuBackend::finish(const SolveInput& input) {
    for (ViewLevel& level : mView) {
        level.exitance.resize(level.positions.size(), 0.0f); // no light view was in use
    }
    if (mView.size() > 1) {
        accumulate(input);
    }
    for (std::size_t k = 0; k < mView.size(); ++k) {
        const ViewLevel& level = mView[k];
        mExitance.uploadRegion(static_cast<int>(k), glm::ivec3(level.part.x, level.part.y, 0),
                               glm::ivec3(level.part.z, level.part.w, 1),
                               std::span<const float>(level.exitance));
    }
    mLitPart = mViewPart;
}

void CpuBackend::count(FrameStats& statistics) {
    const SampleTree::Counts counts = tree().count();
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
