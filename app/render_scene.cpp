#include "app/render_scene.h"

#include "app/frame_pattern.h"
#include "app/log.h"
#include "renderer/scene/builtin.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/light.h"
#include "renderer/scene/load_scene.h"
#include "subedit/map/material_file.h"
#include "subedit/map/medium_bake.h"
#include "subedit/map/shipped_materials.h"

#include <map>

namespace celadon::app {

namespace {

constexpr std::string_view kBuiltinPrefix = "builtin:";
constexpr int kMediumSegments = 64;

MaterialPointer readMaterialFile(const std::filesystem::path& named,
                                 const ReadInstead& readInstead) {
    std::error_code unknown;
    const auto other = readInstead.find(std::filesystem::weakly_canonical(named, unknown));
    const std::filesystem::path& file = other == readInstead.end() ? named : other->second;
    std::vector<std::string> warnings;
    auto map = std::make_shared<subedit::MaterialMap>(subedit::readMaterial(file, &warnings));
    for (const std::string& warning : warnings) {
        log::warning("{}", warning);
    }
    return map;
}

} // namespace

std::string modelOfFrame(const RenderOptions& options, int frame) {
    return options.sequence ? FramePattern("--sequence", *options.sequence).name(frame)
                            : options.model;
}

std::string materialOfFrame(const RenderOptions& options, int frame) {
    return hasFrameField(*options.material)
               ? FramePattern("--material", *options.material).name(frame)
               : *options.material;
}

bool MaterialOverTime::changes() const {
    return mOptions.material && (mOptions.materialTo || hasFrameField(*mOptions.material));
}

MaterialPointer MaterialOverTime::at(int frame) {
    if (!changes()) {
        return nullptr;
    }
    if (!mOptions.materialTo) {
        return readMaterialArgument(materialOfFrame(mOptions, frame));
    }
    if (!mFade) {
        mFade.emplace(*readMaterialArgument(*mOptions.material),
                      *readMaterialArgument(*mOptions.materialTo));
    }
    const FrameRange range = mOptions.fadeFrames.value_or(*mOptions.frames);
    const double t = range.count() > 1
                         ? static_cast<double>(frame - range.first) / (range.last - range.first)
                         : (frame < range.first ? 0.0 : 1.0);
    return std::make_shared<const subedit::MaterialMap>(mFade->at(t));
}

Scene readModel(const std::string& model) {
    if (model.starts_with(kBuiltinPrefix)) {
        return makeBuiltin(std::string_view(model).substr(kBuiltinPrefix.size()));
    }
    return loadScene(model);
}

MaterialPointer readMaterialArgument(const std::string& nameOrPath) {
    return readMaterialFile(subedit::findMaterial(nameOrPath), {});
}

MaterialPointer bakeMedium(const subedit::Medium& medium) {
    subedit::MediumMap map{1, 1, static_cast<float>(medium.eta), {}, {}, {}};
    map.absorption = {glm::vec3(medium.absorption)};
    map.reducedScattering = {glm::vec3(medium.reducedScattering)};
    auto baked = std::make_shared<subedit::MaterialMap>(
        subedit::bakeMedia(map, {kMediumSegments, 0.0, 0.999}));
    baked->name = "medium";
    return baked;
}

World readWorld(const RenderOptions& options, int frame, const ReadInstead& readInstead) {
    Scene scene = readModel(modelOfFrame(options, frame));
    MaterialPointer override;
    std::vector<MaterialPointer> named(scene.materials.size());
    MaterialPointer fallback;
    if (const std::optional<subedit::Medium> medium = mediumOf(options)) {
        override = bakeMedium(*medium);
    } else if (options.material) {
        override =
            readMaterialFile(subedit::findMaterial(materialOfFrame(options, frame)), readInstead);
    } else {
        std::map<std::filesystem::path, MaterialPointer> read; // one map per file
        for (std::size_t i = 0; i < named.size(); ++i) {
            if (const auto& file = scene.materials[i].subedit) {
                MaterialPointer& material = read[*file];
                if (!material) {
                    material = readMaterialFile(*file, readInstead);
                }
                named[i] = material;
            }
        }
        if (read.empty()) {
            fallback = readMaterialArgument(subedit::kDefaultMaterial);
        }
    }
    World world = buildWorld(std::move(scene), override, named, fallback,
                             {options.millimetersPerUnit, options.diameterMm});
    for (const std::string& warning : world.warnings) {
        log::warning("{}", warning);
    }
    return world;
}

Camera cameraOf(const RenderOptions& options, const World& world) {
    const ViewRequest request{options.viewFrom, options.viewAt, options.viewUp,
                              options.fovYDegrees};
    return chooseCamera(world, request,
                        static_cast<double>(options.size.x) / static_cast<double>(options.size.y));
}

Environment environmentOf(const RenderOptions& options) {
    if (!options.environment) {
        return {};
    }
    const auto map = std::make_shared<EnvironmentMap>(readEnvironment(*options.environment));
    for (const std::string& warning : map->warnings) {
        log::warning("{}", warning);
    }
    Environment environment;
    environment.map = map;
    environment.lights = options.environmentLights;
    return environment;
}

std::vector<Light> lightsOf(const RenderOptions& options, const World& world,
                            const Camera& camera) {
    std::vector<Light> lights;
    for (const std::string& text : options.lights) {
        Light light = parseLight(text);
        light.position *= world.millimetersPerUnit;
        lights.push_back(light);
    }
    if (lights.empty()) {
        lights = world.lights;
    }
    if (lights.empty() && !options.environment) {
        lights.push_back(defaultLight(camera, world));
    }
    return lights;
}

} // namespace celadon::app
