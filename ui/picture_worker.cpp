#include "ui/picture_worker.h"

#include "renderer/gl/context_glfw.h"

#include <algorithm>
#include <chrono>
#include <list>
#include <map>

namespace celadon::ui {

namespace {

constexpr std::size_t kMaxRenderers = 5; ///< sizes and qualities kept ready

glm::ivec2 renderedSize(glm::ivec2 windowSizePx, int divisor) {
    return glm::max((windowSizePx + divisor - 1) / divisor, glm::ivec2(1));
}

FrameSettings settingsOf(const PictureRequest& request) {
    FrameSettings settings = frameSettings(request.rung.quality);
    settings.size = renderedSize(request.windowSizePx, request.rung.divisor);
    settings.coverageSamples = request.rung.samples;
    settings.specular = request.specular;
    return settings;
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

/// What lives on the worker's context.
struct PictureWorker::Renderers {
    struct Ready {
        glm::ivec2 sizePx{0};
        Quality quality{};
        int samples = 0;
        bool specular = true;
        std::unique_ptr<FrameRenderer> renderer;
    };

    std::unique_ptr<gl::Context> context;
    std::shared_ptr<const World> world;
    std::vector<std::shared_ptr<subedit::MaterialMap>> materials;
    std::shared_ptr<GpuScene> scene;
    std::list<Ready> ready; ///< latest used first
    float knownLog = 0.0f;  ///< largest ln P of all materials, or more
    std::unique_ptr<ToneMapPass> toneMap;
    std::unique_ptr<ViewModePass> viewMode;
    std::map<int, gl::Texture> selections; ///< by material

    void setWorld(std::shared_ptr<const World> newWorld,
                  std::vector<std::shared_ptr<subedit::MaterialMap>> newMaterials) {
        dropScene();
        selections.clear();
        world = std::move(newWorld);
        materials = std::move(newMaterials);
        makeScene();
    }

    void dropScene() {
        ready.clear();
        toneMap.reset();
        viewMode.reset();
        scene.reset();
    }

    void apply(const Selection& selection) {
        gl::Texture texture = gl::Texture::make2d("selection", GL_R8, selection.size);
        texture.upload(0, std::span<const std::uint8_t>(selection.weights));
        selections.insert_or_assign(selection.material, std::move(texture));
    }

    [[nodiscard]] SelectionOverlay overlayFor(const PictureRequest& request,
                                              const FrameRenderer& renderer) const {
        const auto found = selections.find(request.overlayMaterial);
        return found == selections.end()
                   ? SelectionOverlay{}
                   : SelectionOverlay{&renderer.view().surfaces(), &found->second,
                                      request.overlayMaterial};
    }

    void makeScene() {
        knownLog = subedit::kLogProfileFloor;
        for (const auto& material : materials) {
            knownLog = std::max(knownLog, *std::ranges::max_element(material->logProfile));
        }
        scene = std::make_shared<GpuScene>(*world, frameSettings(Quality::Default));
        toneMap = std::make_unique<ToneMapPass>(scene->shaders);
        viewMode = std::make_unique<ViewModePass>(scene->shaders, scene->materials.count());
    }

    void apply(const std::deque<MaterialPatch>& patches) {
        bool isWhole = false;
        float largestLog = knownLog;
        for (const MaterialPatch& patch : patches) {
            subedit::MaterialMap& map = *materials[static_cast<std::size_t>(patch.material)];
            if (patch.whole) {
                map = *patch.whole;
                isWhole = true;
                continue;
            }
            for (const float value : patch.logProfile) {
                largestLog = std::max(largestLog, value);
            }
            const float* from = patch.logProfile.data();
            const auto row = static_cast<std::size_t>(patch.rect.width) *
                             static_cast<std::size_t>(map.knots()) * 3;
            for (int y = patch.rect.y; y < patch.rect.bottom(); ++y, from += row) {
                std::copy_n(from, row, map.logProfile.data() + map.index(patch.rect.x, y, 0));
            }
            if (!isWhole) {
                scene->materials.update(patch.material, map, patch.rect);
            }
        }
        if (isWhole) {
            dropScene();
            makeScene();
        } else if (largestLog > knownLog) {
            knownLog = largestLog;
            for (Ready& entry : ready) {
                entry.renderer->solver().materialsChanged();
            }
        }
    }

    FrameRenderer& rendererFor(const PictureRequest& request, bool& isNew) {
        const FrameSettings settings = settingsOf(request);
        const auto found = std::find_if(ready.begin(), ready.end(), [&](const Ready& entry) {
            return entry.sizePx == settings.size && entry.quality == request.rung.quality &&
                   entry.samples == request.rung.samples && entry.specular == request.specular;
        });
        isNew = found == ready.end();
        if (!isNew) {
            ready.splice(ready.begin(), ready, found);
            return *ready.front().renderer;
        }
        if (ready.size() >= kMaxRenderers) {
            ready.pop_back();
        }
        ready.push_front({settings.size, request.rung.quality, request.rung.samples,
                          request.specular,
                          std::make_unique<FrameRenderer>(*context, scene, settings)});
        return *ready.front().renderer;
    }
};

PictureWorker::PictureWorker(GLFWwindow* window, std::function<void()> notify)
    : mWindow(window), mNotify(std::move(notify)), mThread([this] { run(); }) {}

PictureWorker::~PictureWorker() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
        mInterrupt = true;
    }
    mWake.notify_all();
    mThread.join();
}

void PictureWorker::setWorld(std::shared_ptr<const World> world,
                             std::vector<std::shared_ptr<subedit::MaterialMap>> materials) {
    {
        const std::lock_guard lock(mMutex);
        mNewWorld = std::move(world);
        mNewMaterials = std::move(materials);
        mPatches.clear();
        mSelections.clear();
        mRequest.reset();
        mPicture.reset();
        mInterrupt = true;
    }
    mWake.notify_all();
}

void PictureWorker::patchMaterial(MaterialPatch patch) {
    const std::lock_guard lock(mMutex);
    mPatches.push_back(std::move(patch));
}

void PictureWorker::setSelection(int material, glm::ivec2 size, std::vector<std::uint8_t> weights) {
    const std::lock_guard lock(mMutex);
    mSelections.push_back({material, size, std::move(weights)});
}

void PictureWorker::request(PictureRequest request, bool giveUp) {
    {
        const std::lock_guard lock(mMutex);
        mRequest = std::move(request);
        if (giveUp) {
            mInterrupt = true;
        }
    }
    mWake.notify_all();
}

bool PictureWorker::isBusy() const {
    const std::lock_guard lock(mMutex);
    return mBusy || mRequest.has_value();
}

std::optional<Picture> PictureWorker::takePicture() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mPicture, std::nullopt);
}

