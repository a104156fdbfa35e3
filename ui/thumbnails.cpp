#include "ui/thumbnails.h"

#include "renderer/frame_quality.h"
#include "renderer/output/image_io.h"
#include "renderer/scene/builtin.h"
#include "renderer/scene/camera.h"
#include "subedit/map/material_convert.h"
#include "subedit/map/material_file.h"
#include "ui/light_rig.h"
#include "ui/picture_file.h"
#include "ui/viewport.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace celadon::ui {

namespace {

constexpr int kVersion = 1; ///< of how they look: another one makes them anew
constexpr double kDiameterMm = 45.0;
constexpr int kMostTexels = 128; ///< more than a small picture shows

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
std::uint64_t hashOf(const std::string& text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    }
    return hash;
}

/// Path, size and time of the file: any change gives another name.
std::string cacheKey(const std::filesystem::path& file) {
    std::error_code failed;
    const auto time = std::filesystem::last_write_time(file, failed).time_since_epoch().count();
    return fmt::format("{:016x}",
                       hashOf(fmt::format("{} {} {} {}", kVersion, file.string(),
                                          std::filesystem::file_size(file, failed), time)));
}

World thumbnailWorld(const std::filesystem::path& material) {
    subedit::MaterialMap map = subedit::readMaterial(material);
    if (std::max(map.width, map.height) > kMostTexels) {
        map = subedit::convertMaterial(map, {.width = std::min(map.width, kMostTexels),
                                             .height = std::min(map.height, kMostTexels)});
    }
    Scene scene = makeBuiltin("shell");
    const std::size_t count = scene.materials.size();
    return buildWorld(std::move(scene), std::make_shared<subedit::MaterialMap>(std::move(map)),
                      std::vector<MaterialPointer>(count), nullptr, {std::nullopt, kDiameterMm});
}

/// Lit so that both color and translucency show.
void render(const gl::Context& context, const std::filesystem::path& material,
            const std::filesystem::path& target, const std::atomic<bool>& cancelled) {
    const World world = thumbnailWorld(material);
    FrameSettings settings = frameSettings(Quality::Draft);
    settings.size = glm::ivec2(Thumbnails::kSizePx);
    settings.coverageSamples = 16;
    const auto scene = std::make_shared<const GpuScene>(world, settings);
    FrameRenderer renderer(context, scene, settings);
    const Camera camera = chooseCamera(world, {}, 1.0);
    LightRig rig;
    rig.lights = lightPreset("studio", camera, world.scatteringSphere);
    const gl::Texture* const radiance = renderer.draw(camera, rig.resolved(), &cancelled);
    if (radiance == nullptr) {
        return;
    }
    ToneMapPass toneMap(scene->shaders);
    writePicture(target, toneMap.apply(*radiance, windowDisplay({})));
}

/// Rows from the bottom, as textures have them; empty where the file is no such picture.
std::vector<std::uint8_t> readThumbnail(const std::filesystem::path& file) {
    const FloatImage image = readImage(file).image;
    std::vector<std::uint8_t> rgba;
    if (image.width != Thumbnails::kSizePx || image.height != Thumbnails::kSizePx ||
        image.channelCount() < 3) {
        return rgba;
    }
    for (int y = image.height - 1; y >= 0; --y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                rgba.push_back(
                    static_cast<std::uint8_t>(std::lround(255.0f * encodeSrgb(image.at(x, y, c)))));
            }
            rgba.push_back(255);
        }
    }
    return rgba;
}

} // namespace

Thumbnails::Thumbnails(BackgroundJobs& jobs, std::filesystem::path folder)
    : mJobs(jobs), mFolder(std::move(folder)) {}

const gl::Texture* Thumbnails::find(const std::filesystem::path& material) {
    auto key = mKeys.find(material);
    if (key == mKeys.end()) {
        key = mKeys.emplace(material, cacheKey(material)).first;
    }
    Entry& entry = mEntries[key->second];
    if (!entry.isAsked) {
        entry.isAsked = true;
        ask(key->second, material);
    }
    return entry.texture ? &entry.texture : nullptr;
}

void Thumbnails::ask(const std::string& key, const std::filesystem::path& material) {
    mJobs.start(
        "", "",
        [this, key, material](const gl::Context& context, BackgroundJobs::Progress& progress) {
            const std::filesystem::path file = mFolder / (key + ".png");
            std::error_code failed;
            std::filesystem::create_directories(mFolder, failed);
            std::vector<std::uint8_t> rgba;
            if (std::filesystem::is_regular_file(file, failed)) {
                try {
                    rgba = readThumbnail(file);
                } catch (const std::exception&) { // broken: made anew
                    rgba.clear();
                }
            }
            if (rgba.empty()) {
                render(context, material, file, progress.cancelled());
                if (progress.isCancelled()) {
                    return;
                }
                rgba = readThumbnail(file);
            }
            progress.deliver([this, key, pixels = std::move(rgba)] {
                if (!pixels.empty()) {
                    Entry& entry = mEntries[key];
                    entry.texture = gl::Texture::make2d("thumbnail", GL_RGBA8, glm::ivec2(kSizePx));
                    entry.texture.upload(0, std::span<const std::uint8_t>(pixels));
                }
            });
        });
}

} // namespace celadon::ui
