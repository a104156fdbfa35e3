#include "ui/opened_scene.h"

#include "renderer/scene/motion.h"
#include "renderer/scene/surface_atlas_of_world.h"
#include "subedit/errors.h"
#include "subedit/map/material_convert.h"
#include "subedit/radius_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace celadon::ui {

using subedit::MaterialMap;

namespace {

/// Of a few texels: the shortest channel's on average, 0 for a black map.
double shortRadiusMm(const MaterialMap& map) {
    constexpr int kAcross = 4;
    double sum = 0.0;
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const glm::dvec3 R_P = subedit::effectiveRadiusMm(subedit::profileAt(
            map, i % kAcross * map.width / kAcross, i / kAcross * map.height / kAcross));
        sum += std::min({R_P.r, R_P.g, R_P.b});
    }
    return sum / (kAcross * kAcross);
}

/// Where no light view of a quick picture has texels as fine as a range, it is drawn wider.
void warnOfLargeModel(World& world) {
    constexpr double kFinestTexels = 2048.0; // across the model
    constexpr double kTexelsOfRange = 2.0;
    const double diameterMm = 2.0 * world.scatteringSphere.radius;
    for (const MaterialPointer& material : world.materials) {
        const double radiusMm = shortRadiusMm(*material);
        if (radiusMm > 0.0 && radiusMm * kFinestTexels < kTexelsOfRange * diameterMm) {
            world.warnings.push_back(fmt::format(
                "'{}' scatters over {:.2g} mm, too little to see on a model of {:.4g} mm, which "
                "looks opaque. If it is meant to be smaller, Model across in the Material panel "
                "makes it so, as do --diameter and --scale",
                material->name, radiusMm, diameterMm));
        }
    }
}

} // namespace

OpenedScene prepareScene(World world, bool paintable) {
    if (world.rig && world.rig->deformers) { // handles that are stored are prepared here
        static_cast<void>(Motion(world));
    }
    warnOfLargeModel(world);
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
