#include "ui/opened_scene.h"

#include "renderer/scene/motion.h"
#include "renderer/scene/surface_atlas_of_world.h"
#include "subedit/errors.h"
#include "subedit/map/material_convert.h"

#include <algorithm>

namespace celadon::ui {

using subedit::MaterialMap;

OpenedScene prepareScene(World world, bool paintable) {
    if (world.rig && world.rig->deformers) { // handles that are stored are prepared here
        static_cast<void>(Motion(world));
    }
    OpenedScene scene;
    for (std::size_t i = 0; i < world.materials.size(); ++i) {
        const MaterialMap& map = *world.materials[i];
        std::unique_ptr<subedit::Document> document;
        if (paintable) {
            const int width = std::max(map.width, kPaintableTexels);
            const int height = std::max(map.height, kPaintableTexels);
            try {
                auto surface = std::make_shared<subedit::Surface>(
                    makeSurfaceAtlas(world, static_cast<int>(i), width, height));
                document = std::make_unique<subedit::Document>(
                    subedit::convertMaterial(map, {.width = width, .height = height}),
                    std::move(surface));
            } catch (const InputError& error) {
                world.warnings.push_back("material '" + map.name +
                                         "' cannot be painted: " + error.what());
            }
        }
        scene.rendered.push_back(
            std::make_shared<MaterialMap>(document ? document->material() : map));
        scene.documents.push_back(std::move(document));
    }
    for (std::size_t i = 0; i < scene.rendered.size(); ++i) {
        world.materials[i] = scene.rendered[i];
    }
    scene.world = std::move(world);
    return scene;
}

} // namespace celadon::ui
