#pragma once

#include "ui/session.h"

#include <memory>
#include <vector>

/// The scene as it is now, for work on another thread while painting goes on.
namespace celadon::ui {

struct WorldSnapshot {
    std::shared_ptr<const World> base; ///< its materials belong to the picture's thread
    std::vector<MaterialPointer> materials;
    Camera camera;
    LightRig rig;
    ViewState view;
    MotionSetting motion;

    /// Copies the geometry as it is shown: not on the window's thread.
    /// @throws InputError for a shape that cannot be
    [[nodiscard]] World world() const {
        Motion mover(*base);
        mover.setDeformers(motion.deformers);
        mover.selectAnimation(motion.animation);
        World result = mover.moves() ? posedWorld(*base, mover.at(motion.seconds)) : *base;
        result.materials = materials;
        return result;
    }
};

/// Copies the maps that are being edited: some 50 ms for 512 x 512 texels.
[[nodiscard]] inline WorldSnapshot takeSnapshot(const Session& session) {
    WorldSnapshot snapshot{session.sharedWorld(), {},           session.camera,
                           session.rig,           session.view, session.motion.now};
    for (int i = 0; i < session.materialCount(); ++i) {
        const subedit::Document* const document = session.document(i);
        snapshot.materials.push_back(
            document != nullptr ? std::make_shared<const subedit::MaterialMap>(document->material())
                                : session.world().materials[static_cast<std::size_t>(i)]);
    }
    return snapshot;
}

} // namespace celadon::ui
