#include "ui/truth_view.h"

#include "renderer/frame_quality.h"
#include "ui/viewport.h"
#include "ui/world_snapshot.h"

#include <imgui.h>

#include <array>
#include <utility>

namespace celadon::ui {

namespace {

constexpr const char* kGroup = "truth";
constexpr std::array<int, 3> kDivisors{8, 4, 2}; ///< of the viewport, coarse first

} // namespace

void TruthView::update(const Session& session, glm::ivec2 viewportPx, bool isAtRest) {
    const bool isWanted = session.view.mode.mode == ViewMode::Difference && session.hasWorld();
    const std::uint64_t revision = session.pictureRevision();
    if (mAskedRevision != 0 && (!isWanted || mAskedRevision != revision)) {
        mJobs.cancel(kGroup);
        mAskedRevision = 0;
    }
    if (isWanted && isAtRest && mAskedRevision != revision) {
        mAskedRevision = revision;
        mIsGivenUp = false;
        start(session, viewportPx);
    }
}

void TruthView::start(const Session& session, glm::ivec2 viewportPx) {
    mIsComplete = false;
    const std::uint64_t revision = session.pictureRevision();
    mJobs.start(
        "Difference to truth", kGroup,
        [this, revision, viewportPx, snapshot = takeSnapshot(session)](
            const gl::Context& context, BackgroundJobs::Progress& progress) {
            const World world = snapshot.world();
            const std::vector<Light> lights = snapshot.rig.resolved();
            FrameSettings settings = frameSettings(Quality::Default);
            const auto scene = std::make_shared<const GpuScene>(world, settings);
            double done = 0.0; // parts of the pixels of all passes
            double all = 0.0;
            for (const int divisor : kDivisors) {
                all += 1.0 / (divisor * divisor);
            }
            for (const int divisor : kDivisors) {
                settings.size = glm::max(viewportPx / divisor, glm::ivec2(16));
                std::optional<FrameDifference> found =
                    compareWithTruth(context, scene, settings, snapshot.camera, lights,
                                     snapshot.rig.around(), progress.cancelled());
                if (!found) {
                    return;
                }
                const bool isLast = divisor == kDivisors.back();
                done += 1.0 / (divisor * divisor);
                progress.report(done / all);
                progress.deliver([this, revision, isLast, result = std::move(*found)]() mutable {
                    if (revision != mAskedRevision) {
                        return;
                    }
                    mTexture = gl::Texture::make2d("difference", GL_RGBA8, result.heatMap.size);
                    mTexture.upload(0, std::span<const std::uint8_t>(result.heatMap.rgba));
                    result.heatMap.rgba.clear();
                    mDifference = std::move(result);
                    mShownRevision = revision;
                    mIsComplete = isLast;
                });
            }
        });
}

void TruthView::giveUp() {
    mJobs.cancel(kGroup);
    mIsGivenUp = true;
}

const FrameDifference* TruthView::difference(const Session& session) const {
    return mTexture && mShownRevision == session.pictureRevision() ? &mDifference : nullptr;
}

void TruthView::draw(const Session& session, ImDrawList& list, const ViewportRect& rect) const {
    if (session.view.mode.mode == ViewMode::Difference && difference(session) != nullptr) {
        drawOver(mTexture, rect, list);
    }
}

} // namespace celadon::ui
