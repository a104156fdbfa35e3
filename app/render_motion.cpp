#include "app/render_motion.h"

#include "subedit/errors.h"

namespace celadon::app {

Motion makeMotion(const World& rest, const MotionRequest& request) {
    Motion motion(rest);
    if (request.animation) {
        motion.selectAnimation(findAnimation(rest.rig.get(), *request.animation));
    } else if (request.timeSeconds) {
        if (motion.animations().empty()) {
            throw UsageError("--time", "the model has no animations", "leave it out");
        }
        motion.selectAnimation(0);
    }
    std::vector<Deformer> deformers;
    for (const std::string& text : request.deformations) {
        deformers.push_back(parseDeformer(text));
    }
    motion.setDeformers(std::move(deformers));
    return motion;
}

} // namespace celadon::app
