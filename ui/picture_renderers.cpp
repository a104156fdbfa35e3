#include "ui/picture_renderers.h"

#include "renderer/explain/explain_pictures.h"
#include "renderer/gather/changed_texels.h"
#include "renderer/splatting/splatting_buffer.h"
#include "renderer/splatting/splatting_solver.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace celadon::ui {

namespace {

constexpr std::size_t kMaxRenderers = 9; ///< sizes and qualities kept ready: a whole ladder

glm::ivec2 renderedSize(glm::ivec2 windowSizePx, int divisor) {
    return glm::max((windowSizePx + divisor - 1) / divisor, glm::ivec2(1));
}

bool looksAtLight(ViewMode mode) {
    return mode == ViewMode::Irradiance || mode == ViewMode::Samples;
}

FrameSettings settingsOf(const PictureRequest& request) {
    FrameSettings settings = frameSettings(request.rung.quality);
    settings.size = renderedSize(request.windowSizePx, request.rung.divisor);
    settings.coverageSamples = request.rung.samples;
    if (settings.coverageSamples == 1) { // a draft then looks as sketches do
        settings.leastCosine = frameSettings(Quality::Sketch).leastCosine;
    }
    settings.specular = request.specular;
    if (looksAtLight(request.view.mode)) { // whose tree is there to be looked at
        settings.splatting.backend = SplatBackendKind::Cpu;
    }
    return settings;
}

/// Dabs of a stroke overlap, and many come between two pictures: what lies within the rectangles of
/// two is worked on once.
void addEdited(std::vector<TexelChange>& all, TexelChange added) {
    for (auto other = all.begin(); other != all.end();) {
        const subedit::TexelRect both = unite(other->rect, added.rect);
        if (other->material == added.material &&
            both.texels() <= other->rect.texels() + added.rect.texels()) {
            added.rect = both;
            all.erase(other);
            other = all.begin(); // it may reach others now
        } else {
            ++other;
        }
    }
    all.push_back(added);
}

/// A quality's other settings follow from these.
bool isSame(const FrameSettings& a, const FrameSettings& b) {
    return a.size == b.size && a.coverageSamples == b.coverageSamples && a.specular == b.specular &&
           a.splatting.backend == b.splatting.backend &&
           a.splatting.irradianceSize == b.splatting.irradianceSize;
}

} // namespace

MaterialPatch makePatch(int material, const subedit::MaterialMap& map,
                        const subedit::TexelRect& rect) {
    MaterialPatch patch;
    patch.material = material;
    patch.rect = rect;
    const auto row =
        static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(map.knots()) * 3;
    patch.logProfile.reserve(row * static_cast<std::size_t>(rect.height));
    for (int y = rect.y; y < rect.bottom(); ++y) {
        const float* const from = map.logProfile.data() + map.index(rect.x, y, 0);
        patch.logProfile.insert(patch.logProfile.end(), from, from + row);
    }
    return patch;
}

void PictureRenderers::setWorld(std::shared_ptr<const World> world,
                                std::vector<std::shared_ptr<subedit::MaterialMap>> materials) {
    dropScene();
    mSelections.clear();
    mMotion.reset();
    mWorld = std::move(world);
    mMotion = std::make_unique<Motion>(*mWorld);
    mMaterials = std::move(materials);
    mTold.clear();
}

bool PictureRenderers::prepare(const std::function<bool(float done)>& goesOn) {
    struct GivenUp {};
    try {
        if (mWorld && !mScene) {
            makeScene([&](float done) {
                if (!goesOn(done)) {
                    throw GivenUp();
                }
            });
        }
    } catch (const GivenUp&) {
        dropScene();
    }
    return mScene != nullptr;
}

void PictureRenderers::dropScene() {
    mReady.clear();
    mToneMap.reset();
    mViewMode.reset();
    mDeformation.reset();
    mMovedTo.reset();
    mUnseen.reset();
    mScene.reset();
}

