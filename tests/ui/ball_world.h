#pragma once

#include "renderer/scene/builtin.h"
#include "ui/session.h"

#include <memory>
#include <utility>
#include <vector>

namespace celadon::test {

/// A ball of one plain profile, 40 mm across: 0.4 mm per unit.
inline World readBall(const ui::OpenRequest&) {
    const ui::NamedProfile plain{"plain", ui::diffusionProfile(glm::vec3(0.6f), glm::vec3(2.0f))};
    auto material = std::make_shared<subedit::MaterialMap>(ui::homogeneousMaterial(plain, 1.3f));
    Scene scene = makeBuiltin("sphere");
    const std::size_t materials = scene.materials.size();
    return buildWorld(std::move(scene), material, std::vector<MaterialPointer>(materials), nullptr,
                      {std::nullopt, 40.0});
}

} // namespace celadon::test
