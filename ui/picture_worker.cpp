#include "ui/picture_worker.h"

#include "renderer/gl/context_glfw.h"

#include <algorithm>
#include <chrono>
#include <list>

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
    std::unique_ptr<World> world; ///< a copy, whose materials are ours to patch
    std::vector<std::shared_ptr<subedit::MaterialMap>> materials;
    std::shared_ptr<GpuScene> scene;
    std::list<Ready> ready; ///< latest used first
    std::unique_ptr<ToneMapPass> toneMap;
    std::unique_ptr<ViewModePass> viewMode;

    void setWorld(const World& source) {
        ready.clear();
        toneMap.reset();
        viewMode.reset();
        scene.reset();
        world = std::make_unique<World>(source);
        materials.clear();
        for (MaterialPointer& material : world->materials) {
            materials.push_back(std::make_shared<subedit::MaterialMap>(*material));
            material = materials.back();
        }
        scene = std::make_shared<GpuScene>(*world, frameSettings(Quality::Default));
        toneMap = std::make_unique<ToneMapPass>(scene->shaders);
        viewMode = std::make_unique<ViewModePass>(scene->shaders, scene->materials.count());
    }

    FrameRenderer& rendererFor(const PictureRequest& request) {
        const FrameSettings settings = settingsOf(request);
        const auto found = std::find_if(ready.begin(), ready.end(), [&](const Ready& entry) {
            return entry.sizePx == settings.size && entry.quality == request.rung.quality &&
                   entry.samples == request.rung.samples && entry.specular == request.specular;
        });
        if (found != ready.end()) {
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

void PictureWorker::setWorld(std::shared_ptr<const World> world) {
    {
        const std::lock_guard lock(mMutex);
        mNewWorld = std::move(world);
        mPatches.clear();
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
        const std::shared_ptr<const World> newWorld = std::exchange(mNewWorld, nullptr);
        const std::deque<MaterialPatch> patches = std::exchange(mPatches, {});
        const std::optional<PictureRequest> request = std::exchange(mRequest, std::nullopt);
        lock.unlock();
        try {
            if (!renderers.context) {
                renderers.context = gl::createWindowContext(mWindow);
            }
            if (newWorld) {
                renderers.setWorld(*newWorld);
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
    const auto start = std::chrono::steady_clock::now();
    FrameRenderer& renderer = renderers.rendererFor(request);
    const auto begin = std::chrono::steady_clock::now();
    const gl::Texture* radiance = renderer.draw(request.camera, request.lights, &mInterrupt);
    Picture picture;
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
    const gl::Texture& shown = renderers.toneMap->apply(*radiance, display);
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
    // The first frame of a new renderer compiles shaders: that says nothing about the next one.
    static_cast<void>(start);
    picture.timeMs = std::chrono::duration<double, std::milli>(end - begin).count();
    const std::lock_guard lock(mMutex);
    mPicture = std::move(picture);
}

} // namespace celadon::ui
