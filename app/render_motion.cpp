#include "app/render_motion.h"

#include "renderer/scene/load_deformers.h"
#include "subedit/errors.h"

#include <filesystem>

namespace celadon::app {

std::optional<DeformerStack> readDeformations(const std::vector<std::string>& texts) {
    if (texts.empty()) {
        return std::nullopt;
    }
    DeformerStack stack;
    for (const std::string& text : texts) {
        if (text == "none") {
            if (texts.size() > 1) {
                throw UsageError("--deform none", "does not go with other deformers",
                                 "leave one of them out");
            }
        } else if (std::filesystem::path(text).extension() == ".json") {
            const DeformerStack more = loaders::readDeformers(text);
            stack.insert(stack.end(), more.begin(), more.end());
        } else {
            stack.push_back(parseDeformer(text));
        }
    }
    return stack;
}

Motion makeMotion(const World& rest, const MotionRequest& request) {
    Motion motion(rest);
    if (auto stack = readDeformations(request.deformations)) {
        motion.setDeformers(std::move(*stack));
    }
    if (request.animation) {
        motion.selectAnimation(findAnimation(rest.rig.get(), *request.animation));
    } else if ((request.timeSeconds || request.overFrames) && !motion.animations().empty()) {
        motion.selectAnimation(0);
    } else if (request.timeSeconds && motion.durationSeconds() == 0.0) {
        throw UsageError("--time", "the model has no animations and no deformer has keys",
                         "leave it out");
    }
    return motion;
}

} // namespace celadon::app