std::optional<std::string> PictureWorker::takeError() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mError, std::nullopt);
}

void PictureWorker::run() {
    Renderers renderers;
    std::unique_lock lock(mMutex);
    while (true) {
        mBusy = false;
        mWake.wait(lock, [&] { return mStop || mRequest || mNewWorld; });
        if (mStop) {
            break;
        }
        mBusy = true;
        mInterrupt = false;
        std::shared_ptr<const World> newWorld = std::exchange(mNewWorld, nullptr);
        auto newMaterials = std::exchange(mNewMaterials, {});
        const std::deque<MaterialPatch> patches = std::exchange(mPatches, {});
        const std::deque<Selection> selections = std::exchange(mSelections, {});
        const std::optional<PictureRequest> request = std::exchange(mRequest, std::nullopt);
        lock.unlock();
        try {
            if (!renderers.context) {
                renderers.context = gl::createWindowContext(mWindow);
            }
            if (newWorld) {
                renderers.setWorld(std::move(newWorld), std::move(newMaterials));
            }
            if (renderers.scene && !patches.empty()) {
                renderers.apply(patches);
            }
            for (const Selection& selection : selections) {
                renderers.apply(selection);
            }
            if (renderers.scene && request) {
                serve(renderers, *request);
            }
        } catch (const std::exception& error) {
            renderers.ready.clear();
            const std::lock_guard again(mMutex);
            mError = error.what();
        }
        mNotify();
        lock.lock();
    }
    lock.unlock();
}

void PictureWorker::serve(Renderers& renderers, const PictureRequest& request) {
    Picture picture;
    FrameRenderer& renderer = renderers.rendererFor(request, picture.isFirst);
    const auto begin = std::chrono::steady_clock::now();
    renderer.setEnvironment(request.environment);
    const gl::Texture* radiance = renderer.draw(request.camera, request.lights, &mInterrupt);
    picture.stages = renderer.takeTimes();
    if (radiance == nullptr) {
        return;
    }
    WindowDisplay display = request.display;
    if (request.view.mode != ViewMode::Picture) {
        radiance = &renderers.viewMode->apply(renderer.view(), renderer.exitance(), request.view);
        display.exposureEv = 0.0f;
        display.toneMap = ToneMap::None;
    }
    const gl::Texture& shown =
        renderers.toneMap->apply(*radiance, display, renderers.overlayFor(request, renderer));
    picture.revision = request.revision;
    picture.rungIndex = request.rungIndex;
    picture.windowSizePx = request.windowSizePx;
    picture.sizePx = shown.size2d();
    picture.rgba.resize(static_cast<std::size_t>(picture.sizePx.x) *
                        static_cast<std::size_t>(picture.sizePx.y) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(shown.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(picture.rgba.size()), picture.rgba.data());
    const auto end = std::chrono::steady_clock::now();
    picture.timeMs = std::chrono::duration<double, std::milli>(end - begin).count();
    const std::lock_guard lock(mMutex);
    mPicture = std::move(picture);
}

} // namespace celadon::ui
