#include "ui/opened_scene.h"

#include "renderer/scene/surface_atlas_of_world.h"
#include "subedit/errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

using subedit::MaterialMap;

/// Bilinear, repeating: the convention of MaterialMap::sampleLogProfile, for single numbers.
std::vector<float> enlargedLayer(const std::vector<float>& layer, const MaterialMap& map, int width,
                                 int height) {
    if (layer.empty()) {
        return {};
    }
    const auto wrapped = [](int i, int n) { return (i % n + n) % n; };
    std::vector<float> result;
    result.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height) *
                            static_cast<float>(map.height) -
                        0.5f;
        const int y0 = static_cast<int>(std::floor(v));
        const float ty = v - static_cast<float>(y0);
        for (int x = 0; x < width; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width) *
                                static_cast<float>(map.width) -
                            0.5f;
            const int x0 = static_cast<int>(std::floor(u));
            const float tx = u - static_cast<float>(x0);
            const auto at = [&](int i, int j) {
                return layer[static_cast<std::size_t>(wrapped(j, map.height) * map.width +
                                                      wrapped(i, map.width))];
            };
            const float top = at(x0, y0) + tx * (at(x0 + 1, y0) - at(x0, y0));
            const float bottom = at(x0, y0 + 1) + tx * (at(x0 + 1, y0 + 1) - at(x0, y0 + 1));
            result.push_back(top + ty * (bottom - top));
        }
    }
    return result;
}

} // namespace

MaterialMap enlarged(const MaterialMap& map, int width, int height) {
    MaterialMap result;
    result.name = map.name;
    result.width = width;
    result.height = height;
    result.segments = map.segments;
    result.maxRadiusMm = map.maxRadiusMm;
    result.eta = map.eta;
    result.roughness = enlargedLayer(map.roughness, map, width, height);
    result.specular = enlargedLayer(map.specular, map, width, height);
    result.logProfile.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                             static_cast<std::size_t>(map.knots()) * 3);
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
            map.sampleLogProfile(uv, result.logProfile.data() + result.index(x, y, 0));
        }
    });
    return result;
}

OpenedScene prepareScene(World world, bool paintable) {
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
                    width == map.width && height == map.height ? map : enlarged(map, width, height),
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
