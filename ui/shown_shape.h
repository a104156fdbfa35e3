#pragma once

#include "renderer/reference/ray_scene.h"
#include "renderer/scene/motion.h"
#include "ui/session.h"

#include <future>
#include <memory>
#include <thread>

/// The surface as it is shown at a moment, for rays. To pose a large model and to sort its
/// triangles takes a second: that is done on a thread of its own.
namespace celadon::ui {

struct ShownShape {
    std::shared_ptr<const World> rest;
    std::shared_ptr<const RayScene> restRays;
    std::shared_ptr<const World> world; ///< as it is shown; `rest` where nothing moves
    std::shared_ptr<const RayScene> rays;
    MotionSetting setting; ///< of the moment
};

class ShownShapes {
public:
    explicit ShownShapes(const Session& session) : mSession(session) {}

    /// The shape of this moment is there; else it is being made from now on, and Window::wake()
    /// tells when that has ended. Waits for what takes no longer than nobody sees.
    [[nodiscard]] bool isCurrent();
    /// The shape of this moment; waits for it. Null without a world.
    [[nodiscard]] const ShownShape* current();
    /// The one that was made last, of an earlier moment perhaps; null before the first.
    [[nodiscard]] const ShownShape* latest() const { return mLatest.get(); }
    /// @return whether another one has come since the last call
    bool takeArrived();

private:
    /// What poses the rest shape: kept, since handles are prepared once for a model.
    struct Poser {
        std::shared_ptr<const World> rest;
        std::shared_ptr<const RayScene> restRays;
        Motion motion;
        explicit Poser(std::shared_ptr<const World> world);
    };
    static std::shared_ptr<const ShownShape> make(Poser& poser, const MotionSetting& setting);
    [[nodiscard]] bool isOfNow(const ShownShape& shape) const;
    void begin();
    void take(); ///< what has been made; waits for it

    const Session& mSession;
    std::shared_ptr<Poser> mPoser; ///< of the shape that is being made while one is
    std::shared_ptr<const ShownShape> mLatest;
    std::future<std::shared_ptr<const ShownShape>> mComing;
    bool mHasArrived = false;
    std::jthread mThread; ///< last: it is waited for before the rest goes
};

} // namespace celadon::ui
