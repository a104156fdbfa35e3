#include "ui/picture_worker.h"

#include "renderer/gl/context_glfw.h"
#include "subedit/errors.h"
#include "ui/picture_renderers.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <utility>

namespace celadon::ui {

namespace {

/// What is made sooner needs no words.
constexpr std::chrono::milliseconds kPatience{300};

} // namespace

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
        mWarnings.clear();
        mInterrupt = true;
    }
    mWake.notify_all();
}

void PictureWorker::patchMaterial(MaterialPatch patch) {
    const std::lock_guard lock(mMutex);
    mPatches.push_back(std::move(patch));
}

void PictureWorker::setSelection(SelectionWeights selection) {
    const std::lock_guard lock(mMutex);
    mSelections.push_back(std::move(selection));
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

std::optional<float> PictureWorker::tablesMade() const {
    const float made = mTablesMade;
    return made >= 0.0f ? std::optional(made) : std::nullopt;
}

std::optional<Picture> PictureWorker::takePicture() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mPicture, std::nullopt);
}

std::optional<std::string> PictureWorker::takeError() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mError, std::nullopt);
}

std::vector<std::string> PictureWorker::takeWarnings() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mWarnings, {});
}

void PictureWorker::run() {
    std::unique_ptr<gl::Context> context;
    std::optional<PictureRenderers> renderers;
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
        const std::deque<SelectionWeights> selections = std::exchange(mSelections, {});
        const std::optional<PictureRequest> request = std::exchange(mRequest, std::nullopt);
        lock.unlock();
        std::optional<Picture> picture;
        std::optional<std::string> problem;
        try {
            if (!context) {
                context = gl::createWindowContext(mWindow);
                renderers.emplace(*context);
            }
            if (newWorld) {
                renderers->setWorld(std::move(newWorld), std::move(newMaterials));
            }
            renderers->apply(patches);
            for (const SelectionWeights& selection : selections) {
                renderers->apply(selection);
            }
            const auto begin = std::chrono::steady_clock::now();
            const bool isThere = renderers->prepare([&](float made) {
                if (std::chrono::steady_clock::now() - begin > kPatience) {
                    mTablesMade = made;
                    mNotify();
                }
                return !mInterrupt;
            });
            if (isThere && request) {
                picture = renderers->render(*request, mInterrupt);
            }
        } catch (const InputError& error) { // a shape that cannot be: renderers are as they were
            problem = error.what();
        } catch (const std::exception& error) {
            if (renderers) {
                renderers->dropRenderers();
            }
            problem = error.what();
        }
        mTablesMade = -1.0f;
        lock.lock();
        if (picture) {
            mPicture = std::move(picture);
        }
        if (problem) {
            mError = std::move(problem);
        }
        if (renderers) {
            std::vector<std::string> warnings = renderers->takeWarnings();
            if (!mNewWorld) { // else they are of one that is closed
                std::ranges::move(warnings, std::back_inserter(mWarnings));
            }
        }
        lock.unlock();
        mNotify();
        lock.lock();
    }
    lock.unlock();
}

} // namespace celadon::ui