void PictureRenderers::move(const MotionSetting& wanted, Settling settling) {
    if (mMovedTo == wanted && (mIsSettled || settling == Settling::Preview)) {
        return;
    }
    mMotion->setDeformers(wanted.deformers);
    mMotion->selectAnimation(wanted.animation);
    if (!mDeformation && !mMotion->moves()) {
        return;
    }
    Pose pose = mMotion->at(wanted.seconds, settling);
    if (!mDeformation) {
        mDeformation = std::make_unique<GpuDeformation>(mScene->shaders, *mWorld, mScene->gpuWorld);
    }
    mMovedTo.reset();
    mDeformation->apply(pose);
    mMovedTo = wanted;
    mIsSettled = settling == Settling::Full || !pose.nodes;
    mUnseen = std::move(pose);
    for (const Ready& entry : mReady) {
        entry.renderer->geometryChanged();
    }
}

void PictureRenderers::checkMove() {
    if (mUnseen) {
        const Pose pose = *std::exchange(mUnseen, std::nullopt);
        std::optional<MotionSetting> wanted = std::exchange(mMovedTo, std::nullopt);
        static_cast<void>(mDeformation->bounds(pose));
        mMovedTo = std::move(wanted);
    }
}

void PictureRenderers::makeScene(const MakingProgress& tell) {
    mScene = std::make_shared<GpuScene>(*mWorld, frameSettings(Quality::Default), tell);
    mToneMap = std::make_unique<ToneMapPass>(mScene->shaders);
    mViewMode = std::make_unique<ViewModePass>(mScene->shaders, mScene->materials.count());
    if (mScene->fitted.warnings() != mTold) { // it may be made again, after an operator say
        mTold = mScene->fitted.warnings();
        mUntold.insert(mUntold.end(), mTold.begin(), mTold.end());
    }
}

void PictureRenderers::apply(const SelectionWeights& selection) {
    gl::Texture texture = gl::Texture::make2d("selection", GL_R8, selection.size);
    texture.upload(0, std::span<const std::uint8_t>(selection.weights));
    mSelections.insert_or_assign(selection.material, std::move(texture));
}

void PictureRenderers::apply(const std::deque<MaterialPatch>& patches) {
    std::vector<TexelChange> edited;
    for (const MaterialPatch& patch : patches) {
        subedit::MaterialMap& map = *mMaterials[static_cast<std::size_t>(patch.material)];
        if (patch.whole) {
            map = *patch.whole;
            dropScene();
            continue;
        }
        const float* from = patch.logProfile.data();
        const auto row =
            static_cast<std::size_t>(patch.rect.width) * static_cast<std::size_t>(map.knots()) * 3;
        for (int y = patch.rect.y; y < patch.rect.bottom(); ++y, from += row) {
            std::copy_n(from, row, map.logProfile.data() + map.index(patch.rect.x, y, 0));
        }
        addEdited(edited, {patch.material, patch.rect});
    }
    if (!mScene) { // it will be made of what the maps are now
        return;
    }
    for (const auto& [material, rect] : edited) {
        const MaterialChange change = mScene->materialChanged(material, rect);
        for (const Ready& entry : mReady) {
            entry.renderer->solver().materialChanged(change);
        }
    }
}

SelectionOverlay PictureRenderers::overlayFor(const PictureRequest& request,
                                              const FrameRenderer& renderer) const {
    const auto found = mSelections.find(request.overlayMaterial);
    return found == mSelections.end() ? SelectionOverlay{}
                                      : SelectionOverlay{&renderer.view().surfaces(),
                                                         &found->second, request.overlayMaterial};
}

FrameRenderer& PictureRenderers::rendererFor(const PictureRequest& request, bool& isNew) {
    const FrameSettings settings = settingsOf(request);
    const auto found = std::ranges::find_if(
        mReady, [&](const Ready& entry) { return isSame(entry.settings, settings); });
    isNew = found == mReady.end();
    if (!isNew) {
        mReady.splice(mReady.begin(), mReady, found);
        return *mReady.front().renderer;
    }
    if (mReady.size() >= kMaxRenderers) {
        mReady.pop_back();
    }
    mReady.push_front({settings, std::make_unique<FrameRenderer>(mContext, mScene, settings)});
    return *mReady.front().renderer;
}

