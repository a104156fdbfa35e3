#pragma once

#include "ui/picture.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

struct GLFWwindow;

/// Renders pictures on a thread and a context of its own, so that a window answers at once however
/// long a picture takes. Requests replace each other; only the latest matters.
namespace celadon::ui {

class PictureWorker {
public:
    /// @param window hidden, with a context that no thread has current; outlives the worker
    /// @param notify called on the worker's thread when there is something to take
    PictureWorker(GLFWwindow* window, std::function<void()> notify);
    ~PictureWorker();
    PictureWorker(const PictureWorker&) = delete;
    PictureWorker& operator=(const PictureWorker&) = delete;

    /// Takes effect before the next request. Earlier patches are forgotten.
    /// @param materials those of the world, which are the worker's from now on
    void setWorld(std::shared_ptr<const World> world,
                  std::vector<std::shared_ptr<subedit::MaterialMap>> materials);
    /// Texels of the current world's materials, in order.
    void patchMaterial(MaterialPatch patch);
    void setSelection(SelectionWeights selection);
    /// @param giveUp what is being rendered is of no use any more
    void request(PictureRequest request, bool giveUp);

    [[nodiscard]] bool isBusy() const;
    /// How much of the scene on the GPU is made, 0 to 1; nothing while none is being made.
    [[nodiscard]] std::optional<float> tablesMade() const;
    [[nodiscard]] std::optional<Picture> takePicture();
    /// One line; what could not be rendered and why.
    [[nodiscard]] std::optional<std::string> takeError();
    /// A line each: what pictures do not show as it is.
    [[nodiscard]] std::vector<std::string> takeWarnings();

private:
    void run();

    GLFWwindow* mWindow;
    std::function<void()> mNotify;
    mutable std::mutex mMutex;
    std::condition_variable mWake;
    bool mStop = false;
    bool mBusy = false;
    std::shared_ptr<const World> mNewWorld;
    std::vector<std::shared_ptr<subedit::MaterialMap>> mNewMaterials;
    std::deque<MaterialPatch> mPatches;
    std::deque<SelectionWeights> mSelections;
    std::optional<PictureRequest> mRequest;
    std::optional<Picture> mPicture;
    std::optional<std::string> mError;
    std::vector<std::string> mWarnings;
    std::atomic<bool> mInterrupt = false;
    std::atomic<float> mTablesMade = -1.0f; ///< below 0: none are being made
    std::thread mThread;                    ///< last: everything above exists when it starts
};

} // namespace celadon::ui
