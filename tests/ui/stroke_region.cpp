// stroke_region MODEL RECORD BEFORE AFTER: whether two materials differ exactly where the strokes
// of a record were painted on a model. For window_test.sh; says what is wrong and returns 1.
#include "renderer/scene/builtin.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/surface_atlas_of_world.h"
#include "subedit/document/stroke_file.h"
#include "subedit/map/material_file.h"
#include "subedit/paint/surface.h"
#include "ui/recorder.h"

#include <glm/geometric.hpp>

#include <cstdio>
#include <cstring>
#include <limits>
#include <string>

namespace {

using namespace celadon;

/// Distance to a piece of the path.
float distanceTo(const glm::vec3& a, const glm::vec3& b, const glm::vec3& p) {
    const glm::vec3 along = b - a;
    const float length2 = glm::dot(along, along);
    const float t =
        length2 > 0.0f ? glm::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
    return glm::distance(p, a + t * along);
}

float distanceToPath(const std::vector<subedit::StrokePoint>& path, const glm::vec3& p) {
    float nearest = glm::distance(path.front().positionMm, p);
    for (std::size_t i = 1; i < path.size(); ++i) {
        nearest = std::min(nearest, distanceTo(path[i - 1].positionMm, path[i].positionMm, p));
    }
    return nearest;
}

} // namespace

int main(int, char** argv) {
    const std::string model = argv[1];
    const subedit::MaterialMap before = subedit::readMaterial(argv[3]);
    const subedit::MaterialMap after = subedit::readMaterial(argv[4]);
    std::vector<subedit::StrokeCommand> strokes;
    for (const ui::Command& command : ui::readCommands(argv[2])) {
        if (command.name == "paint.edit") {
            const auto edit = subedit::parseCommand("record", command.arguments.at("edit").dump());
            if (const auto* stroke = std::get_if<subedit::StrokeCommand>(&edit)) {
                strokes.push_back(*stroke);
            }
        }
    }
    if (strokes.empty() || before.width != after.width || before.knots() != after.knots()) {
        std::fprintf(stderr, "no stroke, or maps of another layout\n");
        return 1;
    }
    Scene scene = model.starts_with("builtin:") ? makeBuiltin(model.substr(8)) : loadScene(model);
    const auto map = std::make_shared<subedit::MaterialMap>(before);
    const std::size_t looks = scene.materials.size();
    const World world =
        buildWorld(std::move(scene), map, std::vector<MaterialPointer>(looks), nullptr, {});
    const subedit::Surface surface(makeSurfaceAtlas(world, 0, before.width, before.height));
    const std::size_t values = static_cast<std::size_t>(before.knots()) * 3;
    std::size_t changed = 0, outside = 0, missed = 0;
    for (const subedit::Surface::Texel texel : surface.coveredTexels()) {
        const bool isChanged =
            std::memcmp(before.logProfile.data() + texel * values,
                        after.logProfile.data() + texel * values, values * sizeof(float)) != 0;
        bool isNear = false, isInside = false;
        for (const subedit::StrokeCommand& stroke : strokes) {
            const float distance = distanceToPath(stroke.path, surface.positionMm(texel));
            isNear |= distance < 1.001f * stroke.brush.radiusMm;
            // Close to the path and facing as it does: certainly under the brush.
            isInside |= distance < 0.4f * stroke.brush.radiusMm &&
                        glm::dot(surface.normal(texel), stroke.path.front().normal) > 0.8f;
        }
        changed += isChanged ? 1 : 0;
        outside += isChanged && !isNear ? 1 : 0;
        missed += isInside && !isChanged ? 1 : 0;
    }
    std::printf("%zu texels changed, %zu outside of the stroke, %zu missed inside\n", changed,
                outside, missed);
    return changed > 0 && outside == 0 && missed == 0 ? 0 : 1;
}