std::optional<Picture> PictureRenderers::render(const PictureRequest& request,
                                                const std::atomic<bool>& interrupt) {
    const auto begin = std::chrono::steady_clock::now();
    const auto finish = [&](Picture picture) {
        picture.revision = request.revision;
        picture.rungIndex = request.rungIndex;
        picture.windowSizePx = request.windowSizePx;
        const auto end = std::chrono::steady_clock::now();
        picture.timeMs = std::chrono::duration<double, std::milli>(end - begin).count();
        return picture;
    };
    if (request.view.mode == ViewMode::Atlas && request.surface != nullptr) {
        const glm::ivec2 size = renderedSize(request.windowSizePx, request.rung.divisor);
        const subedit::MaterialMap& map =
            *mMaterials[static_cast<std::size_t>(request.activeMaterial)];
        Picture picture;
        DisplayPixels pixels = atlasPicture(map, *request.surface, size);
        picture.sizePx = pixels.size;
        picture.rgba = std::move(pixels.rgba);
        return finish(std::move(picture));
    }
    move(request.motion,
         request.rung.quality == Quality::Sketch ? Settling::Preview : Settling::Full);
    Picture picture;
    FrameRenderer& renderer = rendererFor(request, picture.isFirst);
    std::vector<Light> lights = request.lights;
    if (looksAtLight(request.view.mode) && !lights.empty()) {
        const auto last = static_cast<int>(lights.size()) - 1;
        lights = {lights[static_cast<std::size_t>(std::clamp(request.view.light, 0, last))]};
    }
    auto* const splatting = dynamic_cast<SplattingSolver*>(&renderer.solver());
    if (splatting != nullptr) {
        splatting->collectStatistics(request.wantsCounts);
    }
    renderer.setEnvironment(
        looksAtLight(request.view.mode) && !lights.empty() ? Environment{} : request.environment);
    const gl::Texture* const radiance = renderer.draw(request.camera, lights, &interrupt);
    picture.stages = renderer.takeTimes();
    if (radiance == nullptr) {
        return std::nullopt;
    }
    if (request.wantsCounts && splatting != nullptr) {
        FrameStats stats;
        splatting->report(stats);
        picture.counts = stats.samples;
    }
    develop(request, *radiance, renderer, picture);
    checkMove();
    if (looksAtLight(request.view.mode)) {
        explainLight(request, renderer, picture);
    }
    return finish(std::move(picture));
}

void PictureRenderers::develop(const PictureRequest& request, const gl::Texture& radiance,
                               const FrameRenderer& renderer, Picture& picture) {
    WindowDisplay display = request.display;
    const gl::Texture* source = &radiance;
    ViewModeSettings view = request.view;
    if (view.mode == ViewMode::Samples) { // dots over the light that they make
        view.mode = ViewMode::Exitance;
        view.exposureEv = display.exposureEv - 1.5f;
    }
    if (isPerPixel(view.mode)) {
        source = &mViewMode->apply(renderer.view(), renderer.exitance(), view);
        display.exposureEv = 0.0f;
        display.toneMap = ToneMap::None;
    }
    const gl::Texture& shown = mToneMap->apply(*source, display, overlayFor(request, renderer));
    picture.sizePx = shown.size2d();
    picture.rgba.resize(static_cast<std::size_t>(picture.sizePx.x) *
                        static_cast<std::size_t>(picture.sizePx.y) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(shown.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(picture.rgba.size()), picture.rgba.data());
}

void PictureRenderers::explainLight(const PictureRequest& request, FrameRenderer& renderer,
                                    Picture& picture) {
    const auto* const splatting = dynamic_cast<SplattingSolver*>(&renderer.solver());
    const CpuBackend* const cpu = splatting != nullptr ? splatting->cpu() : nullptr;
    if (cpu == nullptr || request.lights.empty()) {
        return;
    }
    DisplayPixels pixels{picture.sizePx, std::move(picture.rgba)};
    if (request.view.mode == ViewMode::Irradiance) {
        pixels = irradiancePicture(cpu->lightTexels(), request.view.level, picture.sizePx);
    } else {
        const std::vector<ShownSample> samples =
            samplesAtDistance(cpu->tree(), true, request.view.distanceMm);
        picture.shownPerLevel = countPerLevel(samples);
        const gl::Texture& positions = renderer.view().positions();
        const std::vector<float> texels = positions.readLevel(0);
        const CameraView camera = makeCameraView(request.camera, pixels.size.x, pixels.size.y);
        drawSamples(samples, camera, texels.data(), positions.size2d().x, pixels);
    }
    picture.rgba = std::move(pixels.rgba);
}

} // namespace celadon::ui
