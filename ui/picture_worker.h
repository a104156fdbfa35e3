#pragma once

#include "renderer/gl/context.h"
#include "renderer/output/frame_stats.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/world.h"
#include "renderer/shading/tone_map_pass.h"
#include "renderer/shading/view_mode_pass.h"
#include "subedit/map/texel_rect.h"
#include "ui/quality_ladder.h"

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

/// Everything that a picture of the viewport depends on besides the world.
struct PictureRequest {
    std::uint64_t revision = 0; ///< of what is shown; comes back with the picture
    glm::ivec2 windowSizePx{0};
    int rungIndex = 0;
    Rung rung;
    Camera camera; ///< mm
    std::vector<Light> lights;
    Environment environment;
    bool specular = true;
    WindowDisplay display;
    ViewModeSettings view;
    int overlayMaterial = -1; ///< whose selection is drawn over the picture
};

struct Picture {
    std::uint64_t revision = 0;
    int rungIndex = 0;
    glm::ivec2 windowSizePx{0};
    glm::ivec2 sizePx{0};
    std::vector<std::uint8_t> rgba; ///< rows from the bottom
    double timeMs = 0.0;
    bool isFirst = false; ///< of its size and quality: shaders were compiled meanwhile
    StageMilliseconds stages;
};

/// Changed texels of one material, row by row, [height][width][knots][3]; or all of it, another
/// size or layout included.
struct MaterialPatch {
    int material = 0;
    subedit::TexelRect rect;
    std::vector<float> logProfile;
    std::shared_ptr<const subedit::MaterialMap> whole; ///< instead of rect and texels
};

/// A copy of a rectangle's texels. @param map keeps its layout until the patch is applied
[[nodiscard]] MaterialPatch makePatch(int material, const subedit::MaterialMap& map,
                                      const subedit::TexelRect& rect);

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
    /// Weights of a selection as bytes, [height][width] of the material's map.
    void setSelection(int material, glm::ivec2 size, std::vector<std::uint8_t> weights);
    /// @param giveUp what is being rendered is of no use any more
    void request(PictureRequest request, bool giveUp);

    [[nodiscard]] bool isBusy() const;
    [[nodiscard]] std::optional<Picture> takePicture();
    /// One line; what could not be rendered and why.
    [[nodiscard]] std::optional<std::string> takeError();

private:
    struct Renderers;

    void run();
    void serve(Renderers& renderers, const PictureRequest& request);

    GLFWwindow* mWindow;
    std::function<void()> mNotify;
    mutable std::mutex mMutex;
    std::condition_variable mWake;
    bool mStop = false;
    bool mBusy = false;
    std::shared_ptr<const World> mNewWorld;
    std::vector<std::shared_ptr<subedit::MaterialMap>> mNewMaterials;
    std::deque<MaterialPatch> mPatches;
    struct Selection {
        int material = 0;
        glm::ivec2 size{0};
        std::vector<std::uint8_t> weights;
    };
    std::deque<Selection> mSelections;
    std::optional<PictureRequest> mRequest;
    std::optional<Picture> mPicture;
    std::optional<std::string> mError;
    std::atomic<bool> mInterrupt = false;
    std::thread mThread; ///< last: everything above exists when it starts
};

} // namespace celadon::ui
