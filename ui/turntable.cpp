#include "ui/turntable.h"

#include "renderer/frame_quality.h"
#include "subedit/atomic_file.h"
#include "ui/picture_file.h"
#include "ui/viewport.h"
#include "ui/world_snapshot.h"

#include <fmt/format.h>

namespace celadon::ui {

namespace {

std::filesystem::path numbered(const std::filesystem::path& file, int frame) {
    return file.parent_path() /
           fmt::format("{}_{:04d}{}", file.stem().string(), frame, file.extension().string());
}

} // namespace

void startTurntable(Session& session, BackgroundJobs& jobs, const TurntableSettings& settings) {
    checkWritable(numbered(settings.file, 1));
    jobs.start(
        "Turntable", "turntable",
        [&session, settings, snapshot = takeSnapshot(session)](const gl::Context& context,
                                                               BackgroundJobs::Progress& progress) {
            const World world = snapshot.world();
            FrameSettings frame = frameSettings(Quality::Default);
            frame.size = settings.sizePx;
            frame.specular = snapshot.view.specular;
            const auto scene = std::make_shared<const GpuScene>(world, frame);
            FrameRenderer renderer(context, scene, frame);
            ToneMapPass toneMap(scene->shaders);
            for (int i = 0; i < settings.frames && !progress.isCancelled(); ++i) {
                Camera camera = snapshot.camera;
                LightRig rig = snapshot.rig;
                turnAround(camera, rig, 360.0 * i / settings.frames);
                renderer.setEnvironment(rig.around());
                const gl::Texture* const radiance =
                    renderer.draw(camera, rig.resolved(), &progress.cancelled());
                if (radiance == nullptr) {
                    break;
                }
                writePicture(numbered(settings.file, i + 1),
                             toneMap.apply(*radiance, windowDisplay(snapshot.view)));
                progress.report((i + 1.0) / settings.frames);
            }
            const std::string text =
                progress.isCancelled()
                    ? std::string("The turntable was cancelled; pictures made so far are kept")
                    : fmt::format("Saved {} pictures, '{}' and on", settings.frames,
                                  numbered(settings.file, 1).string());
            progress.deliver([&session, text] { session.notify(Notice::Kind::Info, text); });
        });
}

} // namespace celadon::ui
