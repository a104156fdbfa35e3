#include "ui/viewport.h"

#include "ui/preparing_notice.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>

namespace celadon::ui {

namespace {

/// A selection of everything is what edits act on anyway: it is not shown.
bool isPartial(const std::vector<std::uint8_t>& weights) {
    return std::any_of(weights.begin(), weights.end(),
                       [](std::uint8_t weight) { return weight < 255; });
}

/// A pause this long is rest: finer pictures begin.
constexpr std::chrono::milliseconds kRest{50};

/// A first picture that comes sooner needs no words.
constexpr std::chrono::milliseconds kPatience{500};

} // namespace

bool ViewportRect::contains(glm::dvec2 point) const {
    return point.x >= origin.x && point.y >= origin.y && point.x < origin.x + size.x &&
           point.y < origin.y + size.y;
}

glm::dvec2 ViewportRect::place(glm::dvec2 point) const {
    return (point - glm::dvec2(origin) + 0.5) / glm::dvec2(size);
}

WindowDisplay windowDisplay(const ViewState& view) {
    WindowDisplay display;
    display.exposureEv = view.exposureEv;
    display.toneMap = view.toneMap;
    display.backgroundTop = {0.0085f, 0.0095f, 0.0105f};
    display.backgroundBottom = {0.0280f, 0.0295f, 0.0305f};
    return display;
}

Viewport::Viewport(PictureWorker& worker, double budgetMs)
    : mWorker(worker),
      mLadder(budgetMs),
      mFinestRung(static_cast<int>(mLadder.rungs().size()) - 1) {}

bool Viewport::takePicture(Session& session) {
    for (const std::string& warning : mWorker.takeWarnings()) {
        session.notify(Notice::Kind::Warning, warning);
    }
    if (std::optional<std::string> error = mWorker.takeError()) {
        session.notify(Notice::Kind::Error, "The picture cannot be rendered: " + *error);
        mInFlight.reset();
        ++mFailures;
        return true;
    }
    std::optional<Picture> picture = mWorker.takePicture();
    if (!picture) {
        if (mInFlight && !mWorker.isBusy()) {
            mInFlight.reset(); // given up
        }
        return false;
    }
    learn(*picture);
    if (mInFlight && mInFlight->purpose == Purpose::Rehearsal) {
        mInFlight.reset();
        return false;
    }
    ++mPictureCount;
    constexpr std::size_t kMostTimings = 90;
    mTimings.push_back({picture->stages, picture->timeMs});
    if (mTimings.size() > kMostTimings) {
        mTimings.pop_front();
    }
    if (mInFlight && mInFlight->revision == picture->revision &&
        mInFlight->rung == picture->rungIndex) {
        mInFlight.reset();
    }
    if (!mTexture || mTexture.size2d() != picture->sizePx) {
        mTexture = gl::Texture::make2d("viewport", GL_RGBA8, picture->sizePx);
    }
    mTexture.upload(0, std::span<const std::uint8_t>(picture->rgba));
    mShownRevision = picture->revision;
    picture->rgba.clear();
    mShown = std::move(*picture);
    return true;
}

/// Pictures that compiled shaders say little of those that follow.
void Viewport::learn(const Picture& picture) {
    if (picture.isFirst) {
        mLadder.measuredFirst(picture.rungIndex, picture.windowSizePx, picture.timeMs);
        return;
    }
    mLadder.measured(picture.rungIndex, picture.windowSizePx, picture.timeMs);
    if (mKnownSize != picture.windowSizePx) {
        mKnownSize = picture.windowSizePx;
        mKnown.assign(mLadder.rungs().size(), false);
    }
    mKnown[static_cast<std::size_t>(picture.rungIndex)] = true;
}

void Viewport::passMaterials(Session& session) {
    for (int i = 0; i < session.materialCount(); ++i) {
        subedit::Document* const document = session.document(i);
        if (document == nullptr) {
            continue;
        }
        const subedit::DocumentChanges changes = document->takeChanges();
        if (changes.selectionChanged) {
            const subedit::WeightMask& selection = document->selection();
            std::vector<std::uint8_t> weights(static_cast<std::size_t>(selection.width()) *
                                              static_cast<std::size_t>(selection.height()));
            selection.forEachNonZero([&](std::size_t texel, subedit::WeightMask::Weight weight) {
                weights[texel] = static_cast<std::uint8_t>(weight >> 8);
            });
            mHasSelection = isPartial(weights);
            mWorker.setSelection({i, {selection.width(), selection.height()}, std::move(weights)});
        }
        if (changes.layoutChanged) {
            MaterialPatch patch;
            patch.material = i;
            patch.whole = std::make_shared<subedit::MaterialMap>(document->material());
            mWorker.patchMaterial(std::move(patch));
            continue;
        }
        for (const subedit::TexelRect& rect : changes.rects) {
            mWorker.patchMaterial(makePatch(i, document->material(), rect));
        }
    }
}

void Viewport::ask(Session& session, int rung, Purpose purpose) {
    passMaterials(session); // once a picture: dabs that overlap are passed once
    PictureRequest request;
    request.revision = session.pictureRevision();
    request.windowSizePx = mRect.size;
    request.rungIndex = rung;
    request.rung = mLadder.rungs()[static_cast<std::size_t>(rung)];
    request.camera = session.camera;
    request.lights = session.rig.resolved();
    request.environment = session.rig.around();
    request.specular = session.view.specular;
    request.motion = session.motion.now;
    request.display = windowDisplay(session.view);
    request.view = session.view.mode;
    request.overlayMaterial = mHasSelection ? session.activeMaterial : -1;
    request.activeMaterial = session.activeMaterial;
    if (const subedit::Document* const document = session.activeDocument();
        document != nullptr && request.view.mode == ViewMode::Atlas) {
        request.surface = document->surfacePointer();
    }
    request.wantsCounts = mWantsCounts && request.rung.quality != Quality::Sketch;
    const bool giveUp = mInFlight && mInFlight->purpose != Purpose::Change;
    mInFlight = InFlight{request.revision, rung, mRect.size, purpose};
    mWorker.request(std::move(request), giveUp);
}

bool Viewport::update(Session& session) {
    if (!session.hasWorld() || mRect.size.x < 1 || mRect.size.y < 1) {
        return false;
    }
    if (mWorldRevision != session.worldRevision()) {
        mWorldRevision = session.worldRevision();
        mWorker.setWorld(session.sharedWorld(), session.takeRenderedMaterials());
        mInFlight.reset();
        mWorldSince = Clock::now();
        mPreparing = preparingText(session);
        mShownRevision = 0;
        mHasSelection = false;
        mLadder.forget();
        mKnownSize = glm::ivec2(0);
    }
    bool redraw = takePicture(session);
    const bool isLong = mShownRevision == 0 && Clock::now() - mWorldSince >= kPatience;
    if (mIsPreparing != (mInFlight && isLong)) {
        mIsPreparing = !mIsPreparing;
        redraw = true;
    }
    const std::uint64_t revision = session.pictureRevision();
    if (mSeenRevision != revision) {
        mSeenRevision = revision;
        mFailures = 0;
        mLastChange = Clock::now();
    }
    const bool isCurrent = mShownRevision == revision && mShown.windowSizePx == mRect.size;
    const bool isComing =
        isWaiting() && mInFlight->revision == revision && mInFlight->sizePx == mRect.size;
    if (isComing) {
        return redraw;
    }
    if (!isCurrent) {
        constexpr int kMostFailures = 3; // what cannot be rendered is not tried for ever
        if (mFailures >= kMostFailures) {
            return redraw;
        }
        // One coarse picture at a time: the one under way is shown before the next is begun,
        // however long it takes. To give it up for a newer one could go on for ever.
        if (!mInFlight || mInFlight->purpose != Purpose::Change) {
            ask(session, mLadder.movingRung(mRect.size), Purpose::Change);
        }
        return redraw;
    }
    if (Clock::now() - mLastChange >= kRest) {
        const std::optional<int> next = mLadder.nextRung(mShown.rungIndex, mRect.size);
        if (next && mShown.rungIndex < mFinestRung) {
            ask(session, std::min(*next, mFinestRung), Purpose::Refinement);
        } else if (mRehearses && !mInFlight) {
            // What a moving hand needs, and then what it comes to rest on: the second picture of a
            // size has the memory that following edits takes, and tells how long such pictures are.
            for (const int rung : {mLadder.movingRung(mRect.size), mShown.rungIndex}) {
                if (mKnownSize != mRect.size || !mKnown[static_cast<std::size_t>(rung)]) {
                    ask(session, rung, Purpose::Rehearsal);
                    break;
                }
            }
        }
    }
    return redraw;
}

double Viewport::secondsToNextStep() const {
    if (mInFlight && mShownRevision == 0 && !mIsPreparing) {
        const auto left = std::chrono::duration<double>(mWorldSince + kPatience - Clock::now());
        return std::max(left.count(), 0.001);
    }
    if (mInFlight || mShownRevision == 0) {
        return -1.0;
    }
    if (mShown.rungIndex >= mFinestRung) {
        return -1.0; // what is left to rehearse is asked for as the picture arrives
    }
    const auto left = std::chrono::duration<double>(mLastChange + kRest - Clock::now()).count();
    return std::max(left, 0.001);
}

bool Viewport::isSettled(const Session& session) const {
    return session.hasWorld() && !isWaiting() && mShownRevision == session.pictureRevision() &&
           mShown.windowSizePx == mRect.size && mShown.rungIndex >= mFinestRung;
}

bool Viewport::isAtRest(const Session& session) const {
    return session.hasWorld() && mShownRevision == session.pictureRevision() &&
           Clock::now() - mLastChange >= kRest;
}

void drawOver(const gl::Texture& texture, const ViewportRect& rect, ImDrawList& list) {
    const ImVec2 low(static_cast<float>(rect.origin.x), static_cast<float>(rect.origin.y));
    const ImVec2 high(low.x + static_cast<float>(rect.size.x),
                      low.y + static_cast<float>(rect.size.y));
    // The backend binds the texture only: how it is read is the texture's own setting.
    const GLint filter = texture.size2d() == rect.size ? GL_NEAREST : GL_LINEAR;
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, filter);
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.id())), low,
                  high, {0.0f, 1.0f}, {1.0f, 0.0f});
}

void Viewport::draw(ImDrawList& list) const {
    if (mTexture) {
        drawOver(mTexture, mRect, list);
    }
    if (mIsPreparing) {
        const std::optional<float> made = tablesMade();
        drawPreparing(list, mRect,
                      made ? fmt::format("{}: {:.0f} %", mPreparing, 100.0f * *made) : mPreparing);
    }
}

} // namespace celadon::ui
