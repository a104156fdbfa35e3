#pragma once

#include "renderer/frame_renderer.h"
#include "renderer/gpu_deformation.h"
#include "renderer/scene/motion.h"
#include "ui/picture.h"

#include <atomic>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What lives on the context of the picture's thread: the world on the GPU, and renderers of the
/// sizes and qualities in use. The thread makes its context current before it calls.
namespace celadon::ui {

class PictureRenderers {
public:
    /// @param context current; outlives this
    explicit PictureRenderers(const gl::Context& context) : mContext(context) {}

    /// @param materials those of the world, which are these renderers' from now on
    void setWorld(std::shared_ptr<const World> world,
                  std::vector<std::shared_ptr<subedit::MaterialMap>> materials);
    /// What is wanted before pictures can be rendered: the scene on the GPU, with its tables.
    /// @param goesOn asked now and then, with how much is done, 0 to 1
    /// @return whether it is there: false without a world, and when it does not go on
    [[nodiscard]] bool prepare(const std::function<bool(float done)>& goesOn);
    void apply(const std::deque<MaterialPatch>& patches);
    void apply(const SelectionWeights& selection);
    /// What is to be said of how the scene is shown.
    [[nodiscard]] std::vector<std::string> takeWarnings() { return std::exchange(mUntold, {}); }
    /// After an error nothing is known of their state: they are made anew.
    void dropRenderers() { mReady.clear(); }

    /// Nothing when interrupted.
    [[nodiscard]] std::optional<Picture> render(const PictureRequest& request,
                                                const std::atomic<bool>& interrupt);

private:
    struct Ready {
        FrameSettings settings;
        std::unique_ptr<FrameRenderer> renderer;
    };
    /// Moves the vertices to where a picture wants them, if they are not there.
    /// @throws InputError where they cannot be
    void move(const MotionSetting& wanted, Settling settling);
    /// Once a picture is made of it. @throws InputError where vertices are beyond all numbers
    void checkMove();
    void makeScene(const MakingProgress& tell);
    void dropScene();
    FrameRenderer& rendererFor(const PictureRequest& request, bool& isNew);
    [[nodiscard]] SelectionOverlay overlayFor(const PictureRequest& request,
                                              const FrameRenderer& renderer) const;
    /// The frame as display pixels.
    void develop(const PictureRequest& request, const gl::Texture& radiance,
                 const FrameRenderer& renderer, Picture& picture);
    /// The views of one light, in place of the picture or over it.
    void explainLight(const PictureRequest& request, FrameRenderer& renderer, Picture& picture);

    const gl::Context& mContext;
    std::shared_ptr<const World> mWorld; ///< at rest
    std::vector<std::shared_ptr<subedit::MaterialMap>> mMaterials;
    std::shared_ptr<GpuScene> mScene;
    std::unique_ptr<Motion> mMotion;              ///< of mWorld
    std::unique_ptr<GpuDeformation> mDeformation; ///< once something has moved
    std::optional<MotionSetting> mMovedTo;        ///< where it has put the vertices
    bool mIsSettled = true;                       ///< and whether handles' search went to its end
    std::optional<Pose> mUnseen;                  ///< the same, until a picture has shown it
    std::list<Ready> mReady;                      ///< latest used first
    std::unique_ptr<ToneMapPass> mToneMap;
    std::unique_ptr<ViewModePass> mViewMode;
    std::map<int, gl::Texture> mSelections; ///< by material
    std::vector<std::string> mTold;         ///< warnings of this world
    std::vector<std::string> mUntold;
};

} // namespace celadon::ui
