#include "ui/viewport.h"

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
constexpr std::chrono::milliseconds kRest{120};

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
    if (std::optional<std::string> error = mWorker.takeError()) {
        session.notify(Notice::Kind::Error, "The picture cannot be rendered: " + *error);
        mInFlight.reset();
        return true;
    }
    std::optional<Picture> picture = mWorker.takePicture();
    if (!picture) {
        if (mInFlight && !mWorker.isBusy()) {
            mInFlight.reset(); // given up
        }
        return false;
    }
    if (!picture->isFirst) {
        mLadder.measured(picture->rungIndex, picture->windowSizePx, picture->timeMs);
    }
    ++mPictureCount;
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
            mWorker.setSelection(i, {selection.width(), selection.height()}, std::move(weights));
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

void Viewport::ask(Session& session, int rung) {
    PictureRequest request;
    request.revision = session.pictureRevision();
    request.windowSizePx = mRect.size;
    request.rungIndex = rung;
    request.rung = mLadder.rungs()[static_cast<std::size_t>(rung)];
    request.camera = session.camera;
    request.lights = session.rig.resolved();
    request.environment = session.rig.around();
    request.specular = session.view.specular;
    request.display = windowDisplay(session.view);
    request.view = session.view.mode;
    request.overlayMaterial = mHasSelection ? session.activeMaterial : -1;
    const bool giveUp = mInFlight && mLadder.isSlow(mInFlight->rung, mRect.size);
    mInFlight = InFlight{request.revision, rung, mRect.size};
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
        mShownRevision = 0;
        mHasSelection = false;
        mLadder.forget();
    }
    const bool redraw = takePicture(session);
    passMaterials(session);
    const std::uint64_t revision = session.pictureRevision();
    if (mSeenRevision != revision) {
        mSeenRevision = revision;
        mLastChange = Clock::now();
    }
    const bool isCurrent = mShownRevision == revision && mShown.windowSizePx == mRect.size;
    const bool isComing =
        mInFlight && mInFlight->revision == revision && mInFlight->sizePx == mRect.size;
    if (isComing) {
        return redraw;
    }
    if (!isCurrent) {
        // One coarse picture at a time: the one under way is shown before the next is begun.
        if (!mInFlight || mLadder.isSlow(mInFlight->rung, mRect.size)) {
            ask(session, mLadder.movingRung(mRect.size));
        }
        return redraw;
    }
    if (Clock::now() - mLastChange >= kRest) {
        const std::optional<int> next = mLadder.nextRung(mShown.rungIndex, mRect.size);
        if (next && mShown.rungIndex < mFinestRung) {
            ask(session, std::min(*next, mFinestRung));
        }
    }
    return redraw;
}

double Viewport::secondsToNextStep() const {
    if (mInFlight || mShownRevision == 0 || mShown.rungIndex >= mFinestRung) {
        return -1.0;
    }
    const auto left = std::chrono::duration<double>(mLastChange + kRest - Clock::now()).count();
    return std::max(left, 0.001);
}

bool Viewport::isSettled(const Session& session) const {
    return session.hasWorld() && !mInFlight && mShownRevision == session.pictureRevision() &&
           mShown.windowSizePx == mRect.size && mShown.rungIndex >= mFinestRung;
}

std::vector<unsigned char> Viewport::readPixels() const {
    const glm::ivec2 size = mShown.sizePx;
    std::vector<unsigned char> rgba(mTexture.texelCount() * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(mTexture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(rgba.size()), rgba.data());
    std::vector<unsigned char> rgb;
    rgb.reserve(mTexture.texelCount() * 3);
    for (int y = size.y - 1; y >= 0; --y) {
        for (int x = 0; x < size.x; ++x) {
            const auto i = static_cast<std::size_t>(y * size.x + x) * 4;
            rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
        }
    }
    return rgb;
}

void Viewport::draw(ImDrawList& list) const {
    if (!mTexture) {
        return;
    }
    const ImVec2 low(static_cast<float>(mRect.origin.x), static_cast<float>(mRect.origin.y));
    const ImVec2 high(low.x + static_cast<float>(mRect.size.x),
                      low.y + static_cast<float>(mRect.size.y));
    // The backend binds the texture only: how it is read is the texture's own setting.
    const GLint filter = mShown.sizePx == mRect.size ? GL_NEAREST : GL_LINEAR;
    glTextureParameteri(mTexture.id(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(mTexture.id(), GL_TEXTURE_MAG_FILTER, filter);
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(mTexture.id())), low,
                  high, {0.0f, 1.0f}, {1.0f, 0.0f});
}

} // namespace celadon::ui
